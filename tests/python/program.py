"""The program beside the module: what it writes and prints, read without the module."""
import json
import os
import subprocess

import numpy as np

PROGRAM = os.environ["FATHOM_PROGRAM"]


def run(*words):
    """What the program prints; an error of it fails the test."""
    return subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, text=True).stdout


def run_json(*words):
    return json.loads(run(*words, "--json"))


def error_of(*words):
    """The line after "error: " of a command that fails with exit code 1."""
    result = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert result.returncode == 1, result
    return result.stderr.removeprefix("error: ").strip()


def pcd(path):
    """x, y, z and intensity of an organised binary PCD: h x w x 4."""
    content = path.read_bytes()
    end = content.index(b"DATA binary\n") + len(b"DATA binary\n")
    header = dict(line.split(" ", 1) for line in content[:end].decode().splitlines() if not line.startswith("#"))
    assert header["FIELDS"] == "x y z intensity", header
    return np.frombuffer(content[end:], np.float32).reshape(int(header["HEIGHT"]), int(header["WIDTH"]), 4)
