#!/usr/bin/python3
"""fathom.calibrate and fathom.generate: the program's files."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
import program

import fathom


class InFolders(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)


class Calibrate(InFolders):
    def desk(self, serial):
        sensor = {"model": "xtion_pro_live_device", "height_mm": 650, "pitch_deg": 60, "unit": {"serial": 3, "residue_px": 0.1}}
        file = self.folder / f"desk_{serial}"
        (self.folder / "desk.json").write_text(json.dumps({"sensor": sensor}))
        program.run("capture", self.folder / "desk.json", "--mode", "geometric", "--seed", serial, "-o", file)
        return file / "cloud.pcd"

    def test_it_writes_the_programs_unit_and_shows_its_maps(self):
        clouds = [self.desk(1), self.desk(2)]
        program.run("calibrate", *clouds, "-o", self.folder / "theirs")
        told = []
        unit = fathom.calibrate(clouds, progress=lambda *news: told.append(news))
        self.assertEqual(unit.save(self.folder / "ours"), self.folder / "ours/unit.json")
        for name in ("unit.json", "unit_bias.exr"):
            self.assertEqual((self.folder / "ours" / name).read_bytes(), (self.folder / "theirs" / name).read_bytes(), name)
        self.assertEqual(told[-1], ("calibrate", 2, 2))
        self.assertEqual(unit.bias_px.shape, (480, 640))
        self.assertFalse(unit.bias_px.flags.owndata)
        self.assertTrue(unit.seen.any())
        self.assertTrue((unit.sigma_px > 0).all())
        bias = unit.bias_px
        del unit
        self.assertTrue(np.isfinite(bias).all())
        (self.folder / "scene.json").write_text(json.dumps(
            {"sensor": {"model": "xtion_pro_live_device", "height_mm": 650, "pitch_deg": 60, "unit": "ours/unit.json"}}))
        self.assertTrue((fathom.capture(self.folder / "scene.json", mode="geometric").depth > 0).any())

    def test_what_is_wrong_is_one_line(self):
        for call in (lambda: fathom.calibrate([]), lambda: fathom.calibrate("absent.pcd"), lambda: fathom.calibrate("absent.csv"),
                     lambda: fathom.calibrate("absent.pcd", height_mm=650), lambda: fathom.calibrate("absent.pcd", interval_s=-1)):
            with self.assertRaises(fathom.Error) as raised:
                call()
            self.assertNotIn("\n", str(raised.exception))


class Generate(InFolders):
    def test_it_makes_the_programs_frames_once(self):
        program.run("generate", "--frames", 2, "--seed", 5, "-o", self.folder / "theirs")
        told = []
        made = fathom.generate(self.folder / "ours", 2, seed=5, progress=lambda *news: told.append(news))
        self.assertEqual((made.frames, made.made_now, made.is_complete), (2, 2, True))
        self.assertEqual(told[-1], ("frame", 2, 2))
        pictures = sorted(file.relative_to(self.folder / "theirs") for file in (self.folder / "theirs").rglob("*.png"))
        self.assertGreater(len(pictures), 6)
        for picture in pictures:
            self.assertEqual((self.folder / "ours" / picture).read_bytes(), (self.folder / "theirs" / picture).read_bytes(), picture)
        self.assertEqual(fathom.generate(self.folder / "ours", 2, seed=5).made_now, 0)

    def test_specifications_may_be_objects(self):
        spec = {"cups": {"number": [1, 1]}, "objects": {"number": [0, 0]}, "empty": 1}
        (self.folder / "spec.json").write_text(json.dumps(spec))
        for name, given in (("file", self.folder / "spec.json"), ("object", spec)):
            self.assertTrue(fathom.generate(self.folder / name, 1, spec=given).is_complete)
        depth = "train/000000/depth/000000.png"
        self.assertEqual((self.folder / "file" / depth).read_bytes(), (self.folder / "object" / depth).read_bytes())

    def test_what_is_wrong_is_one_line_and_makes_nothing(self):
        for keys in ({"frames": 0}, {"shard": (2, 2)}, {"spec": {"cupps": 1}}, {"spec": "absent.json"}, {"spec": []}, {"seed": -1}):
            with self.assertRaises(fathom.Error) as raised:
                fathom.generate(self.folder / "none", **keys)
            self.assertNotIn("\n", str(raised.exception))
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main()
