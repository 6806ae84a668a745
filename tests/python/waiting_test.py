#!/usr/bin/python3
"""What callers may do while something long runs: be told, go on, and end it."""
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import fathom

SOON_S = 10.0  # where the whole work takes minutes

LONG = """
import sys, threading, time
import fathom
threading.Thread(target=lambda: (time.sleep(2), print('runs', flush=True)), daemon=True).start()
try:
    fathom.capture(fathom.scene('paper_milk_tea'), light='full', spp=1024)
except KeyboardInterrupt:
    print('interrupted', flush=True)
"""


class Waiting(unittest.TestCase):
    def test_ctrl_c_ends_a_shot_of_minutes_while_other_threads_run(self):
        process = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "runs\n")
        process.send_signal(signal.SIGINT)
        start = time.monotonic()
        self.assertEqual(process.stdout.readline(), "interrupted\n")
        self.assertLess(time.monotonic() - start, SOON_S)
        self.assertEqual(process.wait(SOON_S), 0)

    def test_what_progress_raises_ends_the_work(self):
        class Enough(Exception):
            pass

        def progress(what, done, total):
            raise Enough(f"{what} {done} of {total}")

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(Enough, "frame .* of 1000"):
                fathom.generate(Path(folder) / "frames", 1000, progress=progress)

    def test_threads_of_python_may_shoot_at_once(self):
        scene = {"sensor": {"model": "xtion_pro_live_device", "height_mm": 650, "pitch_deg": 60}}
        depths = {}

        def shoot(number):
            depths[number] = fathom.capture(scene, mode="geometric").depth

        threads = [threading.Thread(target=shoot, args=(number,)) for number in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len({depth.tobytes() for depth in depths.values()}), 1)
        self.assertEqual(len(depths), 4)

    def test_threads_and_limits_can_be_set(self):
        self.addCleanup(fathom.configure)
        scene = {"sensor": {"model": "xtion_pro_live_device", "height_mm": 650, "pitch_deg": 60}}
        depth = fathom.capture(scene, mode="geometric").depth
        fathom.configure(threads=1)
        self.assertTrue((fathom.capture(scene, mode="geometric").depth == depth).all())
        fathom.configure(max_input_mb=1)
        with self.assertRaisesRegex(fathom.Error, "max-input-mb"):
            fathom.capture(scene)
        with self.assertRaisesRegex(fathom.Error, "threads: must be"):
            fathom.configure(threads=-1)


if __name__ == "__main__":
    unittest.main()
