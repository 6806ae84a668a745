#!/usr/bin/env python3
"""usage: tests/app/examples.py [--quick] FATHOM
Runs every example of every command's --help, in the order of the commands, in a folder that holds what they name: a scene of one's own, clouds, a
labelled folder. FATHOM is a program of any place, installed or built. With --quick those that take longer than some seconds are only read: their
options are checked, nothing is run."""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# Words of examples that take longer than some seconds.
SLOW = ["full", "out/glass", "milk_tea", "evaluate", "campaign", "diagnose", "measure", "calibrate", "out/diagnosis", "check out", "--frames 1000", "reproduce", "verify all", "verify slab",
        "--live"]


def examples_of(program, folder):
    """Each example with what --help says of its options, asked for where it is going to run."""
    def printed(*words):
        return subprocess.run([program, *words, "--help"], cwd=folder, check=True, capture_output=True, text=True).stdout

    for command in re.findall(r"^  ([a-z]+) ", printed().split("Subcommands:")[1], re.M):
        text = printed(command)
        for line in text.split("Examples:\n")[1].splitlines():
            if line.startswith("  fathom "):
                words = shlex.split(line)
                is_subcommand = "Subcommands:" in text and words[2] in re.findall(r"^  ([a-z]+) ", text.split("Subcommands:")[1], re.M)
                helps = [text, printed(command, words[2])] if is_subcommand else [text]
                yield line.strip(), "".join(help.split("Examples:\n")[0] for help in helps)


def unknown_options(example, text):
    known = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", text))
    return [word for word in shlex.split(example) if word.startswith("-") and word not in known]


def run(program, words, folder):
    return subprocess.run([program, *words[1:]], cwd=folder, capture_output=True, text=True)


def prepare(program, folder):
    """What a user of the examples has: clouds from a camera, poses, a detector's settings, a folder of labelled clouds."""
    scene = {"sensor": {"height_mm": 650, "pitch_deg": 58.4}, "cups": [{"shape": "paper_cup", "position_mm": [0, 400]}]}
    (folder / "empty.json").write_text(json.dumps(scene))
    done = run(program, ["fathom", "capture", "empty.json", "--mode", "geometric", "-o", "own"], folder)
    assert done.returncode == 0, done.stderr
    for name in ("cloud.pcd", "shot1.pcd", "left.pcd", "right.pcd"):
        shutil.copy(folder / "own/cloud.pcd", folder / name)
    (folder / "shot2.ply").write_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 1\n")
    (folder / "detector.json").write_text("{}")
    pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
    (folder / "poses.json").write_text(json.dumps({"world_from_camera": [pose, pose]}))
    labelled = folder / "mOSD"
    labelled.mkdir()
    shutil.copy(folder / "cloud.pcd", labelled / "1.pcd")
    (labelled / "cups_groundtruth.csv").write_text("scene,labels,object,support,horiz_dist_m\n1,paper,cup_upright,table,0.4\n")
    os.environ["FATHOM_DEVICES"] = str(folder / "empty.json")


def main():
    words = [word for word in sys.argv[1:] if word != "--quick"]
    if len(words) != 1:
        sys.exit(__doc__)
    program = shutil.which(words[0])
    quick = "--quick" in sys.argv[1:]
    failed = count = 0
    with tempfile.TemporaryDirectory() as name:
        prepare(program, Path(name))
        for example, text in examples_of(program, name):
            count += 1
            if unknown := unknown_options(example, text):
                failed += 1
                print(f"FAILED: {example}: no option {', '.join(unknown)}", file=sys.stderr)
            if quick and any(word in example for word in SLOW):
                continue
            started = time.monotonic()
            done = run(program, shlex.split(example), name)
            if not quick:
                print(f"{time.monotonic() - started:6.1f} s  {example}", flush=True)
            if done.returncode != 0:
                failed += 1
                print(f"FAILED: {example}\n{done.stderr}", file=sys.stderr)
    print(f"{count} examples, {failed} failed")
    sys.exit(1 if failed or count == 0 else 0)


if __name__ == "__main__":
    main()
