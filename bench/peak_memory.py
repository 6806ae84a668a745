#!/usr/bin/env python3
"""usage: bench/peak_memory.py RESULT.json COMMAND [ARGUMENT]...
Runs the command and writes its peak resident memory [MB] and times [s]."""
import json
import os
import sys
import time
from pathlib import Path


def measure(command):
    start = time.monotonic()
    silence = [(os.POSIX_SPAWN_OPEN, sys.stdout.fileno(), os.devnull, os.O_WRONLY, 0)]
    child = os.posix_spawnp(command[0], command, os.environ, file_actions=silence)
    _, status, usage = os.wait4(child, 0)
    if status:
        sys.exit(f"error: {' '.join(command)} failed")
    kibibyte_in_mb = 1024e-6
    return {"peak_mb": usage.ru_maxrss * kibibyte_in_mb, "wall_s": time.monotonic() - start,
            "cpu_s": usage.ru_utime + usage.ru_stime}


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    Path(sys.argv[1]).write_text(json.dumps(measure(sys.argv[2:]), indent=2) + "\n")
