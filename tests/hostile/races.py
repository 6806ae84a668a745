#!/usr/bin/env python3
"""usage: tests/hostile/races.py FATHOM [--races N] [--seed S] [--work NAME]

Starts FATHOM twice, or four times, in one folder, with the same or other settings. What then stands in the folder is the whole result of one run; each
run that comes while another writes, or that another has the folder of, ends with exit code 1 and one line that says so."""
import argparse
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
import works  # noqa: E402
from hostile import environment  # noqa: E402
from kills import uninterrupted  # noqa: E402


def race(program, work, rng, folder, env, references, out):
    """What went wrong."""
    shutil.rmtree(out, ignore_errors=True)
    settings = [rng.choice(["arguments", "arguments", "other"]) for _ in range(rng.choice([2, 2, 4]))]
    shortest = min(references[work.name][s][1] for s in settings)
    stagger = rng.choice([0.0, 0.0, rng.uniform(0.0, 0.2 * shortest)])
    runs = []
    for name in settings:
        runs.append(subprocess.Popen([program, *getattr(work, name), "-o", str(out)], cwd=folder, env=env, stdin=subprocess.DEVNULL,
                                     stdout=subprocess.PIPE, stderr=subprocess.PIPE))
        time.sleep(stagger)
    said = [(run.communicate(timeout=600)[1].decode("utf-8", "replace"), run.returncode) for run in runs]
    # More than one is done where one began after another's end; of another setting that one is then refused, or takes the folder over.
    wrong, owners = [], [i for i, (_, code) in enumerate(said) if code == 0]
    if not owners:
        wrong.append(f"none of {len(runs)} runs is done")
    for err, code in said:
        if code != 0 and (code != 1 or err.count("\n") != 1 or not any(words in err for words in ("is being written", "is of another run"))):
            wrong.append(f"exit code {code} with {err[:200]!r}")
    if owners:
        wanted = [references[work.name][settings[i]][0] for i in owners]
        off = [works.differences(out, files) for files in wanted]
        if all(off):
            wrong.append(f"the result is of no single run: {'; '.join(min(off, key=len)[:3])}")
        wrong += works.leftovers(out)
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="FATHOM", type=lambda p: str(Path(p).resolve()))
    parser.add_argument("--races", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", help="one of them: capture, campaign, diagnose, generate, evaluate, card")
    options = parser.parse_args()
    rng, failed = random.Random(options.seed), 0
    with tempfile.TemporaryDirectory(prefix="races.") as scratch:
        folder = Path(scratch)
        env = environment(options.program, folder)
        all_works = [w for w in works.make_works(options.program, folder, env) if options.work in (None, w.name)]
        references = {work.name: {name: uninterrupted(options.program, work, getattr(work, name), folder, env,
                                                      folder / f"{name}_{work.name}") for name in ("arguments", "other")}
                      for work in all_works}
        for i in range(options.races):
            work = all_works[i % len(all_works)]
            wrong = race(options.program, work, rng, folder, env, references, folder / "out")
            if wrong:
                failed += 1
                print(f"FAILED: race {i}, {work.name}: {'; '.join(wrong)[:600]}", flush=True)
            if i % 20 == 19:
                print(f"{i + 1} races, {failed} failed", flush=True)
    print(f"{options.races} races, without an owner or with a result that is of no single run: {failed}")
    return 1 if failed or options.races < 1 else 0


if __name__ == "__main__":
    sys.exit(main())
