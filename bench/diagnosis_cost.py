#!/usr/bin/env python3
"""usage: bench/diagnosis_cost.py RESULT.json FATHOM FOLDER
Simulates the paper's campaign without pictures in FOLDER and writes what a diagnosis of it costs beside reading its
clouds: processor seconds on one thread, medians of turns; and what it costs by ray tracing, once, on two threads."""
import json
import shutil
import sys
from pathlib import Path
from statistics import median

from peak_memory import measure

TURNS = 5


def cost(fathom, folder):
    campaign = json.loads(Path("scenes/campaigns/paper.json").read_text()) | {"mode": "geometric"}
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "spec.json").write_text(json.dumps(campaign))
    measure([fathom, "campaign", str(folder / "spec.json"), "-o", str(folder / "campaign"), "--quiet"])
    commands = {"measure": [], "diagnose": ["-o", str(folder / "diagnosis")]}
    seconds = {name: [] for name in commands}
    for _ in range(TURNS):
        for name, options in commands.items():
            run = measure([fathom, name, str(folder / "campaign"), *options, "--threads", "1", "--quiet"])
            seconds[name].append(run["cpu_s"])
    traced = measure([fathom, "diagnose", str(folder / "campaign"), "-o", str(folder / "traced"), "--fidelity",
                      "photometric", "--threads", "2", "--quiet"])
    return {f"{name}_s": median(of_turns) for name, of_turns in seconds.items()} | {
        "traced_s": traced["cpu_s"], "traced_wall_s": traced["wall_s"]}


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    Path(sys.argv[1]).write_text(json.dumps(cost(sys.argv[2], Path(sys.argv[3])), indent=2) + "\n")
