"""Works that write folders: what kills.py interrupts and races.py starts twice."""
import json
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

import results
from seeds import TINY, campaign

# Which may differ from run to run.
TIMES = re.compile(r"^(timing|threads|.*_s)$")
CLUTTER = Path(__file__).resolve().parents[2] / "scenes" / "clutter" / "desk.json"


@dataclass
class Work:
    name: str
    marker: str      # its presence says that all is there
    arguments: list  # without -o
    other: list      # the same with other settings
    resumes: bool = False  # goes on where it was cut short


def make_works(program, folder, env):
    """The works, with their inputs in `folder`, from which they are started."""
    scene = {"sensor": {**TINY, "noise": "device"}, "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water",
                                                              "fill_mm": 30}]}
    spec = {**campaign(), "distance_mm": [250, 350], "trials": 4, "bare_desk_views": 2}
    clutter = {**json.loads(CLUTTER.read_text()), "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 350, 0],
                                                             "ir_size_px": [640, 480], "depth_size_px": [320, 240],
                                                             "focal_px": 285}}
    seen = {**TINY, "noise": "device", "ir_size_px": [640, 480], "depth_size_px": [320, 240], "focal_px": 285}
    measured = {**campaign(), "sensor": seen, "distance_mm": [250, 350], "trials": 2, "bare_desk_views": 2}
    frames = {"cups": {"number": [1, 2], "kinds": [{"shape": "mug"}]}, "objects": {"number": [0, 1], "kinds": [{"solid": "can"}]}}
    for name, value in {"scene": scene, "frames": frames, "spec": spec, "clutter": clutter, "measured": measured,
                        "hidden": {**measured, "effects": []}}.items():
        (folder / f"{name}.json").write_text(json.dumps(value))
    for name in ("measured", "hidden"):
        subprocess.run([program, "campaign", f"{name}.json", "-o", name, "--quiet"], cwd=folder, env=env, check=True,
                       stdout=subprocess.DEVNULL)
    subprocess.run([program, "generate", "frames.json", "--frames", "6", "-o", "drawn", "--quiet"], cwd=folder, env=env, check=True,
                   stdout=subprocess.DEVNULL)
    capture, evaluate = ["capture", "scene.json", "--mode", "geometric", "--frames", "12",
                         "--quiet"], ["evaluate", "recognition", "--clutter", "clutter.json", "--trials", "3", "--quiet"]
    return [
        Work("capture", "run.json", capture, [*capture, "--seed", "2"]),
        Work("campaign", "frames.csv", ["campaign", "spec.json", "--quiet"], ["campaign", "spec.json", "--quiet", "--seed", "2"],
             resumes=True),
        Work("diagnose", "report.json", ["diagnose", "measured", "--quiet"], ["diagnose", "hidden", "--quiet"]),
        Work("generate", "index.html", ["generate", "frames.json", "--frames", "8", "--quiet"],
             ["generate", "frames.json", "--frames", "8", "--quiet", "--seed", "2"], resumes=True),
        Work("evaluate", "rates.txt", evaluate, [*evaluate, "--seed", "2"], resumes=True),
        Work("card", "rates.txt", ["evaluate", "drawn", "--quiet"], ["evaluate", "drawn", "--quiet", "--method", "paper"], resumes=True),
    ]


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if not TIMES.match(key)}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def content(path):
    """What must come again, byte for byte but for times."""
    if path.suffix == ".json":
        try:
            return json.dumps(without_times(json.loads(path.read_bytes())))
        except ValueError:
            return path.read_bytes()
    if path.name == "manifest.jsonl":  # results.check_manifest compares its hashes, of files that hold times as well
        identity, *notes = path.read_text().splitlines()
        return "\n".join([identity, *(json.loads(note)["file"] for note in notes)])
    if path.name == "rates.txt":
        return "".join(line + "\n" for line in path.read_text().splitlines() if not line.endswith(" s"))
    return path.read_bytes()


def files(folder):
    """Every file but what is hidden: leftovers and locks."""
    return {path.relative_to(folder): content(path) for path in folder.rglob("*") if path.is_file()
            and not any(p.startswith(".") for p in path.relative_to(folder).parts)}


def differences(folder, wanted):
    """In words; nothing where `folder` holds just the files `wanted`."""
    found = files(folder)
    return ([f"{name} is missing" for name in wanted if name not in found] + [f"{name} is too much" for name in found
                                                                              if name not in wanted] +
            [f"{name} differs" for name in wanted if name in found and found[name] != wanted[name]])


def leftovers(folder):
    return [f"left {path.relative_to(folder)}" for path in folder.rglob("*") if results.is_leftover(path)]
