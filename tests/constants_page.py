#!/usr/bin/env python3
"""usage: tests/constants_page.py
Whether docs/statistics.md lists the constants of diagnosis/statistics, each with the value that it has there."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ROOM = ROOT / "diagnosis" / "statistics"
# Sums of others, names and limits of types.
NO_CHOICES = {"kAny", "kPeakWidth2", "kProducts", "kThirds"}
MEMBERS = {"delta", "p_where", "p_excess"}


def written():
    """{(file's stem, name): value as written} of the code."""
    found = {}
    for file in sorted(ROOM.glob("*.h")) + sorted(ROOM.glob("*.cpp")):
        text = re.sub(r"//.*", "", file.read_text())
        for declaration in re.findall(r"(?:constexpr|const double|double) [^;(]*?\b(?:k[A-Z]|delta|p_)[^;]*;", text):
            for name, value in re.findall(r"\b(k[A-Z]\w*|delta|p_\w+)\s*(?:=\s*|(?=\{))([^,;]+(?:\{[^}]*\})?)", declaration):
                if name not in NO_CHOICES and (name[0] == "k" or name in MEMBERS):
                    found[file.stem, name] = value.strip()
    return found


def number(text):
    """Of "¼", "10000", "1e-6", "std::log(0.1)", "log 0.1"."""
    text = text.replace("¼", "0.25").replace("−", "-")
    return float(re.search(r"-?\d[\d.]*(?:e-?\d+)?", text).group())


def main():
    listed = {}
    for line in (ROOT / "docs" / "statistics.md").read_text().split("## Constants")[1].split("\n## ")[0].splitlines():
        cells = [cell.strip() for cell in line.strip("|").split(" | ")]
        names, values = re.findall(r"`(\w+)`", cells[0]), cells[1].split(" to ") if len(cells) == 4 else []
        for stem in re.findall(r"`(\w+)`", cells[2]) if len(cells) == 4 else []:
            for place, name in enumerate(names):
                listed[stem, name] = values[place if len(names) > 1 else 0]
    code = written()
    wrong = [f"{stem}: {name} is not on the page" for stem, name in code.keys() - listed.keys()]
    wrong += [f"{stem}: {name} is on the page, but not in the code" for stem, name in listed.keys() - code.keys()]
    wrong += [f"{stem}: {name} is {code[stem, name]}, on the page {value}" for (stem, name), value in listed.items()
              if (stem, name) in code and abs(number(value) - number(code[stem, name])) > 1e-12]
    if len(listed) > 60:
        wrong.append(f"{len(listed)} constants: a page holds 60")
    print("\n".join(sorted(wrong)) or f"{len(listed)} constants, all on the page")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
