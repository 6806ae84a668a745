#!/usr/bin/env python3
"""usage: tests/hostile/kills.py FATHOM [--kills N] [--seed S] [--work NAME]

Kills FATHOM at random moments while it writes. After each kill what stands in the folder is whole, and is called complete only when it is: equal to
an uninterrupted run. A rerun then finishes, and its result equals that run's byte for byte, but for times. Half of the folders held an older
result before, which may be there whole or not at all."""
import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
import results  # noqa: E402
import works  # noqa: E402
from hostile import environment  # noqa: E402

SIGNALS = [signal.SIGKILL, signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT]


def uninterrupted(program, work, arguments, folder, env, out):
    """(files, seconds) of a run that nothing disturbs."""
    begin = time.monotonic()
    subprocess.run([program, *arguments, "-o", str(out)], cwd=folder, env=env, check=True, stdout=subprocess.DEVNULL)
    return works.files(out), time.monotonic() - begin


def killed(command, folder, env, after_s, how):
    """Whether the signal came before the end."""
    process = subprocess.Popen(command, cwd=folder, env=env, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        process.wait(after_s)
        return False
    except subprocess.TimeoutExpired:
        os.kill(process.pid, how)
    try:
        process.wait(20)
    except subprocess.TimeoutExpired:
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        raise RuntimeError(f"{how.name} does not end it within 20 s") from None
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)  # gnuplot, when its parent was killed
        except ProcessLookupError:
            pass
    return True


def after_kill(work, out, complete):
    """What is wrong in a folder in which a run was killed. `complete`: the results that it may hold whole."""
    if not out.is_dir():
        return []
    wrong = results.problems(out)
    if (out / work.marker).exists():
        off = [works.differences(out, wanted) for wanted in complete]
        if all(off):
            wrong.append(f"{work.marker} is there, but {'; '.join(min(off, key=len)[:3])}")
    return wrong


def try_once(program, work, rng, folder, env, references, out):
    """One kill, or several in a row, then a run to the end: what went wrong."""
    shutil.rmtree(out, ignore_errors=True)
    (files, seconds), (older_files, _), older_folder = references[work.name]
    complete = [files]
    if not work.resumes and rng.random() < 0.5:
        shutil.copytree(older_folder, out)
        complete.append(older_files)
    command = [program, *work.arguments, "-o", str(out)]
    wrong, kills = [], 0
    for _ in range(rng.choice([1, 1, 2, 3])):
        how = rng.choice(SIGNALS)
        if killed(command, folder, env, rng.uniform(0.0, 1.05 * seconds), how):
            kills += 1
            wrong += [f"after {how.name}: {what}" for what in after_kill(work, out, complete)]
    last = subprocess.run(command, cwd=folder, env=env, stdin=subprocess.DEVNULL, capture_output=True, timeout=600)
    if last.returncode != 0:
        wrong.append(f"the rerun fails: {last.stderr.decode('utf-8', 'replace')[:300]}")
    else:
        wrong += [f"after the rerun: {what}" for what in works.differences(out, files) + works.leftovers(out) +
                  results.problems(out)]
    return kills, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="FATHOM", type=lambda p: str(Path(p).resolve()))
    parser.add_argument("--kills", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", help="one of them: capture, campaign, diagnose, generate, evaluate, card")
    options = parser.parse_args()
    rng, kills, failed = random.Random(options.seed), dict.fromkeys(["capture", "campaign", "diagnose", "generate", "evaluate", "card"], 0), 0
    with tempfile.TemporaryDirectory(prefix="kills.") as scratch:
        folder = Path(scratch)
        env = environment(options.program, folder)
        all_works = [w for w in works.make_works(options.program, folder, env) if options.work in (None, w.name)]
        references = {}
        for work in all_works:
            older = folder / f"older_{work.name}"
            uninterrupted(options.program, work, work.arguments, folder, env,
                          folder / "warm")  # libraries are in memory from now on
            shutil.rmtree(folder / "warm")
            references[work.name] = (uninterrupted(options.program, work, work.arguments, folder, env,
                                                   folder / f"whole_{work.name}"),
                                     uninterrupted(options.program, work, work.other, folder, env, older), older)
        turn = 0
        while sum(kills.values()) < options.kills:
            work = all_works[turn % len(all_works)]
            turn += 1
            came, wrong = try_once(options.program, work, rng, folder, env, references, folder / "out")
            kills[work.name] += came
            if wrong:
                failed += 1
                kept = Path(__file__).resolve().parents[2] / "out" / "kills" / f"{options.seed}-{turn}-{work.name}"
                shutil.rmtree(kept, ignore_errors=True)
                if (folder / "out").is_dir():
                    shutil.copytree(folder / "out", kept)
                print(f"FAILED: {work.name}, turn {turn}: {'; '.join(wrong)[:800]}\n  kept in {kept}", flush=True)
            if turn % 20 == 0:
                print(f"{sum(kills.values())} kills, {failed} failed", flush=True)
    print(f"{sum(kills.values())} kills ({', '.join(f'{name} {count}' for name, count in kills.items() if count)}), wrong or half results: {failed}")
    return 1 if failed or turn == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
