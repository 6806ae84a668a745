#!/usr/bin/env python3
"""usage: blind/answers.py keep PACK -o FILE.jsonl.gz
       blind/answers.py restore FILE.jsonl.gz -o PACK
Keeps what is scored of the answers to a pack of blind/worlds.py, a line for each measurement, in a file that is small
enough for the project, and restores them from it. So tables that took a day of diagnoses are made again in seconds, and a
pack that was stopped goes on elsewhere. PACK is its folder, such as out/blind/povray-19. Examples:
  blind/answers.py keep out/blind/povray-19 -o blind/answers/povray-19.jsonl.gz
  blind/answers.py restore blind/answers/povray-19.jsonl.gz -o out/blind/povray-19
  blind/worlds.py povray --program build/release/app/fathom --seed 19 --sets 200
The last one diagnoses what is missing, and scores."""
import argparse
import gzip
import json
import shutil
import sys
import zlib
from pathlib import Path

SCORED = ("verdict", "effects", "size_errors", "ambiguity_set")  # what worlds.Judged reads of a report
FILES = ("truth.json", "report.json", "failed.txt")


def kept_of(folder):
    """One answer, as {file name: content}."""
    kept = {name: (folder / name).read_text() for name in FILES if (folder / name).exists()}
    if "report.json" in kept:
        report = json.loads(kept["report.json"])
        kept["report.json"] = json.dumps({key: report[key] for key in SCORED if key in report}) + "\n"
    return kept


def keep(pack, file):
    if not (pack / "answers").is_dir():
        sys.exit(f"error: {pack}: has no folder answers")
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(file.name + ".part")
    folders = [folder for folder in sorted((pack / "answers").iterdir()) if folder.name.isdigit()]
    # No name and no time in the header: same answers, same bytes.
    with open(part, "wb") as raw, gzip.GzipFile(filename="", fileobj=raw, mode="wb", mtime=0) as packed:
        for folder in folders:
            packed.write((json.dumps({"set": folder.name, "files": kept_of(folder)}, separators=(",", ":")) + "\n").encode())
    part.rename(file)
    print(f"{len(folders)} answers, {file.stat().st_size / 1000:.0f} kB: {file}")


def checked(line):
    """A line's set and files. Those from elsewhere name no other place."""
    number, files = line["set"], line["files"]
    if not (isinstance(number, str) and number.isascii() and number.isdigit() and set(files) <= set(FILES)
            and all(isinstance(content, str) for content in files.values())):
        raise ValueError("is no answer")
    return number, files


def restore(file, pack):
    """Answers that are there are left alone."""
    count = 0
    with gzip.open(file, "rt", encoding="utf-8") as lines:
        for text in lines:
            number, files = checked(json.loads(text))
            folder, part = pack / "answers" / number, pack / "answers" / f"{number}.part"
            if not folder.exists():
                shutil.rmtree(part, ignore_errors=True)
                part.mkdir(parents=True)
                for name, content in files.items():
                    (part / name).write_text(content)
                part.rename(folder)
            count += 1
    print(f"{count} answers: {pack}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("keep", "restore"))
    parser.add_argument("input", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    options = parser.parse_args()
    try:
        (keep if options.what == "keep" else restore)(options.input, options.output)
    except (OSError, ValueError, KeyError, TypeError, EOFError, zlib.error) as problem:
        sys.exit(f"error: {options.input}: {problem}")


if __name__ == "__main__":
    main()
