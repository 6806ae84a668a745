#!/usr/bin/env python3
"""usage: tests/blind/smoke_test.py BLIND_SCORE
What the smoke of the blind tests makes of analysers that are no good: of answers to a pack of its size, written by hand,
whose truth is known. BLIND_SCORE scores them as it scores those of a diagnosis."""
import hashlib
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import smoke

SCORE = None


def hidden(name, s):
    return {"name": name, "parameter": "", "value": 0.0, "s": s, "registered": True, "departure": 1.0}


def truths():
    """As many sets of each class as the smoke's pack has."""
    sets = []

    def add(count, kind, **own):
        for _ in range(count):
            sets.append({"set": len(sets), "seed": len(sets), "class": kind, "design": "full", "effects": [],
                         "book_keeping": "", "left_out": "", "aliased": [], "escape": 0.0, "noise_scale": 1.0,
                         "heavy_tails": False, "strength_by_liquid": {}, **own})

    add(7, "null")
    add(3, "single", effects=[hidden("fill_offset", 12.0)])
    add(4, "single", effects=[hidden("sensor_height", 4.0)])
    add(3, "pair", effects=[hidden("fill_offset", 5.0), hidden("sensor_height", 5.0)])
    add(1, "triple", effects=[hidden("fill_offset", 5.0), hidden("sensor_height", 5.0), hidden("meniscus", 5.0)])
    add(3, "unknown", effects=[hidden("baseline", 20.0)], left_out="baseline", escape=20.0)
    add(1, "unknown", effects=[hidden("baseline", 5.0)], left_out="baseline", escape=5.0)
    add(1, "aliased", effects=[hidden("fill_offset", 9.0)], aliased=["fill_offset", "cup_bottom_height"])
    add(1, "book_keeping", book_keeping="label_swap")
    assert len(sets) == smoke.SETS
    return sets


def report(verdict, *explanations):
    names = list(explanations[0]) if explanations and verdict == "named" else []
    return {"verdict": verdict, "effects": [{"name": name, "parameters": {}} for name in names],
            "ambiguity_set": [{"effects": list(each), "probability": 0.99 / len(explanations)} for each in explanations]}


def oracle(truth):
    names = [effect["name"] for effect in truth["effects"]]
    if truth["class"] == "unknown":
        return report("unknown")
    if truth["class"] == "aliased":
        return report("ambiguous", *[[twin] for twin in truth["aliased"]])
    if truth["book_keeping"]:
        return report("named", [truth["book_keeping"]])
    return report("named", names) if names else report("none", [])


def scored(analyser):
    """The metrics that fail, of answers analyser(truth); None for none."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        pack, truth = root / "pack", root / "truth.json"
        pack.mkdir()
        truth.write_text(json.dumps({"kind": "development", "seed": 1, "sets": truths()}))
        digest = hashlib.sha256(truth.read_bytes()).hexdigest()
        (pack / "pack.json").write_text(json.dumps({"name": "pack", "kind": "development", "truth_sha256": digest,
                                                    "sets": []}))
        for each in truths():
            answer = root / "answers" / f"{each['set']:04}"
            answer.mkdir(parents=True)
            said = analyser(each)
            if said is not None:
                (answer / "report.json").write_text(json.dumps(said))
        subprocess.run([SCORE, pack, root / "answers", "--truth", truth, "-o", root / "score"], check=True,
                       stdout=subprocess.DEVNULL)
        goals = json.loads((root / "score" / "score.json").read_text())["goals"]
        return set(smoke.failures(goals, smoke.SETS))


class Smoke(unittest.TestCase):
    def test_who_knows_everything_passes(self):
        self.assertEqual(scored(oracle), set())

    def test_who_is_silent_always_fails_wherever_something_is_there(self):
        all_but_one_set = set(smoke.POWER) - {"book-keeping found"}
        self.assertEqual(scored(lambda truth: report("insufficient")), all_but_one_set)
        self.assertEqual(scored(lambda truth: report("none")), all_but_one_set)

    def test_who_misses_every_third_single_effect_passes_and_all_of_them_fails(self):
        def misses(nth):
            return lambda truth: report("none") if truth["class"] == "single" and truth["set"] % nth == 0 else oracle(truth)

        self.assertEqual(scored(misses(3)), set())
        self.assertIn("single effect first, s ≥ 8", scored(misses(1)))

    def test_who_names_something_always_fails(self):
        failed = scored(lambda truth: report("named", ["fill_offset"]))
        self.assertLessEqual(set(smoke.SILENCE) - {"calls a null set unknown"}, failed)

    def test_who_always_says_unknown_fails(self):
        self.assertLessEqual({"single effect first, s ≥ 8", "calls a null set unknown"},
                             scored(lambda truth: report("unknown")))

    def test_who_leaves_one_set_without_an_answer_fails(self):
        self.assertEqual(scored(lambda truth: None if truth["set"] == 0 else oracle(truth)), {"answered"})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    SCORE = sys.argv.pop()
    unittest.main()
