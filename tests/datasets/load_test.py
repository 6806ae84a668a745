#!/usr/bin/python3
"""usage: tests/datasets/load_test.py FATHOM
docs/datasets.md as a reader follows it: its commands run, its loader reads what they made, and what it reads agrees with
itself by arithmetic that is not the program's: meshes land in their masks, clouds lie on their models, COCO's runs are
BOP's masks. Skipped (exit code 77) without Debian's python3-opencv."""
import json
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

try:
    import cv2
    import numpy as np
except ImportError:
    print("... skipped 'python3-numpy and python3-opencv are not installed'")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/datasets.md").read_text()


def vertices(ply):
    head, body = ply.read_text().split("end_header\n")
    count = int(re.search(r"element vertex (\d+)", head)[1])
    return np.array([line.split() for line in body.splitlines()[:count]], float) * 1e-3


def decoded(runs):
    height, width = runs["size"]
    mask = np.zeros(height * width, bool)
    at = np.cumsum([0] + runs["counts"])
    for i in range(1, len(runs["counts"]), 2):
        mask[at[i]:at[i + 1]] = True
    return mask.reshape(width, height).T


def check(data_set, loader):
    models = {int(number): vertices(data_set / f"models/obj_{int(number):06}.ply")
              for number in json.loads((data_set / "models/models_info.json").read_text())}
    boxes = clouds = 0
    for depth, matrix, instances in loader["frames"](data_set):
        for one in instances:
            corners = models[one["model"]] @ one["rotation"].T + one["translation_m"]
            pixels = corners @ matrix.T
            pixels = pixels[:, :2] / pixels[:, 2:] + 0.5  # of pixels whose corners are whole numbers
            rows, columns = np.nonzero(one["mask"])
            if len(rows) == 0:
                continue
            seen = np.array([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1])
            whole = np.concatenate([pixels.min(axis=0), pixels.max(axis=0)])
            assert np.all(seen[:2] > whole[:2] - 0.6) and np.all(seen[2:] < whole[2:] + 0.6), (seen, whole)
            boxes += 1
            cloud = loader["points"](depth, matrix, one["mask"])
            if len(cloud) < 500 or (one["cup"] and one["cup"]["liquid"]):
                continue  # few points are noise's, and liquids move them
            reach = np.linalg.norm(corners - corners.mean(axis=0), axis=1).max()
            assert np.median(np.linalg.norm(cloud - corners.mean(axis=0), axis=1)) < reach, "points beside their model"
            clouds += 1
    scene = data_set / "train/000000"
    coco, poses = json.loads((scene / "coco.json").read_text()), json.loads((scene / "scene_gt.json").read_text())
    of_image = {}
    for annotation in coco["annotations"]:
        if annotation["category_id"] <= 2:
            of_image.setdefault(annotation["image_id"], []).append(decoded(annotation["segmentation"]))
    for image, masks in of_image.items():
        wanted = [cv2.imread(str(scene / f"mask_visib/{image:06}_{number:06}.png"), -1) > 0 for number in range(len(poses[str(image)]))]
        wanted = [mask for mask in wanted if mask.any()]
        assert len(masks) == len(wanted) and all(np.array_equal(a, b) for a, b in zip(masks, wanted)), "COCO's masks are others"
    return boxes, clouds


def check_reckoning(said, frames):
    reckoned = 1e6 * float(re.search(r"20 frames are up to ([\d.]+) MB", said)[1])
    written = sum(512 * file.stat().st_blocks for file in frames.rglob("*") if file.is_file())
    assert 0.75 * reckoned < written < reckoned, (reckoned, written)


def main(program):
    commands = re.findall(r"^```\n(.*?)^```", PAGE, re.M | re.S)
    loader = {"__name__": "loader"}
    text = re.search(r"^```python\n(.*?)^```", PAGE, re.M | re.S)[1]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "build/release/app").mkdir(parents=True)
        (folder / "build/release/app/fathom").symlink_to(Path(program).resolve())
        (folder / "out").mkdir()
        for block, name in zip(commands, ["frames", "mine"]):
            made = subprocess.run(block, shell=True, check=True, cwd=folder, capture_output=True, text=True)
            assert (folder / "out" / name / "index.html").exists()
            check_reckoning(made.stderr, folder / "out" / name / "train")
        exec(compile(text, "docs/datasets.md", "exec"), loader)
        boxes, clouds = check(folder / "out/frames", loader)
        assert boxes > 40 and clouds > 20, (boxes, clouds)
        (folder / "load.py").write_text(text)
        printed = subprocess.run([sys.executable, "load.py", "out/frames"], check=True, cwd=folder, capture_output=True, text=True).stdout
        assert "mug" in printed or "cup" in printed, printed
        archives = folder / "archives"
        subprocess.run([ROOT / "scripts/webdataset", "out/frames", archives], check=True, cwd=folder)
        with tarfile.open(archives / "000000.tar") as tar:
            names = tar.getnames()
            labels = json.load(tar.extractfile("000017.labels.json"))
        assert labels["frame"] == 17
        assert [name.split(".")[0] for name in names] == sorted(name.split(".")[0] for name in names), "frames are mixed"
        (folder / "direct.json").write_text('{"light": "direct"}')  # takes half the time
        many = ["build/release/app/fathom", "generate", "direct.json", "--frames", "201", "-o", "out/many", "--quiet"]
        subprocess.run(many, check=True, cwd=folder, capture_output=True)
        subprocess.run([ROOT / "scripts/webdataset", "out/many", folder / "pairs", "--shards-of", "200"], check=True, cwd=folder)
        held = []
        for archive in sorted((folder / "pairs").iterdir()):
            with tarfile.open(archive) as tar:
                held.append(sorted({int(name.split(".")[0]) for name in tar.getnames()}))
        assert held == [list(range(200)), [200]], held
        odd = subprocess.run([ROOT / "scripts/webdataset", "out/many", folder / "odd", "--shards-of", "150"], cwd=folder, capture_output=True, text=True)
        assert odd.returncode == 1 and "multiple of 100" in odd.stderr and not (folder / "odd").exists(), odd
        shutil.rmtree(folder / "out/many/train/000000")
        subprocess.run([ROOT / "scripts/webdataset", "out/many", folder / "part"], check=True, cwd=folder)
        assert sorted(archive.name for archive in (folder / "part").iterdir()) == ["000001.tar", "000002.tar"], "archives of a part are renumbered"
        print(f"{boxes} things lie in their masks, {clouds} clouds on their models")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
