#!/usr/bin/env python3
"""usage: tests/blind/smoke.py FATHOM
Ninety blind measurements of a fixed seed, diagnosed by FATHOM: every one gets an answer, and what must not happen
happens no more often than its bar allows. A share fails when its 95 % interval lies beyond the bar, which a diagnosis
that just meets the bar does once in forty; the seed is fixed, so that it fails always or never."""
import json
import shutil
import subprocess
import sys
from pathlib import Path

SEED, SETS = 9001, 90
# Of the goals those that a diagnosis keeps by being silent where it knows nothing.
SILENCE = ["names something on a null set", "… whose noise is mis-scaled or heavy-tailed", "confidently wrong"]


def main(program):
    root = Path(__file__).resolve().parents[2]
    name = f"development-{SEED}"
    blind = root / "out" / "blind"
    shutil.rmtree(blind / name, ignore_errors=True)
    (blind / "truth" / f"{name}.json").unlink(missing_ok=True)
    subprocess.run(["scripts/blind", "--program", str(Path(program).resolve()), "--seed", str(SEED), "--sets", str(SETS)],
                   cwd=root, check=True)
    goals = {goal["metric"]: goal for goal in json.loads((blind / name / "score" / "score.json").read_text())["goals"]}
    failed = [] if goals["answered"]["hits"] == SETS else ["answered"]
    failed += [metric for metric in SILENCE if goals[metric]["trials"] and goals[metric]["ci95"][0] > goals[metric]["bar"]]
    for metric in failed:
        print(f"FAILED: {metric}: {goals[metric]['hits']} of {goals[metric]['trials']}, must be {goals[metric]['bar']}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
