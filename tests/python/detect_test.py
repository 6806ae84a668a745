#!/usr/bin/python3
"""fathom.detect: what the program finds, in files and arrays."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
import program

import fathom


class Detect(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        program.run("capture", fathom.scene("paper_water"), "-o", cls.folder.name)
        cls.file = Path(cls.folder.name) / "cloud.pcd"
        cls.shot = fathom.capture(fathom.scene("paper_water"))

    def assert_same(self, found, told):
        self.assertEqual(len(found.cups), len(told["cups"]))
        self.assertEqual(found.segments, told["segments"])
        for ours, cup in zip(found.cups, told["cups"]):
            np.testing.assert_array_equal(ours.center_camera_m, cup.pop("center_camera_m"))
            self.assertEqual(ours.points_inside, cup.pop("points"))
            for key, value in cup.items():
                self.assertEqual(getattr(ours, key), value, key)
        np.testing.assert_array_equal(found.plane.normal, told["plane"]["normal"])

    def test_files_shots_and_arrays_give_what_the_program_says(self):
        for method in ("robust", "paper"):
            told = json.dumps(program.run_json("detect", self.file, "--method", method))
            image = self.shot.cloud
            for cloud in (self.file, self.shot, image.astype(np.float64)):
                intensity = self.shot.intensity if isinstance(cloud, np.ndarray) else None
                self.assert_same(fathom.detect(cloud, intensity, method=method), json.loads(told))
        found = fathom.detect(self.shot)
        self.assertEqual((len(found.cups), found.cups[0].liquid), (1, "yes"))

    def test_points_in_a_row_do_as_well(self):
        measured = self.shot.cloud[np.isfinite(self.shot.cloud[..., 2])]
        found = fathom.detect(measured, height_mm=650, pitch_deg=58.39)
        self.assertEqual(len(found.cups), 1)
        self.assertAlmostEqual(found.plane.height_mm, 650, delta=3)

    def test_a_cups_points_stand_on_the_desk_around_its_axis(self):
        found = fathom.detect(self.shot)
        cup, turn = found.cups[0], found.desk_from_camera
        points = 1000 * (cup.points @ turn[:3, :3].T + turn[:3, 3])
        axis = 1000 * (turn[:3, :3] @ cup.center_camera_m + turn[:3, 3])
        self.assertAlmostEqual(axis[2], 45, delta=0.1)
        self.assertLess(np.linalg.norm(points[:, :2] - axis[:2], axis=1).max(), 2 * cup.radius_mm)
        self.assertGreater(points[:, 2].max(), 60)

    def test_read_cloud_keeps_the_image(self):
        points, intensity = fathom.read_cloud(self.file)
        np.testing.assert_array_equal(points, self.shot.cloud)
        np.testing.assert_array_equal(intensity, self.shot.intensity)

    def test_parameters_are_those_of_the_file(self):
        config = {"robust": {"height_mm": [20, 60]}}
        file = Path(self.folder.name) / "config.json"
        file.write_text(json.dumps(config))
        for given in (config, file, str(file)):
            self.assertEqual(fathom.detect(self.shot, config=given).cups, [])

    def test_clouds_without_a_desk_say_why(self):
        for cloud in (np.full((480, 640, 3), np.nan), np.zeros((100, 3)), np.empty((0, 3)), np.full((5, 3), np.inf)):
            found = fathom.detect(cloud)
            self.assertIsNone(found.plane)
            self.assertTrue(found.why)

    def test_a_cloud_in_millimetres_is_warned_of(self):
        with self.assertWarnsRegex(UserWarning, "is this one in millimetres"):
            fathom.detect(1000.0 * self.shot.cloud)

    def test_what_is_wrong_is_one_line(self):
        flat = np.zeros((10, 3))
        for arguments, told in (((np.zeros((4, 2)),), "got the shape (4, 2)"), ((np.zeros(3),), "n x 3"), ((np.zeros((2, 2, 2, 3)),), "n x 3"),
                                (("absent.pcd",), "absent.pcd"), ((flat, np.zeros(9)), "intensity: must be one number for each of 10"),
                                ((["a"],), "cloud: must be numbers")):
            with self.assertRaisesRegex(fathom.Error, told.replace("(", r"\(").replace(")", r"\)")):
                fathom.detect(*arguments)
        for keys, told in (({"method": "best"}, "unknown method 'best'"), ({"height_mm": 650}, "belong together"),
                           ({"height_mm": np.nan, "pitch_deg": 3}, "height_mm: must be"), ({"config": {"plane": 1}}, "config: /plane: unknown key"),
                           ({"config": "absent.json"}, "absent.json")):
            with self.assertRaises(fathom.Error) as raised:
                fathom.detect(flat, **keys)
            self.assertIn(told, str(raised.exception))


if __name__ == "__main__":
    unittest.main()
