#!/usr/bin/env python3
"""usage: tests/hostile/hostile.py FATHOM [--mutants N] [--seed S] [--kind KIND] [--number N] [--tell] [--keep DIR]

Gives FATHOM mutants of small valid files of every kind that it reads, and judges each run: it ends by itself, within 20 s and 1 GB, with exit
code 0, 1 or 2; a failure is one line `error: ...`, leaves nothing half-written and nothing outside of -o; results are whole and finite; no data
runs as a command. Mutant N of a seed is always the same. Failures are kept in DIR (out/hostile), each with the command that repeats it."""
import argparse
import os
import shutil
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path

sys.dont_write_bytecode = True
import judge  # noqa: E402
import kinds  # noqa: E402
import results  # noqa: E402
from seeds import Seeds  # noqa: E402


def environment(program, folder):
    """Without the user's settings; with the driver that was built beside the program, for recordings."""
    for name in ("home", "tmp"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    libraries = Path(program).resolve().parent.parent / "lib" / "fathom"
    keep = {name: value for name, value in os.environ.items() if name.endswith("SAN_OPTIONS")}
    return {**keep, "PATH": os.environ["PATH"], "HOME": str(folder / "home"), "TMPDIR": str(folder / "tmp"), "LC_ALL": "C.UTF-8",
            "LD_LIBRARY_PATH": str(libraries)}


def try_one(program, seed, number, seeds, root, limits):
    """Makes the mutant below `root` and runs it: (kind, arguments, run, what is wrong)."""
    shutil.rmtree(root, ignore_errors=True)
    here, out, cwd = root / "in", root / "out", root / "in"
    here.mkdir(parents=True)
    env = environment(program, root)
    kind, arguments, shell, env["LC_ALL"] = kinds.make(seed, number, seeds, here)
    if arguments[0] == "view":  # its output is a file
        out.mkdir()
    full = [program, *arguments, "-o", str(out / "page.html" if arguments[0] == "view" else out), "--quiet", "--threads", "1"]
    before = judge.snapshot(root, {out})
    alive = (lambda: any((out / "clouds").glob("*.pcd"))) if arguments[0] == "campaign" else None
    run = judge.run(full, cwd, env, limits, shell, alive)
    wrong = judge.ending(run, limits)
    if not shell:
        wrong += judge.words(run) + judge.said(run)
    wrong += judge.strays(before, judge.snapshot(root, {out}), root) + judge.pwned(root, out, env)
    if not shell and not kind.startswith("resumed"):  # what cannot be said stands in the folder all the same
        wrong += judge.leftovers(out, run, arguments[0])
    if run.code == 0 and out.is_dir():
        wrong += results.problems(out)
    return kind, [*full[1:], *([shell] if shell else []), *(["LC_ALL=C"] if env["LC_ALL"] == "C" else [])], run, wrong


class Report:
    """What was found, printed as it comes."""

    def __init__(self, options):
        self.options, self.lock, self.begin = options, threading.Lock(), time.monotonic()
        self.done, self.codes, self.kinds, self.failed, self.slowest, self.largest = 0, Counter(), Counter(), Counter(), 0.0, 0

    def add(self, number, kind, arguments, run, wrong, root):
        with self.lock:
            if self.options.tell:
                print(f"{number} {kind}: {run.stopped or run.code} {run.seconds:.2f} s {run.peak >> 20} MB {judge.last_line(run.err)}", flush=True)
            self.done += 1
            self.codes["signal" if run.code is None else run.code] += 1
            self.kinds[kind.split(",")[0]] += 1
            self.slowest, self.largest = max(self.slowest, run.seconds), max(self.largest, run.peak)
            if wrong:
                self.failed[kind.split(",")[0]] += 1
                kept = self.options.keep / f"{self.options.seed}-{number}-{kind.split(',')[0]}"
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(root, kept, symlinks=True, ignore=lambda folder,
                                names: [n for n in names if is_pipe(Path(folder, n))])
                lines = [f"FAILED: mutant {number} ({kind}): {'; '.join(wrong)[:600]}", f"  fathom {' '.join(arguments)}",
                         f"  kept in {kept}; again: tests/hostile/hostile.py {self.options.program} --seed {self.options.seed} --number {number}"]
                (kept / "why.txt").write_text("\n".join(lines) + "\n")
                print("\n".join(lines), flush=True)
            if self.done % 100 == 0 and not self.options.quiet:
                print(f"{self.done} mutants, {sum(self.failed.values())} failed, {self.done / (time.monotonic() - self.begin):.1f} per second", flush=True)

    def summary(self):
        codes = ", ".join(f"{count} × {code}" for code, count in sorted(self.codes.items(), key=str))
        of_kinds = ", ".join(f"{kind} {count}" for kind, count in sorted(self.kinds.items()))
        return (f"{self.done} mutants of seed {self.options.seed} in {time.monotonic() - self.begin:.0f} s ({of_kinds}); exit codes {codes}; at most {self.slowest:.1f} s and "
                f"{self.largest / 2**20:.0f} MB; failed: {sum(self.failed.values())}" + "".join(f", {kind} {count}" for kind,
                                                                                                count in self.failed.items()))


def is_pipe(path):
    return not path.is_symlink() and not path.is_file() and not path.is_dir()


def numbers(options):
    """Those of the mutants wanted."""
    if options.number is not None:
        return iter([options.number])
    wanted = (n for n in range(10**9) if not options.kind or kinds.kind_of(options.seed, n).__name__ == options.kind)
    return (n for n, _ in zip(wanted, range(options.mutants)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="FATHOM", type=lambda p: str(Path(p).resolve()))
    parser.add_argument("--mutants", type=int, default=500)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--kind", choices=kinds.NAMES)
    parser.add_argument("--number", type=int, help="this mutant only; what it was stays in --keep")
    parser.add_argument("--keep", type=Path, default=Path(__file__).resolve().parents[2] / "out" / "hostile")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--memory-mb", type=int, default=1024)
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--tell", action="store_true", help="a line for each run: how it ended and what it said")
    options = parser.parse_args()
    limits, report = judge.Limits(options.seconds, options.memory_mb << 20), Report(options)
    with tempfile.TemporaryDirectory(prefix="hostile.") as scratch:
        scratch = Path(scratch)
        seeds = Seeds(options.program, scratch / "seeds", environment(options.program, scratch))
        wanted, lock = numbers(options), threading.Lock()

        def work(root):
            while True:
                with lock:
                    number = next(wanted, None)
                if number is None:
                    return
                try:
                    kind, arguments, run, wrong = try_one(options.program, options.seed, number, seeds, root, limits)
                except Exception as problem:  # of ours: no mutant may end the others
                    kind, arguments, run, wrong = kinds.kind_of(options.seed,
                                                                number).__name__, [], judge.Run(), [f"the test itself: {problem!r}"]
                if options.number is not None:
                    print(f"fathom {' '.join(arguments)}\nexit {run.code} signal {run.signal} {run.stopped} {run.seconds:.2f} s {run.peak / 2**20:.0f} MB\n{run.err.decode('utf-8', 'replace')[:2000]}")
                    shutil.copytree(root, options.keep / f"{options.seed}-{number}-{kind.split(',')[0]}", symlinks=True,
                                    dirs_exist_ok=True, ignore=lambda folder, names: [n for n in names if is_pipe(Path(folder, n))])
                report.add(number, kind, arguments, run, wrong, root)
        workers = [threading.Thread(target=work, args=(scratch / f"worker{i}",)) for i in range(options.jobs)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
    print(report.summary())
    return 1 if report.failed or report.done == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
