#!/usr/bin/env python3
"""usage: tests/layers.py [ROOT]
Checks that who includes whom is as the two tables of docs/architecture.md say. One line per breach on stderr, exit 1 if any."""
import re
import sys
from fnmatch import fnmatch
from pathlib import Path

EVERYTHING = "everything"
LIBRARY_HEADERS = {
    "Embree": r"embree\d/",
    "PCL": r"pcl/",
    "nanoflann": r"nanoflann\.hpp",
    "liblzf": r"liblzf/",
    "tinygltf": r"tiny_gltf\.h",
    "Boost.Geometry": r"boost/geometry",
    "Boost.Math": r"boost/math",
    "OpenEXR": r"((OpenEXR|Imath)/)?(Imf|Imath)\w*\.h",
    "libpng": r"(libpng\d*/)?png\.h",
    "zlib": r"zlib\.h",
    "OpenSSL": r"openssl/",
    "CLI11": r"CLI/",
    "Fontconfig": r"fontconfig/",
    "OpenCV": r"opencv\d?/",
    "pybind11": r"pybind11/",
    "OpenNI2": r"(Oni\w+|OpenNI|PS1080)\.h|Driver/",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
NAMESPACE = re.compile(r"namespace ([\w:]+) \{")
TYPE = re.compile(r"(?:struct|class|enum class|union) (\w+)[^;()]*\{")
# What prints: libraries never do, and the program only where control characters are taken out of what files hold.
PRINTS = re.compile(r"\b(fmt::print|f?printf|f?puts|putchar|say)\s*\(|\bstd::(cout|cerr|clog)\b")
SILENT = ["core/*", "theory/*", "sim/*", "detector/*", "diagnosis/*", "report/*", "view/*", "trials/*", "datasets/*", "campaign/*", "paper/*", "app/*", "python/*"]
PRINTERS = ["app/main.cpp", "app/print.cpp", "core/progress.cpp", "core/standard_streams.*"]
DOCUMENT = Path(__file__).parent.parent / "docs" / "architecture.md"


def document_table(text, first_header):
    """{each name in the first column: the list in the last column} of the table that starts with `first_header`."""
    body = re.search(rf"^\| {first_header} \|.*\n\|[-|]+\n((?:\|.*\n)+)", text, re.MULTILINE)
    rows = [line.strip("|").split("|") for line in body[1].splitlines()] if body else []
    return {name.rstrip("/"): last_column(row[-1].strip()) for row in rows for name in re.findall(r"[^`, ]+", row[0])}


def last_column(cell):
    return cell if cell == EVERYTHING else re.findall(r"[^`, –]+", cell)


# Folder: folders that it may include besides itself; library: where its headers may be included.
LAYERS, BORDERS = (document_table(DOCUMENT.read_text(), first_header) for first_header in ("folder", "library"))


def layer_of(path):
    return max((layer for layer in LAYERS if path.startswith(layer + "/")), key=len, default=None)


def matches_any(name, patterns):
    return any(fnmatch(name, pattern) for pattern in patterns)


def include_breaches(root, path, included):
    source = layer_of(path)
    if source == "examples":  # as in a consumer's program
        included = included.removeprefix("fathom/")
    target = layer_of(included)
    may_include = LAYERS[source]
    if target and not (root / included).exists():
        yield f"{included} does not exist"
    elif target and target != source and may_include != EVERYTHING and not matches_any(target, may_include):
        yield f"{source}/ may not include {included}, only: {', '.join(may_include) or 'nothing'}"
    elif not target and (root / path).parent.joinpath(included).exists():
        yield f'"{included}" must be written as a path from the root'
    for library, places in BORDERS.items():
        if re.match(LIBRARY_HEADERS[library], included) and not matches_any(path, places):
            yield f"{included} of {library} may be included only in {', '.join(places)}"


def file_breaches(root, path):
    lines = (root / path).read_text().splitlines()
    if path.endswith(".h") and "#pragma once" not in lines:
        yield f"{path}: lacks #pragma once"
    if not layer_of(path):
        yield f"{path}: its folder is not in the table"
        return
    is_silent = matches_any(path, SILENT) and not matches_any(path, PRINTERS)
    for number, line in enumerate(lines, 1):
        if is_silent and PRINTS.search(line.split("//")[0]):
            yield f"{path}:{number}: prints; only {', '.join(PRINTERS)} may, see app/print.h"
        if include := INCLUDE.match(line):
            yield from (f"{path}:{number}: {breach}" for breach in include_breaches(root, path, include[1]))


def types_of(text):
    """(namespace, name) of each type that a header defines, those inside of others apart."""
    namespace = ""
    for line in text.splitlines():
        if opened := NAMESPACE.match(line):
            namespace = opened[1]
        elif defined := TYPE.match(line):
            yield namespace, defined[1]


def type_breaches(root, headers):
    """Two types of one name are one to the linker: where both are in a program, one's functions serve the other."""
    places = {}
    for path in headers:
        for namespace, name in types_of((root / path).read_text()):
            first = places.setdefault((namespace, name), path)
            if first != path:
                yield f"{path}: {namespace}::{name} is defined in {first} as well"


def breaches(root):
    tops = sorted(folder for folder in root.iterdir() if folder.is_dir() and folder.name not in (".git", "build", "out"))
    files = [file.relative_to(root).as_posix()
             for top in tops for file in sorted(top.rglob("*")) if file.suffix in (".h", ".cpp")]
    for path in files:
        yield from file_breaches(root, path)
    for library in BORDERS.keys() ^ LIBRARY_HEADERS.keys():
        yield f"{library}: stands either in {DOCUMENT.name} or in LIBRARY_HEADERS, not in both"
    yield from type_breaches(root, [path for path in files if path.endswith(".h")])


if __name__ == "__main__":
    found = list(breaches(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent.parent))
    print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
    sys.exit(1 if found else 0)
