#!/usr/bin/env python3
"""usage: tests/links.py
Whether what README.md and docs/*.md point to is there: files and headings of links, and files of this project in commands."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
NAMED = re.compile(r"(?<![\w/.])(?:scripts|bench|blind|tests|scenes|examples|cmake)/[\w./-]*\w")


def anchors(page):
    """Headings as GitHub makes anchors of them."""
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in re.findall(r"^#+ (.*)$", page.read_text(), re.M)}


def broken(page):
    text = page.read_text()
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if re.match(r"\w+:", link):
            continue
        if not target.exists():
            yield f"{link}: no such file"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target):
            yield f"{link}: no such heading"
    code = "\n".join(re.findall(r"```.*?```|`[^`\n]+`", text, re.S))
    for named in sorted(set(NAMED.findall(code))):
        if "NAME" not in named and not (ROOT / named).exists():
            yield f"{named}: no such file"


def main():
    problems = [f"{page.relative_to(ROOT)}: {problem}" for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
                for problem in broken(page)]
    print("\n".join(problems) or "every link leads somewhere")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
