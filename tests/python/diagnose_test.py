#!/usr/bin/python3
"""fathom.diagnose: the program's diagnosis, with its observations as arrays."""
import csv
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
import program

import fathom

# A laboratory whose cups hold 15 % more than it wrote down.
SPEC = {"sensor": {"model": "xtion_pro_live_device", "height_mm": 650, "aim_mm": [0, 300, 0]}, "cup": {"shape": "paper_cup"},
        "liquids": {"water": "water", "paint": {"index": 1.336, "absorption_per_mm": 0.003, "scattering_per_mm": 1000}},
        "fillings": [{"liquid": "empty"}, {"liquid": "water", "fill_mm": 40}, {"liquid": "paint", "fill_mm": 30}],
        "distance_mm": [200, 300], "lateral_mm": [0], "bare_desk_views": 2, "pours": 2, "trials": 2, "mode": "geometric",
        "effects": [{"name": "fill_scale", "scale": 0.15}]}


class Diagnose(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        (cls.folder / "spec.json").write_text(json.dumps(SPEC))
        program.run("campaign", cls.folder / "spec.json", "-o", cls.folder / "measured")
        program.run("diagnose", cls.folder / "measured", "-o", cls.folder / "out")
        cls.told = []
        cls.found = fathom.diagnose(cls.folder / "measured", progress=lambda *news: cls.told.append(news))

    def test_it_is_the_programs_diagnosis(self):
        report = json.loads((self.folder / "out/report.json").read_text())
        report.pop("provenance")
        self.assertEqual(self.found.report, report)
        self.assertEqual((self.found.verdict, self.found.answer), (report["verdict"], report["answer"]))

    def test_the_posterior_is_whole_and_names_the_effect(self):
        self.assertAlmostEqual(sum(row.probability for row in self.found.posterior), 1, places=6)
        self.assertEqual(self.found.posterior[0].effects, ("fill_scale",))
        self.assertTrue(self.found.posterior[0].words)

    def test_residuals_are_the_columns_of_residuals_csv(self):
        with open(self.folder / "out/residuals.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        residuals = self.found.residuals
        self.assertEqual(list(residuals.__dataclass_fields__), list(rows[0]))
        for name in rows[0]:
            column, written = getattr(residuals, name), [row[name] for row in rows]
            self.assertEqual(column.shape, (len(rows),), name)
            if column.dtype.kind == "U":
                self.assertEqual(column.tolist(), written, name)
            else:
                np.testing.assert_allclose(column, np.array(written, float), rtol=1e-4, atol=1e-12, err_msg=name)
        heights = residuals.observable == "height_mm"
        self.assertLess(np.square(residuals.after[heights]).mean(), np.square(residuals.before[heights]).mean())

    def test_progress_was_told(self):
        self.assertTrue(self.told)
        for what, done, total in self.told:
            self.assertIsInstance(what, str)
            self.assertTrue(0 < done <= total)

    def test_effects_can_be_left_out(self):
        without = fathom.diagnose([self.folder / "measured"], without="fill_scale")
        self.assertNotIn("fill_scale", {name for row in without.posterior for name in row.effects})

    def test_what_is_wrong_is_the_programs_line(self):
        told = program.error_of("diagnose", self.folder / "absent", "-o", self.folder / "none")
        for call, line in ((lambda: fathom.diagnose(self.folder / "absent"), told),
                           (lambda: fathom.diagnose([]), "folders: must name at least one measurement folder")):
            with self.assertRaises(fathom.Error) as raised:
                call()
            self.assertEqual(str(raised.exception), line)
        for keys in ({"without": ["magic"]}, {"fidelity": "best"}, {"seed": -1}, {"model": "absent.json"}):
            with self.assertRaises(fathom.Error):
                fathom.diagnose(self.folder / "measured", **keys)


if __name__ == "__main__":
    unittest.main()
