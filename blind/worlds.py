#!/usr/bin/python3
"""usage: blind/worlds.py WORLD --program FATHOM [--seed N] [--sets N] [--jobs N] [--classes null:10,single:10,pair:4,unknown:6]
       blind/worlds.py page SCORE.json...
Judges the diagnosis in a world that is not Fathom's own: has WORLD write one measurement after the other, diagnoses each,
removes its clouds, and scores the answers. WORLD is povray (POV-Ray's rays, OpenCV's matches) or second_laboratory, which
needs the programs of ../shared/second_world. out/blind/WORLD-SEED/ holds truth, answers and score; it goes on where it was
stopped. `page` prints the scores of several packs side by side, the worst first, and of each other world what was found by what was hidden.
Needs Debian's python3-numpy, python3-scipy; the world of POV-Ray also povray and python3-opencv."""
import argparse
import collections
import concurrent.futures
import csv
import fcntl
import itertools
import json
import math
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SECOND = ROOT.parent / "shared" / "second_world" / "make_pack.py"
# Each world's program and what it is asked for besides: designs with many and with few conditions.
WORLDS = {"povray": (ROOT / "blind" / "povray" / "make_pack.py", []),
          "second_laboratory": (SECOND, ["--design", "full,paper,onedist,fewpours", "--strength", "8,40"])}
CLASSES = {"null": 10, "single": 10, "pair": 4, "unknown": 6}
CONFIDENT = 0.9


def ids(names):
    """Effects without the liquid that they are of: id@liquid."""
    return frozenset(name.split("@")[0] for name in names)


def strength(effect, errors):
    """The norm s of an effect's whitened sensitivity: its size beside the standard error of that, which the answer gives. A world
    that reckons strengths by itself is believed. None where nothing is known: no answer, or nothing that the list holds."""
    if "strength" in effect:
        return effect["strength"]
    sizes = effect.get("parameters", {})
    known = {error["parameter"]: error["standard_error"] for error in errors if error["name"] == effect["name"] and "liquid" not in error}
    if effect["name"] == "surface_tilt":
        direction = math.radians(sizes["azimuth_deg"])
        sizes = {"slope_x_deg": sizes["tilt_deg"] * math.cos(direction), "slope_y_deg": sizes["tilt_deg"] * math.sin(direction)}
    elif effect["name"] == "thermal_drift":  # of a cold device nothing is known but what it warms up to
        sizes = {"settled_px": sizes["delta_px"]}
    else:  # both sides have one parameter, by other names
        sizes = dict(zip(known, sizes.values()))
    if not sizes or not set(sizes) <= set(known):
        return None
    return math.hypot(*(size / known[parameter] for parameter, size in sizes.items()))


class Judged:
    """An answer beside its truth, by the rules of blind/judge.cpp."""

    def __init__(self, truth, answer):
        self.kind, self.name = truth["class"], truth["set"]
        self.truth = frozenset(effect["name"] for effect in truth["effects"])
        self.wanted = frozenset(["unknown"]) if self.kind == "unknown" else self.truth
        try:
            report = json.loads((answer / "report.json").read_text())
        except (OSError, ValueError):
            report = {"verdict": "missing"}
        self.verdict = report["verdict"]
        strengths = [strength(effect, report.get("size_errors") or []) for effect in truth["effects"]]
        # A pair is as strong as its weaker effect.
        self.s = None if None in strengths else min(strengths, default=None)
        self.named = ids(effect["name"] for effect in report.get("effects") or []) if "named" in self.verdict else frozenset()
        self.unknown = "unknown" in self.verdict
        # Of each explanation itself with what cannot be told from it, what may be there besides, and their probability.
        self.entries = [([*map(ids, [entry["effects"], *entry.get("indistinguishable", [])])], [*map(ids, entry.get("supersets", []))],
                         entry["probability"]) for entry in report.get("ambiguity_set") or []]

    def right(self):
        if self.kind == "unknown":
            return self.unknown and not self.named
        if self.kind == "null":
            return not self.named
        return self.named == self.wanted or (self.verdict == "ambiguous" and bool(self.entries) and self.entries[0][0][0] == self.wanted)

    def is_strong(self, least=8.0, most=math.inf):
        """Whether s is from least to below most; where it is not known, it counts as large."""
        return least <= (sys.float_info.max if self.s is None else self.s) < most

    def detected(self):
        return self.verdict not in ("none", "insufficient", "missing")

    def leaves_open(self, entry):
        same, more, _ = entry
        return self.wanted in same or self.wanted in more

    def first_holds_truth(self):
        return bool(self.entries) and self.leaves_open(self.entries[0])

    def holds_truth(self):
        return self.named == self.wanted or any(map(self.leaves_open, self.entries))

    def confidently_wrong(self):
        return not self.right() and bool(self.entries) and self.entries[0][2] >= CONFIDENT and not self.first_holds_truth()


def share(metric, judged, hit, bar, at_most):
    """A goal, as in score.json of blind_score; no answer counts as a failure."""
    from scipy.stats import beta
    hits = sum(at_most if one.verdict == "missing" else bool(hit(one)) for one in judged)
    trials = len(judged)
    if not trials:
        return {"metric": metric, "hits": 0, "trials": 0, "value": None, "ci95": [0, 1], "bar": bar, "verdict": "no sets"}
    low = float(beta.ppf(0.025, hits, trials - hits + 1)) if hits else 0.0
    high = float(beta.ppf(0.975, hits + 1, trials - hits)) if hits < trials else 1.0
    value = hits / trials
    sure, met = (high <= bar, value <= bar) if at_most else (low >= bar, value >= bar)
    return {"metric": metric, "hits": hits, "trials": trials, "value": value, "ci95": [low, high], "bar": bar,
            "verdict": "met" if sure else "open" if met else "missed"}


def power_lost(singles):
    """By how much less single effects are detected than by a filter that knows the effect and the errors, at 1 % false alarms."""
    from scipy.stats import norm
    lost = [norm.cdf(one.s - norm.ppf(0.99)) - one.detected() for one in singles if one.s is not None]
    goal = {"metric": "matched filter's power less detected share", "trials": len(lost), "bar": 0.1}
    if not lost:
        return goal | {"value": None, "ci95": [-1, 1], "verdict": "no sets"}
    value = sum(lost) / len(lost)
    error = 1.96 * math.sqrt(sum((one - value) ** 2 for one in lost)) / len(lost)
    return goal | {"value": value, "ci95": [value - error, value + error],
                   "verdict": "met" if value + error <= 0.1 else "open" if value <= 0.1 else "missed"}


def goals(judged):
    def of(*kinds):
        return [one for one in judged if one.kind in kinds]

    def strong(kind, *limits):
        return [one for one in of(kind) if one.is_strong(*limits)]
    return [
        share("answered", judged, lambda one: one.verdict != "missing", 1.0, False),
        share("null set called none", of("null"), lambda one: one.verdict == "none", 0.95, False),
        share("names something on a null set", of("null"), lambda one: one.named, 0.01, True),
        share("calls a null set unknown", of("null"), lambda one: one.unknown, 0.01, True),
        share("single effect first, s 5 to 8", strong("single", 5, 8), Judged.right, 0.90, False),
        share("single effect first, s ≥ 8", strong("single"), Judged.right, 0.97, False),
        share("single effect in what is put first", of("single"), lambda one: one.right() or one.first_holds_truth(), 0.99, False),
        share("pair exact, both s ≥ 8", strong("pair"), Judged.right, 0.90, False),
        share("truth in the ambiguity set", of("single", "pair"), Judged.holds_truth, 0.99, False),
        share("unknown flagged", of("unknown"), lambda one: one.unknown, 0.97, False),
        share("confidently wrong", judged, Judged.confidently_wrong, 0.02, True),
        power_lost(of("single")),
    ]


def run_set(world, number, kind, options, pack):
    """Writes one measurement, diagnoses it, removes its clouds. Returns whether something was done."""
    answer = pack / "answers" / f"{number:04d}"
    if (answer / "report.json").exists() or (answer / "failed.txt").exists():
        return False
    program, extra = WORLDS[world]
    work = pack / "work" / f"{number:04d}"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    one_thread = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    # One set a call, with a seed of its own: so each can be made again alone.
    wrote = subprocess.run(["/usr/bin/python3", "-B", str(program), "--out", str(work / "pack"), "--seed", str(1000 * options.seed + number),
                            "--sets", "1", "--classes", f"{kind}:1", *extra], capture_output=True, text=True, env=one_thread)
    if wrote.returncode:
        lines = wrote.stderr.strip().splitlines() or ["said nothing"]
        raise RuntimeError(f"set {number}: {program.name}: {lines[-1]}")
    truth = json.loads((work / "pack.truth.jsonl").read_text()) | {"set": f"{number:04d}"}
    part = answer.with_suffix(".part")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    run = subprocess.run([options.program, "diagnose", str(work / "pack" / "set_0000"), "-o", str(part), "--threads", "1", "--quiet"],
                         capture_output=True, text=True)
    if run.returncode:
        (part / "failed.txt").write_text(run.stderr)
    (part / "truth.json").write_text(json.dumps(truth) + "\n")
    part.rename(answer)
    if not options.keep:
        shutil.rmtree(work)
    return True


def score(pack, world):
    judged = [Judged(json.loads(file.read_text()), file.parent) for file in sorted((pack / "answers").glob("????/truth.json"))]
    result = goals(judged)
    (pack / "score").mkdir(exist_ok=True)
    (pack / "score" / "score.json").write_text(json.dumps({"pack": pack.name, "world": world, "sets": len(judged), "goals": result}, indent=1) + "\n")
    with open(pack / "score" / "sets.csv", "w", encoding="utf-8") as table:
        table.write("set,class,hidden,s,verdict,named,first,probability,right,not_told,confidently_wrong\n")
        for one in judged:
            first = one.entries[0] if one.entries else ([frozenset()], [], 0)
            table.write(",".join([one.name, one.kind, "+".join(sorted(one.truth)) or "none",
                                  "" if one.s is None else f"{one.s:.1f}", one.verdict, "+".join(sorted(one.named)),
                                  "+".join(sorted(first[0][0])), f"{first[2]:.2f}", str(int(one.right())), str(int(one.right() or one.first_holds_truth())),
                                  str(int(one.confidently_wrong()))]) + "\n")
    for goal in result:
        if goal["trials"]:
            low, high = (100 * limit for limit in goal["ci95"])
            measured = f"{goal['hits']:4} of {goal['trials']:4}" if "hits" in goal else f"{100 * goal['value']:10.1f} %"
            print(f"{goal['metric']:46} {measured}  {low:5.1f} to {high:5.1f} %  {goal['verdict']}")
    print(f"Look at {pack / 'score'}")


def beside(scores):
    """Packs as columns, the one that misses most goals first, and goals as rows; what is missed is bold. Of our own world's
    goals those that other worlds have as well."""
    scores = sorted(scores, key=lambda one: -sum(goal["verdict"] == "missed" for goal in one["goals"]))
    by_metric = [{goal["metric"]: goal for goal in one["goals"]} for one in scores]
    print("| goal | bar | " + " | ".join(one["pack"] for one in scores) + " |\n|" + "---|" * (len(scores) + 2))
    print("| measurements |  | " + " | ".join(str(one["sets"]) for one in scores) + " |")
    for metric in [goal["metric"] for goal in goals([]) if goal["metric"] != "answered"]:
        known = [of.get(metric) for of in by_metric]
        if not any(goal and goal["trials"] for goal in known):
            continue
        one = next(goal for goal in known if goal)
        cells = ["" if not goal or not goal["trials"] else ("**{}**" if goal["verdict"] == "missed" else "{}").format(
            f"{goal['value']:.2f}" if metric.startswith("matched filter") else f"{goal['hits']}/{goal['trials']}") for goal in known]
        at_most = metric.startswith(("names", "calls", "confidently", "matched"))
        print(f"| {metric} | {'≤' if at_most else '≥'} {one['bar']:g} | " + " | ".join(cells) + " |")


def page(files):
    """Tables of several packs' scores: all goals side by side, then of each other world what was found by what was hidden."""
    scores = [{"pack": Path(file).resolve().parent.parent.name} | json.loads(Path(file).read_text()) for file in files]
    beside(scores)
    for file, one in zip(files, scores):
        if one.get("world"):
            by_hidden(one["pack"], Path(file).with_name("sets.csv"))


def by_hidden(pack, file):
    """What of each kind was found, and what was said where it was not."""
    with open(file, encoding="utf-8") as table:
        rows = [row for row in csv.DictReader(table) if row["class"] != "null"]
    rows.sort(key=lambda row: (["single", "pair", "unknown"].index(row["class"]), row["hidden"]))
    print(f"\n| {pack}: hidden | right | truth in what is put first | s of the others | said in its place |\n|---|---|---|---|---|")
    for (kind, hidden), group in itertools.groupby(rows, lambda row: (row["class"], row["hidden"])):
        group = list(group)
        missed = [row for row in group if row["not_told"] == "0"]
        said = collections.Counter(row["named"] if "named" in row["verdict"] else row["verdict"] for row in missed)
        weak = sorted(float(row["s"]) for row in missed if row["s"])
        weak = f"{weak[0]:.1f} to {weak[-1]:.1f}" if len(weak) > 1 else f"{weak[0]:.1f}" if weak else ""
        counts = [f"{sum(row[key] == '1' for row in group)}/{len(group)}" for key in ("right", "not_told")]
        words = ", ".join(name.replace("_", " ").replace("+", " and ") + (f" ({count})" if count > 1 else "") for name, count in said.most_common())
        print(f"| {hidden.replace('_', ' ').replace('+', ' and ')}{' (unknown)' if kind == 'unknown' else ''} | {counts[0]} | {counts[1]} | {weak} | {words} |")


def main():
    if sys.argv[1:2] == ["page"] and len(sys.argv) > 2:
        return page(sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("world", choices=WORLDS)
    parser.add_argument("--program", required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sets", type=int, default=30)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--classes", default=",".join(f"{name}:{weight}" for name, weight in CLASSES.items()))
    parser.add_argument("--keep", action="store_true", help="keep the clouds")
    options = parser.parse_args()
    if options.sets < 1 or options.jobs < 1 or options.seed < 0:
        parser.error("--sets and --jobs are at least 1, --seed at least 0")
    options.program = str(Path(options.program).resolve())
    if not WORLDS[options.world][0].exists():
        print(f"skipped: the programs of {options.world} are not here: {WORLDS[options.world][0]}")
        return None
    weights = {part.split(":")[0]: int((part.split(":") + ["1"])[1]) for part in options.classes.split(",")}
    if not set(weights) <= set(CLASSES):
        parser.error("classes are " + ", ".join(CLASSES))
    # Kinds alternate as their shares are, so that a run that was stopped has some of each.
    order = sorted(((k + 0.5) / weight, name) for name, weight in weights.items() for k in range(weight))
    pack = ROOT / "out" / "blind" / f"{options.world}-{options.seed}"
    pack.mkdir(parents=True, exist_ok=True)
    lock = open(pack / ".lock", "w")  # held while this program lives, so that a kill releases it
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        sys.exit(f"error: {pack}: another run is writing here")
    started, done = time.monotonic(), 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = [pool.submit(run_set, options.world, number, order[number % len(order)][1], options, pack) for number in range(options.sets)]
        for count, run in enumerate(concurrent.futures.as_completed(runs), 1):
            try:
                done += run.result()
            except (OSError, RuntimeError) as problem:
                pool.shutdown(cancel_futures=True)
                sys.exit(f"error: {problem}")
            rate = (time.monotonic() - started) / max(done, 1)
            print(f"diagnosed {count} of {options.sets}, {rate * (options.sets - count) / 60:.0f} min left", end="\r" if sys.stderr.isatty() else "\n",
                  file=sys.stderr, flush=True)
    score(pack, options.world)
    return None


if __name__ == "__main__":
    main()
