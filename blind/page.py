#!/usr/bin/env python3
"""usage: blind/page.py [beside] SCORE
Prints what scripts/blind --baselines left in SCORE as the tables of docs/blind.md: the goals with their verdicts, simpler
methods on the same measurements, which effects were found, what was made of unknown things, and the worst answers. With
beside only the shares of SCORE/score.json and those of simpler methods, SCORE/METHOD/score.json, in columns."""
import csv
import json
import sys
from collections import defaultdict
from pathlib import Path

METRICS = ["names something on a null set", "single effect first, s 5 to 8", "single effect first, s ≥ 8",
           "pair exact, both s ≥ 8", "triple exact", "confidently wrong"]
WORST = 12
WEAKEST = 5.0  # s, and escape: below it nothing is expected
MEANS = ("mean size", "gap closed", "held-out RMS", "matched filter", "a bank of", "localisation")


def rows(file):
    with open(file, encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


def shares(file):
    goals = {goal["metric"]: goal for goal in json.loads(file.read_text())["goals"]}
    return [f"{goals[m]['hits']}/{goals[m]['trials']}" if goals[m]["trials"] else "–" for m in METRICS]


def columns(score):
    """Each method's shares by its name, Fathom's first; nothing where no other method answered."""
    methods = sorted(file.parent for file in score.glob("*/score.json"))
    return {"Fathom": shares(score / "score.json")} | {m.name: shares(m / "score.json") for m in methods} if methods else {}


def print_beside(score):
    beside = columns(score)
    print(f"\n{'beside simpler methods':46}" + "".join(f"{name:>21}" for name in beside))
    for row, metric in enumerate(METRICS):
        print(f"{metric:46}" + "".join(f"{column[row]:>21}" for column in beside.values()))


def table(head, lines):
    print(f"| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for line in lines:
        print(f"| {' | '.join(line)} |")
    print()


def figure(goal):
    if goal["trials"] == "0":
        return "–", "–"
    if goal["metric"].startswith(MEANS):
        low, high = goal["low95"], goal["high95"]
        return f"{float(goal['value']):.2f}", "–" if low == high else f"{float(low):.2f} to {float(high):.2f}"
    return f"{goal['hits']}/{goal['trials']}", f"{100 * float(goal['low95']):.1f} to {100 * float(goal['high95']):.1f} %"


def words(names):
    return names.replace("+", ", ").replace("_", " ")


def found_by_effect(sets):
    """Of single effects that show: how often each came first, and what was said in its place."""
    by_effect = defaultdict(list)
    for one in sets:
        if one["class"] == "single" and one["hidden"] != "none" and float(one["s"]) >= WEAKEST:
            by_effect[one["hidden"]].append(one)
    share = {name: sum(int(one["right"]) for one in ones) / len(ones) for name, ones in by_effect.items()}
    for name in sorted(by_effect, key=lambda name: (share[name], name)):
        ones = by_effect[name]
        yield [words(name), f"{sum(int(one['right']) for one in ones)}/{len(ones)}", instead(ones)]


def unknown_by_kind(sets):
    by_kind = defaultdict(list)
    for one in sets:
        if one["class"] == "unknown" and float(one["escape"]) >= WEAKEST:
            by_kind[one["hidden"]].append(one)
    for name, ones in sorted(by_kind.items()):
        flagged = sum("unknown" in one["verdict"] for one in ones)
        yield [words(name.removesuffix(" (unknown)")), f"{flagged}/{len(ones)}", instead(ones)]


def instead(ones):
    """What was said where it was not right: the commonest first."""
    counts = defaultdict(int)
    for one in ones:
        if not int(one["right"]):
            counts[one["said"]] += 1
    return "; ".join(f"{words(said)}{f' ({count})' if count > 1 else ''}" for said, count in sorted(counts.items(), key=lambda item: -item[1]))


def main(score):
    table(["metric", "goal", "measured", "95 %", "verdict"],
          [[goal["metric"], goal["bar"], *figure(goal), goal["verdict"]] for goal in rows(score / "goals.csv")])
    if beside := columns(score):
        table(["on the same measurements", *beside], [[metric, *(column[row] for column in beside.values())] for row, metric in enumerate(METRICS)])
    sets = rows(score / "sets.csv")
    table([f"single effect, s ≥ {WEAKEST:.0f}", "first", "said in its place"], found_by_effect(sets))
    table([f"unknown, escape ≥ {WEAKEST:.0f}", "flagged", "said in its place"], unknown_by_kind(sets))
    table(["set", "class", "design", "hidden", "s", "said", "probability of what is first"],
          [[str(int(one["set"])), one["class"], words(one["design"]), words(one["hidden"]), f"{float(one['s']):.1f}", words(one["said"]),
            f"{float(one['probability']):.2f}"] for one in rows(score / "worst.csv")[:WORST]])
    score = json.loads((score / "score.json").read_text())
    print(f"{score['sets']} sets; truth {score['truth_sha256'][:12]}…")


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "beside":
        print_beside(Path(sys.argv[2]))
    elif len(sys.argv) == 2:
        main(Path(sys.argv[1]))
    else:
        sys.exit(__doc__)
