"""The figures of docs/results.md: the page is what scripts/results makes of them, and figures that differ are told of."""
import importlib.machinery
import importlib.util
import os
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOADER = importlib.machinery.SourceFileLoader("results", str(ROOT / "scripts" / "results"))
results = importlib.util.module_from_spec(importlib.util.spec_from_loader("results", LOADER))
LOADER.exec_module(results)


class Page(unittest.TestCase):
    def test_is_what_the_claims_say(self):
        self.assertEqual(results.page(results.claims()), results.PAGE.read_text(encoding="utf-8"), "scripts/results makes it")

    def test_other_pages_say_the_same(self):
        self.assertEqual(list(results.missing_texts(results.claims())), [])

    def test_every_claim_has_a_place(self):
        made = results.page(results.claims())
        for name, claim in results.claims().items():
            self.assertTrue(claim["claim"] in made or claim.get("texts"), name)


class Figures(unittest.TestCase):
    def test_are_compared_with_what_is_printed(self):
        figure = {"value": 2.5, "tolerance": 0.1, "reads": r"height ([0-9.]+) mm"}
        self.assertEqual(results.judged(figure, "height 2.6 mm"), (True, "2.6, was 2.5 ± 0.1"))
        self.assertFalse(results.judged(figure, "height 2.7 mm")[0])
        self.assertFalse(results.judged(figure, "nothing")[0])
        self.assertTrue(results.judged({"at_most": 0.2, "reads": "([0-9.]+)"}, "0.2")[0])
        self.assertFalse(results.judged({"at_least": 0.9, "reads": "([0-9.]+)"}, "0.8")[0])

    def test_that_take_seconds_are_as_they_were(self):
        if "FATHOM" not in os.environ:
            self.skipTest("FATHOM does not name the program")
        self.assertEqual(results.check(["paper_largest_skew", "paper_height_through_30_mm_of_water", "story"], results.claims()), 0)

    def test_a_name_that_is_none_is_told_of(self):
        with self.assertRaisesRegex(results.Problem, "there is no claim nothing"):
            results.check(["nothing"], results.claims())


if __name__ == "__main__":
    unittest.main()
