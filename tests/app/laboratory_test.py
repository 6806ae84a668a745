#!/usr/bin/env python3
"""usage: tests/app/laboratory_test.py FATHOM
docs/laboratory.md as a reader follows it: its commands run one after another in an empty folder, and print what the page quotes; the files
that it shows are those that they write."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "laboratory.md"


def main(program):
    text = PAGE.read_text()
    said = ""
    with tempfile.TemporaryDirectory() as folder:
        for kind, block in re.findall(r"^```(\w*)\n(.*?)^```$", text, re.M | re.S):
            if kind:
                continue
            block = re.sub(r"^fathom ", f"{program} ", block, flags=re.M)
            done = subprocess.run(["bash", "-euc", block], cwd=folder, capture_output=True, text=True)
            if done.returncode:
                return f"{block}{done.stdout}{done.stderr}"
            said += done.stdout
        for kind, file in ("json", "rig.json"), ("csv", "frames.csv"):
            shown = re.search(rf"^```{kind}\n(.*?)^```$", text, re.M | re.S)[1]
            if shown != Path(folder, "lab", file).read_text():
                return f"{PAGE.name} shows another {file} than check --example writes"
    quotes = re.findall(r"^> (.*)$", text, re.M)
    return "\n".join(f"not printed: {quote}" for quote in quotes or ["a quote on the page"] if quote not in said) or None


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve()))
