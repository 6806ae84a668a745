"""Each kind of file with the commands that read it. A kind writes its mutant to `here`, and returns the program's arguments."""
import json
import os
import random
import shutil

import extremes
import mutate_bytes
import mutate_cloud
import mutate_gltf
import mutate_image
import mutate_text
from seeds import PATTERN

BYTEWISE = 0.25  # share of the mutants that know nothing of the format


def text_mutant(rng, text, here, other="", mutate=mutate_text.mutate_json):
    if rng.random() < BYTEWISE:
        return mutate_bytes.mutate_bytes(rng, text.encode(), other.encode())
    return mutate(rng, text, here).encode("utf-8", "surrogatepass")


def capture_of(rng, scene="scene.json"):
    photometric = rng.random() < 0.15
    return ["capture", scene, "--mode", "photometric" if photometric else "geometric", *(["--spp", "1"] if photometric else []),
            *(["--device-outputs"] if rng.random() < 0.1 else []), *(["--frames", "2"] if rng.random() < 0.1 else [])]


def scene(rng, seeds, here):
    one, other = rng.sample(seeds.scenes, 2)
    (here / "scene.json").write_bytes(text_mutant(rng, one, here, other))
    return capture_of(rng)


def campaign(rng, seeds, here):
    (here / "spec.json").write_bytes(text_mutant(rng, seeds.campaign, here, seeds.scenes[1]))
    return ["campaign", "spec.json"]


def renamed(rng, rig, frames):
    """A liquid of another name, in both files: a label that is in order, and any text."""
    label = extremes.word(rng)
    tree = json.loads(rig)
    tree["liquids"] = {label if name == "water" else name: medium for name, medium in tree["liquids"].items()}
    cell = f'"{label}"' if rng.random() < 0.2 else label
    return json.dumps(tree), frames.replace(",water,", f",{cell},")


def measurement(rng, seeds, here, what):
    """A measurement directory; `what` of rig.json and frames.csv is the mutant."""
    folder = here / "measured"
    rig, frames = seeds.rig, seeds.frames
    with_clouds = rng.random() < 0.2
    if not with_clouds and rng.random() < 0.6:
        frames = "\n".join(frames.splitlines()[:10]) + "\n"  # too little for a diagnosis to choose from: quick
    if with_clouds:
        seeds.copy_clouds(folder)
        rig, frames = (folder / "rig.json").read_text(), (folder / "frames.csv").read_text()
    else:
        folder.mkdir()
    if rng.random() < 0.25:
        rig, frames = (text.encode("utf-8", "surrogatepass") for text in renamed(rng, rig, frames))
    elif what == "rig":
        rig = text_mutant(rng, rig, here, seeds.scenes[0])
    else:
        frames = text_mutant(rng, frames, here, seeds.labels, mutate_text.mutate_csv)
    for name, text in (("rig.json", rig), ("frames.csv", frames)):
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return ["measure" if with_clouds or rng.random() < 0.25 else "diagnose", "measured"]


def rig(rng, seeds, here):
    return measurement(rng, seeds, here, "rig")


def frames(rng, seeds, here):
    return measurement(rng, seeds, here, "frames")


def model(rng, seeds, here):
    (here / "model.json").write_bytes(text_mutant(rng, seeds.model, here, seeds.campaign))
    (here / "scene.json").write_text(seeds.scenes[0])
    (here / "spec.json").write_text(seeds.campaign)
    (here / "measured").mkdir()
    (here / "measured" / "rig.json").write_text(seeds.rig)
    (here / "measured" / "frames.csv").write_text(seeds.frames)
    command = rng.choice([["capture", "scene.json", "--mode", "geometric"], ["campaign", "spec.json"], ["diagnose", "measured"]])
    return [*command, "--model", "model.json"]


def detect(rng, cloud):
    more = rng.choice([[], [], ["--json"], ["--method", "paper"], ["--height-mm", "650", "--pitch-deg", "58.4"]])
    return ["detect", cloud, *more] if rng.random() < 0.8 else ["template", cloud, "--name", "mine"]


def pcd(rng, seeds, here):
    if rng.random() < BYTEWISE:
        whole = mutate_cloud.write_pcd(seeds.points, len(seeds.points), 1, rng.choice(["ascii", "binary", "binary_compressed"]))
        data = mutate_bytes.mutate_bytes(rng, whole, seeds.template_cloud)
    else:
        data = mutate_cloud.mutate_pcd(rng, seeds.points, len(seeds.points), 1)
    if rng.random() < 0.15:  # as a measurement's cloud
        seeds.copy_clouds(here / "measured")
        (here / "measured" / "clouds" / "000001.pcd").write_bytes(data)
        return ["measure", "measured"]
    (here / "cloud.pcd").write_bytes(data)
    return detect(rng, "cloud.pcd")


def ply(rng, seeds, here):
    data = mutate_cloud.mutate_ply(rng, seeds.points)
    (here / "cloud.ply").write_bytes(mutate_bytes.mutate_bytes(rng, data) if rng.random() < BYTEWISE else data)
    return detect(rng, "cloud.ply")


def gltf(rng, seeds, here):
    text, data = mutate_gltf.mutate_gltf(rng, here)
    binary = rng.random() < 0.4
    if binary:
        if '"uri": "box.bin", ' in text:
            text = text.replace('"uri": "box.bin", ', "")
        raw = mutate_gltf.glb(rng, text, data)
    else:
        raw = text.encode("utf-8", "surrogatepass")
    if rng.random() < BYTEWISE:
        raw = mutate_bytes.mutate_bytes(rng, raw)
    name = "box.glb" if binary else "box.gltf"
    (here / name).write_bytes(raw)
    (here / "box.bin").write_bytes(data)
    tree = json.loads(seeds.scenes[0])
    if rng.random() < 0.7:
        tree["objects"] = [{"gltf": name, "position_mm": [120, 300, 0]}]
    else:
        tree["cups"] = [{"shape": name, "position_mm": [0, 300], **rng.choice([{}, {"liquid": "water", "fill_mm": 10},
                                                                               {"liquid": "water", "fill_ml": 30}])}]
    (here / "scene.json").write_text(json.dumps(tree))
    return capture_of(rng)


def live(here):
    return ["detect", "--live", str(here / "played"), "--frames", "2"]


def exr(rng, seeds, here):
    seeds.copy_recording(here / "played")
    if rng.random() < BYTEWISE:
        data = mutate_bytes.mutate_bytes(rng, seeds.disparity, (here / "played" / "truth.exr").read_bytes())
    else:
        data = mutate_image.mutate_exr(rng, rng.choice([seeds.disparity, seeds.disparity,
                                                        (here / "played" / "truth.exr").read_bytes()]))
    (here / "played" / "disparity.exr").write_bytes(data)
    return live(here)


def record(rng, seeds, here):
    """run.json of a recording."""
    seeds.copy_recording(here / "played")
    (here / "played" / "run.json").write_bytes(text_mutant(rng, seeds.record, here, seeds.campaign))
    return live(here)


def png(rng, seeds, here):
    """A pattern of one's own."""
    tree = json.loads(seeds.scenes[0])
    tree["sensor"] = {**tree["sensor"], "pattern": PATTERN}
    (here / "scene.json").write_text(json.dumps(tree))
    data = mutate_image.grey_png(64, 64)
    data = mutate_bytes.mutate_bytes(rng, data) if rng.random() < BYTEWISE else mutate_image.mutate_png(rng, 64, 64)
    (here / "pattern.png").write_bytes(data)
    return ["capture", "scene.json", "--mode", "geometric"]


def infrared(rng, seeds, here):
    """An image beside a measurement's cloud."""
    folder = here / "measured"
    seeds.copy_clouds(folder)
    table = (folder / "frames.csv").read_text().splitlines()
    name = rng.choice(["ir.png", "ir.png", "ir.exr", "clouds/000001.pcd"])
    (folder / "frames.csv").write_text("\n".join(
        line + (",ir" if i == 0 else f",{name}" if i == 2 else ",") for i, line in enumerate(table)) + "\n")
    if name == "ir.png":
        good = mutate_image.grey_png(320, 240, 16)
        data = mutate_bytes.mutate_bytes(rng, good) if rng.random() < BYTEWISE else mutate_image.mutate_png(rng, 320, 240)
        (folder / name).write_bytes(data)
    elif name == "ir.exr":
        (folder / name).write_bytes(mutate_image.mutate_exr(rng, seeds.disparity))
    return ["measure", "measured"]


def clutter(rng, seeds, here):
    (here / "clutter.json").write_bytes(text_mutant(rng, seeds.clutter, here, seeds.campaign))
    return ["evaluate", rng.choice(["recognition", "recognition", "liquid"]), "--trials", "1", "--clutter", "clutter.json"]


def dataset(rng, seeds, here):
    (here / "frames.json").write_bytes(text_mutant(rng, seeds.dataset, here, seeds.clutter))
    return ["generate", "frames.json", "--frames", "1"]


def labelled(rng, seeds, here):
    """A data set that is searched."""
    shutil.copytree(seeds.drawn, here / "drawn")
    name = rng.choice(["labels/000000.json"] * 4 + ["depth/000000.png"] * 2 + ["complete.json", "../../models/models_info.json"])
    file = here / "drawn" / "train" / "000000" / name
    if file.suffix == ".png":
        data = file.read_bytes()
        data = mutate_bytes.mutate_bytes(rng, data) if rng.random() < BYTEWISE else mutate_image.mutate_png(rng, 640, 480)
    else:
        data = text_mutant(rng, file.read_text(), here, seeds.record)
    file.write_bytes(data)
    return ["evaluate", "drawn"]


def config(rng, seeds, here):
    """What detect takes beside clouds: a configuration with templates, poses, labels."""
    (here / "cloud.pcd").write_bytes(mutate_cloud.write_pcd(seeds.points, len(seeds.points), 1, "binary"))
    files = {"config.json": seeds.config, "cup.json": seeds.template, "poses.json": seeds.poses,
             "cups_groundtruth.csv": seeds.labels}
    what = rng.choice(list(files))
    for name, text in files.items():
        mutate = mutate_text.mutate_csv if name.endswith(".csv") else mutate_text.mutate_json
        (here / name).write_bytes(text_mutant(rng, text, here, seeds.rig, mutate) if name == what else text.encode())
    (here / "cup.pcd").write_bytes(seeds.template_cloud if rng.random() < 0.8
                                   else mutate_cloud.mutate_pcd(rng, seeds.points, len(seeds.points), 1))
    if what == "poses.json":
        return ["detect", "cloud.pcd", "cloud.pcd", "--poses", "poses.json"]
    if what == "cups_groundtruth.csv":
        return ["evaluate", "."]
    return ["detect", "cloud.pcd", "--config", "config.json", *rng.choice([[], ["--method", "paper"], ["--json"]])]


def viewed(rng, seeds, here):
    """A detection and a diagnosis of which pages are made."""
    what, names = rng.choice([("found", ["detection.json"] * 3 + ["detection_0000.pcd"]), ("diagnosis", ["report.json", "residuals.csv", "shots.json"])])
    shutil.copytree(seeds.results / what, here / what)
    file = here / what / rng.choice(names)
    if file.suffix == ".pcd":
        file.write_bytes(mutate_bytes.mutate_bytes(rng, file.read_bytes()))
    else:
        mutate = mutate_text.mutate_csv if file.suffix == ".csv" else mutate_text.mutate_json
        file.write_bytes(text_mutant(rng, file.read_text(), here, seeds.rig, mutate))
    return ["view", what]


def resumed(rng, seeds, here):
    """What a second run finds in the folder of the first: `out` is filled beforehand (main)."""
    (here / "spec.json").write_text((seeds.clouds.parent / "spec.json").read_text())
    out = here.parent / "out"
    shutil.copytree(seeds.clouds, out)
    path = rng.choice(sorted(p for p in out.rglob("*") if p.is_file() and p.stat().st_size > 0))
    data = path.read_bytes()
    if path.suffix not in (".json", ".csv") or rng.random() < 0.5:
        path.write_bytes(mutate_bytes.mutate_bytes(rng, data))
    else:
        path.write_bytes(text_mutant(rng, data.decode(), here, seeds.rig, mutate_text.mutate_csv if path.suffix == ".csv"
                                     else mutate_text.mutate_json))
    return ["campaign", "spec.json"]


# Kind: share of the mutants.
KINDS = {scene: 18, campaign: 9, rig: 11, frames: 11, model: 5, pcd: 11, ply: 9, gltf: 10, exr: 5, record: 2, png: 5, infrared: 2,
         clutter: 2, dataset: 3, labelled: 3, config: 4, viewed: 4, resumed: 2}
NAMES = [kind.__name__ for kind in KINDS]
# How the program is called: what its streams lead to.
STREAMS = ["2>&-", ">&- 2>&-", "2>/dev/full", ">/dev/full", ">&-", "<&-"]


def kind_of(seed, number):
    return random.Random(f"{seed}/{number}/kind").choices(list(KINDS), list(KINDS.values()))[0]


def make(seed, number, seeds, here):
    """Writes mutant `number` into the empty folder `here`: (kind's name, arguments, redirections, locale)."""
    rng = random.Random(f"{seed}/{number}")
    extremes.special_files(here)
    outside = here.parent / "outside"
    outside.mkdir()
    (outside / "secret.json").write_text('{"effects": []}')
    (outside / "secret.png").write_bytes(mutate_image.grey_png(64, 64))
    kind = kind_of(seed, number)
    arguments = kind(rng, seeds, here)
    special = replace_by_special(rng, here) if rng.random() < 0.03 else ""
    shell = rng.choice(STREAMS) if rng.random() < 0.02 else None
    locale = "C" if rng.random() < 0.1 else "C.UTF-8"
    return kind.__name__ + special, arguments, shell, locale


def replace_by_special(rng, here):
    """One of the files is none: a pipe, a device, a folder, a link that leads nowhere or in a circle. Returns which."""
    files = sorted(p for p in here.rglob("*") if p.is_file() and not p.is_symlink())
    if not files:
        return ""
    path = rng.choice(files)
    path.unlink()
    what = rng.choice(["fifo", "zero", "folder", "loop", "dangling", "full", "empty"])
    if what == "fifo":
        os.mkfifo(path)
    elif what == "folder":
        path.mkdir()
    elif what == "empty":
        path.write_bytes(b"")
    else:
        path.symlink_to({"zero": "/dev/zero", "loop": path.name, "dangling": "nowhere", "full": "/dev/full"}[what])
    return f", {path.relative_to(here)} is {what}"
