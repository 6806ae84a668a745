"""`pip install ./python`: builds the module by CMake, in build/release, and packs it with the libraries of scenes/.
With FATHOM_BUILD=FOLDER it takes the module from that build and builds nothing."""
import os
import re
import shutil
import subprocess
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent
SCRATCH = ROOT / "build/python_package"


class BuildByCMake(build_ext):
    def run(self):
        build = os.environ.get("FATHOM_BUILD")
        if not build:
            subprocess.run([ROOT / "scripts/build", "release", "--target", "_fathom"], check=True)
        name = "_fathom" + sysconfig.get_config_var("EXT_SUFFIX")
        module = Path(build or ROOT / "build/release") / "python/fathom" / name
        if not module.is_file():
            raise SystemExit(f"error: {module}: was not built; the build is for the Python of FATHOM_PYTHON_EXECUTABLE")
        package = Path(self.build_lib) / "fathom"
        package.mkdir(parents=True, exist_ok=True)
        shutil.copy(module, package)
        shutil.copytree(ROOT / "scenes", package / "scenes", dirs_exist_ok=True)


SCRATCH.mkdir(parents=True, exist_ok=True)
setup(version=re.search(r"project\(Fathom VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
      packages=["fathom"], package_data={"fathom": ["py.typed", "*.pyi"]}, ext_modules=[Extension("fathom._fathom", [])],
      cmdclass={"build_ext": BuildByCMake},
      options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}})
