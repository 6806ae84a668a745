"""What every result must be, whatever the input was: whole, readable, finite."""
import hashlib
import json
import math
import re
import struct
import zlib
from itertools import accumulate

import mutate_image

SOURCES = {"scene", "spec", "clutter", "config", "model", "earlier",
           "model_effects"}  # of run.json and the like: the user's own text
# As programs print them; those of the mutants have capitals, and may come back as names.
NO_NUMBER = re.compile(r"(?<![\w.'\"-])[-+]?(nan|inf|infinity)(?![\w.'\"-])")
MOST_PIXEL_BYTES = 2_000_000  # beyond these the values of an image are not looked at, which takes long here


def is_leftover(path):
    """What a killed write leaves: .NAME.PID.fathom.part.EXT."""
    return re.fullmatch(r"\..*\.\d+(\.fathom)?\.part(\.[^.]*)?", path.name) is not None


def problems(folder):
    """A line for each file that is not whole, holds NaN or infinity, or runs what it was given."""
    found = []
    for path in sorted(p for p in folder.rglob("*") if p.is_file() and not p.is_symlink()):
        if is_leftover(path) or "scene_files" in path.parts:  # copies of what the scene names
            continue
        try:
            check = CHECKS.get(path.suffix)
            wrong = check(path.read_bytes()) if check else None
            if path.name == "manifest.jsonl":
                wrong = check_manifest(path)
        except (ValueError, IndexError, KeyError, struct.error, zlib.error, RecursionError) as problem:
            wrong = f"is not whole: {type(problem).__name__}: {str(problem)[:100]}"
        if wrong:
            found.append(f"{path.relative_to(folder)} {wrong}")
    return found


def refuse_constant(name):
    raise ValueError(f"holds {name}")


def nulls(value, where):
    """Paths of null; nlohmann writes NaN so."""
    if value is None:
        yield where
    elif isinstance(value, dict):
        for key, item in value.items():
            if key not in SOURCES:
                yield from nulls(item, f"{where}/{key}")
    elif isinstance(value, list):
        for item in value:
            yield from nulls(item, where)


# Documented as null: what was not seen.
MAY_BE_NULL = re.compile(r"/(plane|why|center_camera_m|radius_mm|radius_sigma_mm|lean_deg|score|rms_mm|surface_mm|sigma_mm|sd_mm|bottom_mm|fill_mm|fill_sigma_mm|p_liquid|"
                         r"desk|config|miss|kind|fill_found_mm|icp_iterations|held_out|after_rms_mm|covers|liquid|apparent_height_mm)$")


def check_json(data):
    value = json.loads(data, parse_constant=refuse_constant)
    if any(isinstance(n, float) and not math.isfinite(n) for n in numbers(value)):
        return "holds a number beyond double"
    bad = [where for where in nulls(value, "") if not MAY_BE_NULL.search(where)]
    return f"holds null at {bad[0]}" if bad else None


def numbers(value):
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in SOURCES:
                yield from numbers(item)
    elif isinstance(value, list):
        for item in value:
            yield from numbers(item)
    else:
        yield value


def check_text(data):
    if data and not data.endswith(b"\n"):
        return "does not end with a line"
    found = NO_NUMBER.search(data.decode("utf-8", "replace"))
    return f"holds {found[0]}" if found else None


def check_csv(data):
    if not data.endswith(b"\n"):
        return "is not whole"
    for line in data.decode("utf-8", "replace").splitlines():
        for cell in line.split(","):
            if re.fullmatch(r"\s*[-+]?(nan|inf|infinity)\s*", cell):
                return f"holds {cell}"
    return None


def check_pcd(data):
    head = data[:4000].split(b"DATA binary\n")[0].decode()
    fields = {line.split()[0]: line.split()[1:] for line in head.splitlines() if line and not line.startswith("#")}
    size = sum(int(s) * int(c) for s, c in zip(fields["SIZE"], fields["COUNT"]))
    body = data[data.index(b"DATA binary\n") + 12:]
    if len(body) != size * int(fields["POINTS"][0]) or int(fields["WIDTH"][0]) * int(fields["HEIGHT"][0]) != int(fields["POINTS"][0]):
        return "is not whole"
    if len(body) <= MOST_PIXEL_BYTES and any(math.isinf(v) for (v,) in struct.iter_unpack("<f", body)):
        return "holds infinity"
    return None


def check_exr(data):
    if struct.unpack_from("<I", data)[0] != mutate_image.MAGIC_EXR:
        return "is no EXR"
    _, attributes, chunks = mutate_image.parse_exr(data)
    values = {name: value for name, _, value in attributes}
    x0, y0, x1, y1 = struct.unpack("<4i", values["dataWindow"])
    channels = values["channels"].count(struct.pack("<iBxxxii", 2, 0, 1, 1))
    lines = 16 if values["compression"][0] == 3 else 1
    if sum(len(packed) for _, packed in chunks) == 0 or len(chunks) != (y1 - y0 + lines) // lines:
        return "is not whole"
    if (x1 - x0 + 1) * (y1 - y0 + 1) * channels * 4 > MOST_PIXEL_BYTES:
        return None
    for y, packed in chunks:
        size = (x1 - x0 + 1) * channels * 4 * min(lines, y1 - y + 1)
        if not all(map(math.isfinite, struct.unpack(f"<{size // 4}f", unpacked(packed, size)))):
            return "holds NaN or infinity"
    return None


def unpacked(packed, size):
    if len(packed) == size:
        return packed
    raw = bytes(accumulate(zlib.decompress(packed), lambda a, b: (a + b - 128) & 0xFF))
    half = (len(raw) + 1) // 2
    result = bytearray(len(raw))
    result[0::2], result[1::2] = raw[:half], raw[half:]
    return bytes(result)


def check_manifest(path):
    """What it notes must stand there as noted; a last line that a kill cut short does not count."""
    for line in path.read_bytes().split(b"\n")[1:-1]:
        note = json.loads(line)
        file = path.parent / note["file"]
        if not file.is_file() or hashlib.sha256(file.read_bytes()).hexdigest() != note["sha256"]:
            return f"notes {note['file']}, which is not as it says"
    return None


def check_png(data):
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        return "is no PNG"
    at, kind = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if struct.unpack_from(">I", data, at + 8 + size)[0] != zlib.crc32(data[at + 4:at + 8 + size]):
            return "has a damaged chunk"
        at += 12 + size
    return None if kind == b"IEND" else "is not whole"


def check_markup(data):
    text = data.decode("utf-8", "replace").rstrip()
    if not text.endswith(("</html>", "</svg>")):
        return "is not whole"
    return "runs a script that it was given" if "<script>document.title='pwned'" in text or "<img src=x onerror=pwned>" in text else None


CHECKS = {".json": check_json, ".txt": check_text, ".csv": check_csv, ".pcd": check_pcd, ".exr": check_exr, ".png": check_png,
          ".html": check_markup, ".svg": check_markup}
