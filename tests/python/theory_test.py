#!/usr/bin/python3
"""fathom.theory: the program's numbers, for arrays of any shape."""
import csv
import unittest

import numpy as np
import program

import fathom


class Theory(unittest.TestCase):
    def test_it_says_what_the_program_says(self):
        rows = list(csv.DictReader(program.run("theory", "--lateral-mm", "0,50", "--pitch-deg", "40").splitlines()))
        column = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
        ours = fathom.theory(column["fill_mm"], column["distance_mm"], column["lateral_mm"], pitch_deg=40)
        for name in ("eq7_mm", "exact_mm", "incidence_projector_deg", "incidence_camera_deg", "epipolar_px"):
            np.testing.assert_allclose(getattr(ours, name), column[name], rtol=0, atol=5.1e-7, err_msg=name)

    def test_arguments_broadcast(self):
        grid = fathom.theory(np.array([10.0, 20.0, 30.0])[:, None], [200, 400])
        self.assertEqual(grid.exact_mm.shape, (3, 2))
        self.assertEqual(grid.exact_mm[2, 1], fathom.theory(30, 400).exact_mm)
        self.assertEqual(fathom.theory([], 400).eq7_mm.shape, (0,))

    def test_on_the_bisector_without_skew_both_agree_to_a_hundredth(self):
        both = fathom.theory(30, 200, baseline_mm=1e-3)
        np.testing.assert_allclose(both.eq7_mm, both.exact_mm, rtol=0.01)
        self.assertEqual(fathom.theory(30, 400, index=1.0).exact_mm.round(9), 0.0)

    def test_what_cannot_be_is_an_error_of_one_line(self):
        for wrong in (dict(fill_mm=700, distance_mm=400), dict(fill_mm=np.nan, distance_mm=400), dict(fill_mm=30, distance_mm=400, index=0.5),
                      dict(fill_mm="much", distance_mm=400), dict(fill_mm=[1, 2], distance_mm=[1, 2, 3])):
            with self.assertRaises(fathom.Error, msg=wrong) as raised:
                fathom.theory(**wrong)
            self.assertNotIn("\n", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
