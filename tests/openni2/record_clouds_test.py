#!/usr/bin/python3
"""usage: tests/openni2/record_clouds_test.py FATHOM FOLDER_OF_OPENNI2
examples/record_clouds.py records a device that plays a capture: its clouds are the capture's, with the infrared brightness where there is
any. What cannot be recorded gets one line. Skipped (exit code 77) without Debian's python3-numpy."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("... skipped 'python3-numpy is not installed'")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
PROGRAM, OPENNI2 = sys.argv[1:3]


def read_pcd(path):
    head, body = path.read_bytes().split(b"DATA binary\n")
    fields = head.decode().split("FIELDS ")[1].split("\n")[0].split()
    return fields, np.frombuffer(body, "<f4").reshape(480, 640, len(fields))


class RecordClouds(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def record(self, device, into, clouds=1):
        return subprocess.run([ROOT / "examples/record_clouds.py", into, "--clouds", str(clouds), "--interval-s", "0", "--device", device],
                              env=os.environ | {"LD_LIBRARY_PATH": OPENNI2}, capture_output=True, text=True)

    def captured(self, mode):
        shot = self.folder / mode
        subprocess.run([PROGRAM, "capture", ROOT / "scenes/paper_water.json", "--mode", mode, "--quiet", "-o", shot], check=True,
                       stdout=subprocess.DEVNULL)
        recorded = self.record(shot, self.folder / "recorded", clouds=2)
        self.assertEqual((recorded.stderr, recorded.returncode), ("", 0))
        self.assertEqual((self.folder / "recorded/frames.csv").read_text().count("\n"), 3)
        return read_pcd(shot / "cloud.pcd"), read_pcd(self.folder / "recorded/cloud_0001.pcd")

    def test_a_cloud_has_the_captures_points_and_brightness(self):
        (fields, ours), (recorded_fields, recorded) = self.captured("photometric")
        self.assertEqual(recorded_fields, fields)
        np.testing.assert_allclose(recorded[..., :3], ours[..., :3], atol=2e-6)  # [m]; by a field of view in float
        np.testing.assert_allclose(recorded[..., 3], ours[..., 3], atol=0.51)  # whole digital numbers

    def test_a_device_without_infrared_gives_points_alone(self):
        (_, ours), (fields, recorded) = self.captured("geometric")
        self.assertEqual(fields, ["x", "y", "z"])
        np.testing.assert_allclose(recorded, ours[..., :3], atol=2e-6)

    def test_what_cannot_be_recorded_gets_one_line(self):
        scene = ROOT / "scenes/paper_water.json"
        blocked = self.folder / "file"
        blocked.touch()
        for device, into, word in [(self.folder / "none.json", self.folder / "a", "none.json"), (scene, blocked / "a", "file/a")]:
            recorded = self.record(device, into)
            self.assertEqual(recorded.returncode, 1)
            self.assertRegex(recorded.stderr, rf"\Aerror: [^\n]*{word}[^\n]*\n\Z")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
