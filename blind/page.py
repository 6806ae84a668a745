#!/usr/bin/env python3
"""usage: blind/page.py SCORE
Prints a pack's goals and its worst sets, of SCORE/goals.csv and SCORE/worst.csv, as tables for docs/blind.md."""
import csv
import sys
from pathlib import Path

WORST = 12


def rows(file):
    with open(file, encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


def figure(goal):
    if goal["trials"] == "0":
        return "no sets"
    if goal["metric"].startswith(("mean size", "gap closed", "held-out RMS", "matched filter")):
        return f"{float(goal['value']):.2f} ({float(goal['low95']):.2f} to {float(goal['high95']):.2f}), {goal['trials']} sets"
    if goal["metric"].startswith("localisation"):
        return f"{float(goal['value']):.2f}, {goal['trials']} sets"
    low, high = (100 * float(goal[key]) for key in ("low95", "high95"))
    return f"{goal['hits']}/{goal['trials']} = {100 * float(goal['value']):.1f} % ({low:.1f} to {high:.1f})"


def main(score):
    print("| metric | bar | measured (95 %) | |\n|---|---|---|---|")
    for goal in rows(score / "goals.csv"):
        print(f"| {goal['metric']} | {goal['bar']} | {figure(goal)} | {goal['verdict']} |")
    print("\n| set | class, design | hidden | s | said | put first with |\n|---|---|---|---|---|---|")
    for one in rows(score / "worst.csv")[:WORST]:
        print(f"| {int(one['set'])} | {one['class']}, {one['design']} | {one['hidden'].replace('+', ', ')} | "
              f"{float(one['s']):.1f} | {one['said'].replace('+', ', ')} | {float(one['probability']):.2f} |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
