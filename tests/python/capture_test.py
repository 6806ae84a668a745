#!/usr/bin/python3
"""fathom.capture and fathom.Camera: the program's shots, as arrays over the simulator's own memory."""
import gc
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
import program

import fathom

SMALL = {"model": "xtion_pro_live_device", "height_mm": 650, "aim_mm": [0, 300, 0]}
CUP = {"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 40}
SCENE = {"sensor": SMALL, "cups": [CUP]}


def error_of(test, call, kind=fathom.Error):
    with test.assertRaises(kind) as raised:
        call()
    test.assertNotIn("\n", str(raised.exception))
    return str(raised.exception)


class Warns(unittest.TestCase):
    def test_of_lengths_that_may_be_metres(self):
        with self.assertWarnsRegex(UserWarning, "/cups/0/fill_mm: 0.04 mm; .* were metres meant"):
            fathom.capture({**SCENE, "cups": [{**CUP, "fill_mm": 0.04}]}, mode="geometric")


class SameAsTheProgram(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "scene.json").write_text(json.dumps(SCENE))

    def test_depth_cloud_and_infrared_to_the_last_bit(self):
        for mode in ("photometric", "geometric"):
            with self.subTest(mode=mode):
                program.run("capture", self.folder / "scene.json", "--mode", mode, "--seed", 7, "-o", self.folder / mode)
                cloud = program.pcd(self.folder / mode / "cloud.pcd")
                for scene in (self.folder / "scene.json", str(self.folder / "scene.json"), SCENE):
                    shot = fathom.capture(scene, mode=mode, seed=7)
                    np.testing.assert_array_equal(shot.cloud, cloud[..., :3])
                    np.testing.assert_array_equal(shot.intensity, cloud[..., 3])
                    np.testing.assert_array_equal(shot.depth, np.nan_to_num(cloud[..., 2]))
                self.assertGreater(np.count_nonzero(shot.depth), 100_000)

    def test_the_record_is_run_json(self):
        program.run("capture", self.folder / "scene.json", "--mode", "geometric", "-o", self.folder / "shot")
        run = json.loads((self.folder / "shot/run.json").read_text())
        camera = fathom.Camera(self.folder / "scene.json", mode="geometric")
        for key in set(camera.record) - {"timing"}:
            self.assertEqual(camera.record[key], run[key], key)
        np.testing.assert_array_equal(camera.shoot().camera_matrix, run["camera_matrix"])
        self.assertIn(f"cup 0 paper_cup", " ".join(camera.objects.values()))

    def test_errors_are_the_programs_own_line(self):
        (self.folder / "wrong.json").write_text(json.dumps({"sensor": SMALL, "cups": [{**CUP, "fil_mm": 3}]}))
        for file in ("wrong.json", "absent.json"):
            told = program.error_of("capture", self.folder / file, "-o", self.folder / "out")
            self.assertEqual(error_of(self, lambda: fathom.capture(self.folder / file)), told)


class Arrays(unittest.TestCase):
    def test_they_are_no_copies_and_outlive_the_shot(self):
        shot = fathom.capture(SCENE, mode="geometric")
        depth, points, kept = shot.depth, shot.cloud, shot.depth.copy()
        for array in (shot.depth, shot.disparity_px, shot.cloud, shot.intensity):
            self.assertFalse(array.flags.owndata)
            self.assertEqual(array.dtype, np.float32)
        del shot
        gc.collect()
        fathom.capture(SCENE, mode="geometric", seed=2)
        np.testing.assert_array_equal(depth, kept)
        np.testing.assert_array_equal(np.nan_to_num(points[..., 2]), kept)

    def test_shapes(self):
        shot = fathom.capture(SCENE)
        self.assertEqual([shot.ir.shape, shot.depth.shape, shot.cloud.shape], [(1024, 1280), (480, 640), (480, 640, 3)])
        self.assertIsNone(fathom.capture(SCENE, mode="geometric").ir)

    def test_frames_differ_by_noise_and_come_again(self):
        camera = fathom.Camera(SCENE)
        first, second, again = camera.shoot(0), camera.shoot(1), camera.shoot(0)
        self.assertTrue((first.ir != second.ir).any())
        np.testing.assert_array_equal(first.depth, again.depth)

    def test_the_camera_matrix_and_the_pose_take_depth_to_the_truth(self):
        exact = {**SMALL, "model": "xtion_pro_live", "quantization": "off", "noise": "off"}
        camera = fathom.Camera({"sensor": exact}, mode="geometric")
        shot = camera.shoot()
        rows, columns = np.indices(shot.depth.shape) + 0.5
        pixels = np.stack([columns, rows, np.ones_like(rows)], axis=-1)
        points = shot.depth[..., None] * (pixels @ np.linalg.inv(shot.camera_matrix).T)
        world = points @ shot.world_from_camera[:3, :3].T + shot.world_from_camera[:3, 3]
        seen = shot.depth > 0
        self.assertGreater(seen.mean(), 0.5)
        np.testing.assert_allclose(world[seen], camera.truth.position[seen], atol=1e-5)
        np.testing.assert_allclose(shot.depth[seen], camera.truth.apparent_depth[seen], rtol=1e-5)


class Scenes(unittest.TestCase):
    def test_objects_and_arrays_stand_for_their_keys(self):
        written = {"sensor": {**SMALL, "noise": {"read_dn": 2.0}, "matcher": {"window_rows": 11}}, "desk": None, "cups": [CUP]}
        built = {"sensor": fathom.Sensor(**{**SMALL, "aim_mm": np.array([0.0, 300, 0])}, noise=fathom.Noise(read_dn=np.float64(2)),
                                         matcher=fathom.Matcher(window_rows=np.int64(11))), "desk": None, "cups": (CUP,)}
        np.testing.assert_array_equal(fathom.capture(built, mode="geometric").depth, fathom.capture(written, mode="geometric").depth)

    def test_a_sensor_has_all_its_keys_and_is_the_same_when_written_out(self):
        whole = fathom.sensor(**SMALL)
        self.assertEqual((whole.height_mm, whole.matcher.method, whole.baseline_mm), (650, "device", 75.0))
        np.testing.assert_array_equal(fathom.capture({"sensor": whole, "cups": [CUP]}, mode="geometric").depth,
                                      fathom.capture(SCENE, mode="geometric").depth)
        self.assertEqual(fathom.Camera({"sensor": whole}, mode="geometric").sensor.matcher, whole.matcher)

    def test_every_key_of_the_program_is_an_attribute(self):
        for table in program.run_json("list", "keys"):
            name = "".join(word.capitalize() for word in table["definition"].split("_"))
            if table["file"] != "scene" or not hasattr(fathom.config, name or "absent"):
                continue  # cups, liquids and objects are dictionaries
            keys = {key["key"]: key for key in table["keys"]}
            self.assertEqual(list(getattr(fathom, name).__dataclass_fields__), list(keys))
            for key in keys:
                self.assertIn(f"    {key}: ", getattr(fathom, name).__doc__)

    def test_what_is_wrong_names_its_place(self):
        with_cup = lambda **keys: {"sensor": SMALL, "cups": [{**CUP, **keys}]}
        for scene, told in ((with_cup(fil_mm=3), "scene: /cups/0"), (with_cup(fill_mm=np.nan), "scene: /cups/0/fill_mm"),
                            (with_cup(liquid="wtaer"), "unknown liquid 'wtaer', choose from"), ({"cups": []}, "sensor"),
                            ({"sensor": fathom.Sensor(**SMALL, matcher=fathom.Matcher(window_rows=10))}, "/sensor/matcher/window_rows: must be odd"),
                            ({"sensor": SMALL, "cups": [{CUP["shape"]}]}, "scene: cannot hold"), ({1: 2}, "keys must be texts"),
                            ({"sensor": SMALL, "objects": [{"gltf": "absent.gltf"}]}, "/objects/0/gltf: there is no file"),
                            ([], "scene"), (None, "scene"), (3, "scene")):
            self.assertIn(told, error_of(self, lambda: fathom.capture(scene)), scene)
        with self.assertRaises(AttributeError):
            fathom.Matcher().window_row = 9
        with self.assertRaises(TypeError):
            fathom.Matcher(window_row=9)
        circle = {}
        circle["sensor"] = circle
        error_of(self, lambda: fathom.capture(circle), RecursionError)

    def test_arguments_out_of_range(self):
        for wrong, told in (({"mode": "fast"}, "unknown mode 'fast', choose from geometric, photometric"),
                            ({"light": "some"}, "unknown light"), ({"spp": 0}, "spp: must be"), ({"seed": -1}, "seed: must be"),
                            ({"model": "absent.json"}, "absent.json")):
            self.assertIn(told, error_of(self, lambda: fathom.capture(SCENE, **wrong)))

    def test_libraries(self):
        self.assertEqual(fathom.names("sensors"), sorted(program.run_json("list", "sensors")))
        self.assertIn("fill_scale", fathom.names("effects"))
        self.assertIn("choose from cups", error_of(self, lambda: fathom.names("mugs")))
        self.assertIn("paper_water", error_of(self, lambda: fathom.scene("paper_watre")))


if __name__ == "__main__":
    unittest.main()
