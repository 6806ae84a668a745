"""Runs the program on something and says what it did wrong."""
import os
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import results

PAGE = os.sysconf("SC_PAGE_SIZE")
MOST_BYTES_ON_DISK = 2 << 30


@dataclass
class Limits:
    seconds: float = 20.0
    memory: int = 1 << 30


@dataclass
class Run:
    code: int = None     # exit code
    signal: int = None   # by which it ended
    stopped: str = ""    # why it was stopped from here
    seconds: float = 0.0
    peak: int = 0        # bytes resident
    out: bytes = b""
    err: bytes = b""


def start(arguments, cwd, env, out, err):
    """In a group of its own, so that its children end with it."""
    return subprocess.Popen(arguments, cwd=cwd, env=env, stdin=subprocess.DEVNULL, stdout=out, stderr=err, start_new_session=True)


def run(arguments, cwd, env, limits, shell=None, alive=None):
    """`shell`: redirections in the shell's words. `alive()`: whether a run that takes long is still at work."""
    result = Run()
    if shell:
        arguments = ["sh", "-c", 'exec "$@" ' + shell, "sh", *arguments]
    with open(cwd / ".stdout", "w+b") as out, open(cwd / ".stderr", "w+b") as err:
        begin = time.monotonic()
        process = start(arguments, cwd, env, out, err)
        pause, looked = 0.002, begin
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            time.sleep(pause)
            pause = min(0.02, pause * 1.3)
            now = time.monotonic()
            if not result.stopped:
                if resident(process.pid) > limits.memory:
                    result.stopped = "memory"
                elif hangs(process.pid, now - begin, limits.seconds):
                    result.stopped = "time"
                elif alive and now - looked > 4.0:
                    looked = now
                    result.stopped = "at work" if alive() else ""
                if result.stopped:
                    os.killpg(process.pid, signal.SIGKILL)
        process.returncode = 0  # it is waited for
        result.seconds = time.monotonic() - begin
        try:
            os.killpg(process.pid, signal.SIGKILL)  # a child that it left behind
        except ProcessLookupError:
            pass
        result.code = os.WEXITSTATUS(status) if os.WIFEXITED(status) else None
        result.signal = os.WTERMSIG(status) if os.WIFSIGNALED(status) else None
        result.peak = max(usage.ru_maxrss * 1024, limits.memory + 1 if result.stopped == "memory" else 0)
        for stream, name in ((out, "out"), (err, "err")):
            stream.seek(0)
            setattr(result, name, stream.read(10_000_000))
    for name in (".stdout", ".stderr"):
        (cwd / name).unlink()
    return result


def resident(pid):
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
    except (OSError, IndexError):
        return 0


def hangs(pid, seconds, most):
    """A run that works counts by its processor time: others may have the cores. One that waits for what never comes neither has
    any nor wants it."""
    cpu = cpu_s(pid)
    if cpu > most or seconds > 10 * most:
        return True
    return seconds > most and cpu < 0.03 * seconds and seconds - wanted_s(pid) > most


def wanted_s(session):
    """For how long its threads, and its children's, stood ready and were given no core."""
    nanoseconds = 0
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if os.getsid(int(process.name)) == session:
                nanoseconds += sum(int(task.read_text().split()[1]) for task in process.glob("task/*/schedstat"))
        except (OSError, IndexError):
            continue  # it has just ended
    return nanoseconds / 1e9


def cpu_s(pid):
    try:
        words = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(words[11]) + int(words[12]) + int(words[13]) + int(words[14])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError):
        return 0.0


def ending(result, limits):
    """What is wrong with how it ended."""
    if result.stopped == "at work":
        return []
    if result.stopped == "time":
        return [f"hangs: is not done in {result.seconds:.0f} s"]
    found = []
    if result.peak > limits.memory:
        found.append(f"takes {result.peak / 2**30:.2f} GB" + (" and more" if result.stopped == "memory" else ""))
    if result.signal is not None and not result.stopped:
        found.append(f"ends by {signal.Signals(result.signal).name}: {last_line(result.err)}")
    elif result.code not in (None, 0, 1, 2):
        found.append(f"exit code {result.code}: {last_line(result.err)}")
    return found


def last_line(text):
    lines = text.decode("utf-8", "replace").split("\n")
    return next((line[:300] for line in reversed(lines) if line.strip()), "")


def words(result):
    """What is wrong with what it said on stderr."""
    if result.code is None:
        return []
    lines = result.err.split(b"\n")
    if lines and lines[-1] == b"":
        lines.pop()
    elif lines:
        return [f"stderr does not end with a line: {last_line(result.err)}"]
    if result.code == 0:
        odd = [line for line in lines if not line.startswith((b"warning: ", b"note: "))]
        return [f"done, but says: {odd[0][:200]!r}"] if odd else []
    errors = [line for line in lines if not line.startswith((b"warning: ", b"note: "))]
    wanted = 1 if result.code == 1 else 2
    if len(errors) != wanted or not errors[0].startswith(b"error: ") or result.code == 1 and len(lines) != 1:
        return [f"exit {result.code} with {len(lines)} lines on stderr: {result.err[:300]!r}"]
    if any(c < 0x20 or c == 0x7F for c in errors[0]):
        return [f"a control character in the error: {errors[0][:200]!r}"]
    if len(errors[0]) > 20_000:
        return [f"an error of {len(errors[0])} characters"]
    return []


def said(result):
    """What is wrong with its results on stdout."""
    if result.code != 0:
        return []
    found = results.NO_NUMBER.search(result.out.decode("utf-8", "replace"))
    return [f"stdout holds {found[0]}"] if found else []


def snapshot(root, without=()):
    """Every path below `root` with what tells that it was changed."""
    found = {}
    for folder, names, files in os.walk(root):
        names[:] = [n for n in names if Path(folder, n) not in without]
        for name in names + files:
            path = Path(folder, name)
            state = path.lstat()
            found[path] = (state.st_mode, state.st_size if not path.is_dir() else 0, state.st_mtime_ns if not path.is_dir() else 0)
    return found


def strays(before, after, root):
    """What was written, changed or deleted where nothing may be."""
    return [f"outside of -o {'changed' if path in before and path in after else 'wrote' if path in after else 'deleted'} {path.relative_to(root)}"
            for path in sorted(set(before) | set(after)) if before.get(path) != after.get(path)]


MARKERS = {"capture": "run.json", "campaign": "frames.csv", "diagnose": "report.json", "evaluate": "rates.txt",
           "measure": "heights.csv", "detect": "detection.json"}


def leftovers(out, result, command):
    """Half files in the output, and a result that is called complete although it failed."""
    if result.stopped or result.signal is not None or not out.is_dir():
        return []
    found = [f"left {path.relative_to(out)}" for path in out.rglob("*") if results.is_leftover(path)]
    if result.code != 0 and command in MARKERS and (out / MARKERS[command]).exists():
        found.append(f"failed, but wrote {MARKERS[command]}")
    return found


def pwned(root, out, env):
    """Whether data ran as a command, now or when somebody draws the figures again."""
    found = [f"ran a command out of data: {path.relative_to(root)}" for path in root.rglob("*pwned*") if path.name == "pwned"]
    if found or not out.is_dir():
        return found
    for script in out.rglob("*.gp"):
        if b"touch pwned" in script.read_bytes():
            subprocess.run(["gnuplot", "-d", script.name], cwd=script.parent, env=env, stdin=subprocess.DEVNULL,
                           capture_output=True, timeout=20)
            found += [f"{script.name} runs a command out of data" for _ in root.rglob("pwned")]
    return found
