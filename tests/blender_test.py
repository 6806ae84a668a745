#!/usr/bin/python3
"""usage: tests/blender_test.py FATHOM [VALIDATOR]
docs/blender.md as a reader follows it: its commands run one after another, and Blender finds in the exported scene what the
page promises. With a VALIDATOR, the folder where npm installed gltf-validator, it judges the exported files, too. By hand:
exit code 77 without Blender."""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
VALIDATE = """
const validator = require(process.argv[1] + "/node_modules/gltf-validator"), fs = require("fs");
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])))
  .then(report => console.log(JSON.stringify(report.issues)));
"""


def run(command, folder):
    done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


def check(program, folder):
    blocks = re.findall(r"^```\n(.*?)^```$", (ROOT / "docs/blender.md").read_text(), re.M | re.S)
    said = "".join(run(block.replace("build/release/app/fathom", program), folder) for block in blocks)
    things = dict(re.findall(r"^thing: (.+) ([A-Z]+) \[", said, re.M))
    assert things.get("infrared camera") == "CAMERA", things
    assert {name for name, kind in things.items() if kind == "MESH"} == {"desk", "cup 0 tumbler.glb", "cup 0 water"}, things
    assert "cup 0 tumbler.glb MESH [80, 80, 90] mm" in said, said
    assert (folder / "out/tumbler/view.html").is_file()


def judge(validator, file):
    report = json.loads(subprocess.run(["node", "-e", VALIDATE, str(validator), str(file)], check=True, capture_output=True, text=True).stdout)
    problems = [message for message in report["messages"] if message["severity"] < 2]
    assert report["numErrors"] == 0 and report["numWarnings"] == 0, problems
    print(f"{file.name}: no errors, no warnings")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    if not shutil.which("blender"):
        print("... skipped 'blender is not installed'")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "out").mkdir()
        (Path(name) / "scenes").symlink_to(ROOT / "scenes")
        fathom = str(Path(sys.argv[1]).resolve())
        check(fathom, Path(name))
        if len(sys.argv) == 3:
            run(f"{fathom} export {ROOT}/scenes/glass_water.json -o out/glass.glb", name)
            run(f"{fathom} export {ROOT}/scenes/paper_milk_tea.json -o out/milk_tea.glb", name)
            for file in sorted((Path(name) / "out").glob("*.glb")):
                judge(Path(sys.argv[2]).resolve(), file)
