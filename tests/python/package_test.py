#!/usr/bin/python3
"""The package as others get it: stubs that agree with the module, types, docstrings, examples, and a wheel that works alone."""
import importlib.util
import inspect
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import program

import fathom

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/python"
PICTURE_PIXELS = 200_000


def run(*words, **keys):
    result = subprocess.run([sys.executable, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **keys)
    assert result.returncode == 0, result.stdout
    return result.stdout


@unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
class Types(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = holder.name

    def mypy(self, module, *words):
        package = Path(fathom.__file__).parent.parent
        return run("-m", module, *words, cwd=self.folder, env={**os.environ, "MYPYPATH": str(package), "MYPY_CACHE_DIR": self.folder})

    def test_the_stubs_are_the_modules(self):
        """All but what pybind11 brings: a metaclass, and a constructor of what only functions make. Its functions have no
        signatures that stubtest could read; their arguments are compared below."""
        allowed = Path(self.folder) / "allowed"
        allowed.write_text("fathom._fathom.Camera\nfathom._fathom.Unit\nfathom._fathom.Unit.__init__\n")
        self.mypy("mypy.stubtest", "--allowlist", allowed, "fathom._fathom")

    def test_arguments_of_the_stubs_are_the_modules(self):
        import ast
        stubs = ast.parse((Path(fathom.__file__).parent / "_fathom.pyi").read_text())
        for node in ast.walk(stubs):
            if isinstance(node, ast.ClassDef) and node.name != "Error":
                owner = getattr(fathom._fathom, node.name)
                for method in node.body:
                    self.compare(getattr(owner, method.name), method)
        for node in stubs.body:
            if isinstance(node, ast.FunctionDef):
                self.compare(getattr(fathom._fathom, node.name), node)

    def compare(self, function, stub):
        signature = function.__doc__.split("(", 1)[1]
        written = [argument.arg for argument in stub.args.args if argument.arg != "self"]
        there = [part.split(":")[0].strip() for part in split_arguments(signature)]
        self.assertEqual(there[len(there) - len(written):], written, stub.name)

    def test_the_package_is_fully_typed(self):
        self.mypy("mypy", "--strict", "-p", "fathom")


def split_arguments(signature):
    """Arguments before the closing bracket, at the outermost level."""
    parts, depth, start = [], 0, 0
    for at, letter in enumerate(signature):
        if depth == 0 and letter in ",)":
            parts.append(signature[start:at])
            start = at + 1
            if letter == ")":
                return parts
        depth += (letter in "([<") - (letter in ")]>" and signature[at - 1] != "-")
    return parts


class Docstrings(unittest.TestCase):
    def test_everything_public_has_one_that_names_all_arguments(self):
        for name in fathom.__all__:
            thing = getattr(fathom, name)
            if name == "__version__" or thing is fathom.Error:
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            if inspect.isfunction(thing) and name not in ("names", "scene"):
                for argument in inspect.signature(thing).parameters:
                    if argument not in ("seed", "progress"):
                        self.assertIn(argument, thing.__doc__, f"{name}: {argument}")


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "python3-matplotlib is not installed")
class Examples(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_each_draws_a_picture(self):
        import matplotlib.image
        program.run("campaign", ROOT / "scenes/campaigns/story.json", "-o", self.folder / "story")
        examples = sorted(EXAMPLES.glob("*.py"))
        self.assertEqual(len(examples), 5)
        for example in examples:
            with self.subTest(example=example.name):
                picture = self.folder / f"{example.stem}.png"
                words = [self.folder / "story"] if example.stem == "diagnosis" else []
                run(example, picture, *words, cwd=self.folder, env={**os.environ, "MPLBACKEND": "Agg"})
                pixels = matplotlib.image.imread(picture)
                self.assertGreater(pixels.shape[0] * pixels.shape[1], PICTURE_PIXELS)
                self.assertGreater(pixels[..., :3].std(), 0.02, "an empty picture")


@unittest.skipUnless(all(map(importlib.util.find_spec, ("pip", "setuptools", "wheel"))), "pip, setuptools or wheel is not installed")
class Wheel(unittest.TestCase):
    def test_it_holds_all_that_a_capture_needs(self):
        with tempfile.TemporaryDirectory() as folder:
            build = Path(fathom.__file__).parent.parent.parent
            run("-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", folder, ROOT / "python",
                env={**os.environ, "FATHOM_BUILD": str(build)})
            wheel, = Path(folder).glob("fathom-*.whl")
            run("-m", "zipfile", "-e", wheel, Path(folder) / "site")
            code = ("import fathom; assert fathom.__file__.startswith({0!r}), fathom.__file__; assert str(fathom.scene('paper_water')).startswith({0!r});"
                    "fathom.capture(fathom.scene('paper_water'), mode='geometric')").format(str(Path(folder) / "site"))
            run("-c", code, cwd=folder, env={"PYTHONPATH": str(Path(folder) / "site")})


if __name__ == "__main__":
    unittest.main()
