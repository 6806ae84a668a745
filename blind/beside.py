#!/usr/bin/env python3
"""usage: blind/beside.py SCORE
Sets the shares of SCORE/score.json beside those of simpler methods on the same measurements, SCORE/METHOD/score.json."""
import json
import sys
from pathlib import Path

METRICS = ["names something on a null set", "single effect first, s 5 to 8", "single effect first, s ≥ 8",
           "pair exact, both s ≥ 8", "triple exact", "confidently wrong"]


def shares(file):
    goals = {goal["metric"]: goal for goal in json.loads(file.read_text())["goals"]}
    return [f"{goals[m]['hits']}/{goals[m]['trials']}" if goals[m]["trials"] else "–" for m in METRICS]


def columns(score):
    """Each method's shares by its name, Fathom's first; nothing where no other method answered."""
    methods = sorted(file.parent for file in score.glob("*/score.json"))
    return {"Fathom": shares(score / "score.json")} | {m.name: shares(m / "score.json") for m in methods} if methods else {}


def main(score):
    beside = columns(score)
    print(f"\n{'beside simpler methods':46}" + "".join(f"{name:>21}" for name in beside))
    for row, metric in enumerate(METRICS):
        print(f"{metric:46}" + "".join(f"{column[row]:>21}" for column in beside.values()))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
