#!/usr/bin/env python3
"""usage: tests/skipped.py REPORT.xml
How many tests were skipped, and why each, of ctest's --output-junit. What nobody sees nobody misses."""
import re
import sys
import xml.etree.ElementTree as xml


def reason(test):
    """GoogleTest's line after "file:line: Skipped" or Python's after "skipped", else what ctest says."""
    if test.get("status") == "disabled":
        return "takes minutes, and runs only by hand (--gtest_also_run_disabled_tests)"
    output = test.findtext("system-out") or ""
    said = (re.search(r"^\S*:\d+: Skipped\n(.*)$", output, re.MULTILINE)
            or re.search(r"\.\.\. skipped ['\"](.*)['\"]$", output, re.MULTILINE))
    if said and said[1].strip():
        return said[1].strip()
    mark = test.find("skipped")
    return (mark.get("message") if mark is not None else None) or "does not say why"


def summary(report):
    """Lines for a person, of the report's text."""
    tests = list(xml.fromstring(report).iter("testcase"))
    skipped = [test for test in tests if test.find("skipped") is not None or test.get("status") in ("notrun", "disabled")]
    return [f"{len(skipped)} of {len(tests)} tests were skipped" + (":" if skipped else "")] + [
        f"  {test.get('name')}: {reason(test)}" for test in skipped]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8", errors="replace") as file:
        print("\n".join(summary(file.read())))
