"""What is printed of skipped tests, from what ctest really writes."""
import json
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import skipped

TESTS = r"""
add_test(passes "/bin/sh" "-c" "true")
add_test(fails "/bin/sh" "-c" "false")
add_test(scene.Povray "/bin/sh" "-c" "seq 400; echo '/a/povray_test.cpp:118: Skipped'; echo 'no povray in PATH'; echo '[  SKIPPED ] x'")
set_tests_properties(scene.Povray PROPERTIES SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
add_test(python "/bin/sh" "-c" "echo \"test_rays (a.B) ... skipped 'POV-Ray is not installed'\"; echo 'OK (skipped=1)'")
set_tests_properties(python PROPERTIES SKIP_REGULAR_EXPRESSION "OK [(]skipped=")
add_test(silent "/bin/sh" "-c" "exit 77")
set_tests_properties(silent PROPERTIES SKIP_RETURN_CODE 77)
add_test(long "/bin/sh" "-c" "true")
set_tests_properties(long PROPERTIES DISABLED TRUE)
"""


class Skipped(unittest.TestCase):
    def summary(self, tests):
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (root / "CTestTestfile.cmake").write_text(tests)
        # As scripts/test calls it.
        subprocess.run(["ctest", "--output-junit", str(root / "tests.xml"), "--test-output-size-passed", "65536"], cwd=root,
                       check=False, capture_output=True)
        return skipped.summary((root / "tests.xml").read_text())

    def test_each_is_counted_and_says_why(self):
        lines = self.summary(TESTS)
        self.assertEqual(lines[0], "4 of 6 tests were skipped:")
        self.assertIn("  scene.Povray: no povray in PATH", lines)
        self.assertIn("  python: POV-Ray is not installed", lines)
        self.assertTrue(any(line.startswith("  silent: ") for line in lines), lines)
        self.assertTrue(any(line.startswith("  long: takes minutes") for line in lines), lines)
        self.assertEqual(len(lines), 5)

    def test_where_none_is_that_is_said(self):
        self.assertEqual(self.summary('add_test(passes "/bin/sh" "-c" "true")\n'), ["0 of 1 tests were skipped"])

    def test_the_runner_prints_them_and_keeps_its_exit_code(self):
        source = Path(__file__).resolve().parents[1]
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name in ("scripts/test", "tests/skipped.py"):
            (root / name).parent.mkdir(exist_ok=True)
            shutil.copy(source / name, root / name)
        presets = ("release", "sanitize-readers")
        for name in presets:
            (root / "build" / name).mkdir(parents=True)
            (root / "build" / name / "CTestTestfile.cmake").write_text('add_test(passes "/bin/sh" "-c" "true")\n')
        (root / "CMakePresets.json").write_text(json.dumps({
            "version": 6,
            "configurePresets": [{"name": name, "generator": "Ninja", "binaryDir": "${sourceDir}/build/" + name} for name in presets],
            "testPresets": [{"name": name, "configurePreset": name} for name in presets]}))
        for name in ("install-packages", "build"):
            (root / "scripts" / name).write_text("#!/bin/sh\n")
            (root / "scripts" / name).chmod(0o755)
        for tests, code, closing in ((TESTS, 8, "1 tests failed out of 5"),
                                     (TESTS.replace('"false"', '"true"'), 0, "100% tests passed, 0 tests failed out of 5")):
            (root / "build/release/CTestTestfile.cmake").write_text(tests)
            run = subprocess.run(["scripts/test"], cwd=root, check=False, capture_output=True, text=True)
            self.assertEqual(run.returncode, code, run.stdout + run.stderr)
            self.assertIn(closing, run.stdout)
            self.assertEqual(run.stdout.splitlines()[-5], "4 of 6 tests were skipped:")


if __name__ == "__main__":
    unittest.main()
