"""The check of the layers catches what it is there to catch."""
import tempfile
import unittest
from pathlib import Path

import layers


class Layers(unittest.TestCase):
    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.write("core/error.h", "#pragma once\n")
        self.write("sim/scene/scene.h", '#pragma once\n#include "core/error.h"\n')

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def assert_only_breach(self, *words):
        found = list(layers.breaches(self.root))
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])

    def test_a_tree_that_keeps_the_rules_passes(self):
        self.write("sim/sensor/capture.cpp", '#include "sim/scene/scene.h"\n')
        self.write("sim/render/mesh.cpp", "#include <embree3/rtcore.h>\n")
        self.write("tests/sim/render/mesh_test.cpp", '#include "sim/scene/scene.h"\n')
        self.assertEqual(list(layers.breaches(self.root)), [])

    def test_a_forbidden_include_is_caught(self):
        self.write("detector/cup_gates.cpp", '\n#include "sim/scene/scene.h"\n')
        self.assert_only_breach("detector/cup_gates.cpp:2", "sim/scene/scene.h")

    def test_two_types_of_one_name_are_caught(self):
        self.write("detector/desk.h", "#pragma once\nnamespace fathom {\nstruct Desk;\nstruct Desk {\n  int a;\n};\n}\n")
        self.write("sim/scene/desk.h", "#pragma once\nnamespace fathom::scene {\nstruct Desk {\n  int a;\n};\n}\n")
        self.assertEqual(list(layers.breaches(self.root)), [])
        self.write("sim/render/desk.h", "#pragma once\nnamespace fathom {\nclass Desk final {\n  double a;\n};\n}\n")
        self.assert_only_breach("sim/render/desk.h", "fathom::Desk", "detector/desk.h")

    def test_the_oracle_includes_nothing_of_ours(self):
        self.write("theory/triangulation.cpp", '  #  include <core/error.h>\n')
        self.assert_only_breach("theory/triangulation.cpp:1", "only: nothing")

    def test_a_library_outside_its_border_is_caught(self):
        for path, header in (
            ("detector/plane.h", "pcl/point_types.h"),
            ("sim/scene/mesh.cpp", "embree3/rtcore.h"),
            ("sim/render/gltf.cpp", "tiny_gltf.h"),
            ("sim/sensor/exr.cpp", "OpenEXR/ImfHeader.h"),
            ("app/picture.cpp", "png.h"),
            ("core/options.cpp", "CLI/CLI.hpp"),
            ("sim/sensor/match.cpp", "opencv2/calib3d.hpp"),
        ):
            with self.subTest(header):
                self.write(path, f"#pragma once\n#include <{header}>\n")
                self.assert_only_breach(f"{path}:2", header)
                (self.root / path).unlink()

    def test_an_include_that_does_not_start_at_the_root_is_caught(self):
        self.write("core/files.cpp", '#include "error.h"\n')
        self.assert_only_breach("core/files.cpp:1", "from the root")

    def test_a_header_without_pragma_once_is_caught(self):
        self.write("core/error.h", "// nothing\n")
        self.assert_only_breach("core/error.h", "#pragma once")

    def test_what_prints_past_the_program_s_own_way_is_caught(self):
        self.write("app/print.cpp", 'fmt::print("{}", text);\n')
        self.write("app/capture.cpp", 'const auto text = fmt::format("{}", 1);\n// fmt::print(text)\n')
        self.assertEqual(list(layers.breaches(self.root)), [])
        self.write("app/capture.cpp", '\nfmt::print("{}", text);\n')
        self.assert_only_breach("app/capture.cpp:2", "app/print.h")

    def test_a_folder_outside_the_table_is_caught(self):
        self.write("misc/helper.h", "#pragma once\n")
        self.assert_only_breach("misc/helper.h", "not in the table")


if __name__ == "__main__":
    unittest.main()
