#!/usr/bin/env python3
"""usage: tests/app/progress_test.py FATHOM
On a terminal: whoever waits longer than two seconds sees that the program works, and results have lines of their own."""
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scenes")
CLEAR = "\r\x1b[K"


def on_terminal(*words, until=None):
    """All that a terminal gets of stdout and stderr; with `until`, when that has come the program is stopped."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen([PROGRAM, *words], stdout=theirs, stderr=theirs, stdin=subprocess.DEVNULL)
    os.close(theirs)
    text = b""
    while True:
        try:
            got = os.read(ours, 65536)
        except OSError:  # the program has closed its end
            break
        if not got:
            break
        text += got
        if until and until.encode() in text:
            process.kill()
            break
    os.close(ours)
    assert process.wait() == (-signal.SIGKILL if until else 0), text
    return text.decode().replace("\r\n", "\n")


class Progress(unittest.TestCase):
    def test_every_result_has_a_line_of_its_own(self):
        cloud = os.path.join(SCENES, "templates/paper_cup.pcd")
        text = on_terminal("detect", *[cloud] * 4)
        self.assertIn("detect 1/4  ", text)
        seen = [line.split(CLEAR)[-1] for line in text.split("\n")]  # what stays when the terminal is done
        self.assertEqual([line for line in seen if line and not re.match(r"[a-z0-9_]+ +\S|warning: ", line)], [])
        self.assertEqual([line for line in seen if line.startswith("detect ")], [])

    def test_one_long_shot_says_that_it_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            running = "capture  2 s" + CLEAR
            text = on_terminal("capture", os.path.join(SCENES, "glass_water.json"), "--light", "full", "-o", folder, until=running)
        self.assertIn(running, text)

    def test_quiet_says_nothing(self):
        cloud = os.path.join(SCENES, "templates/paper_cup.pcd")
        self.assertNotIn(CLEAR, on_terminal("detect", *[cloud] * 4, "--quiet"))


if __name__ == "__main__":
    unittest.main()
