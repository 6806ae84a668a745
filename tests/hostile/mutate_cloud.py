"""PCD and PLY as structures: header and body of a mutant agree, or do not, on purpose."""
import struct

import extremes

FLOATS = [0.0, -0.0, 1.0, -1.0, 1e30, -1e30, 3.4e38, 1e-30, float("nan"), float("inf"), float("-inf"), 1e6, 650.0]
TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}


def damaged_points(rng, points):
    """Some coordinates become what no sensor measures. A point is a tuple of floats."""
    points = [list(p) for p in points]
    what = rng.choice(["few", "all", "column", "same", "line", "far", "grid", "none", "few points"])
    for i, point in enumerate(points):
        if what == "few" and rng.random() < 0.1 or what == "all":
            point[rng.randrange(len(point))] = rng.choice(FLOATS)
    if what == "column":
        column, value = rng.randrange(3), rng.choice(FLOATS)
        points = [p[:column] + [value] + p[column + 1:] for p in points]
    elif what == "same":
        points = [points[0]] * len(points)
    elif what == "line":
        points = [[i * 1e-3, 0.0, 1.0] + p[3:] for i, p in enumerate(points)]
    elif what == "far":
        scale = rng.choice([1e-6, 1e-3, 1e3, 1e6, 1e15, 1e30, -1.0])
        points = [[min(max(c * scale, -3e38), 3e38) for c in p] for p in points]
    elif what == "grid":
        points = [[round(c, 1) for c in p] for p in points]
    elif what == "none":
        points = []
    elif what == "few points":
        points = points[:rng.choice([1, 2, 3, 4, 10])]
    return points


def lzf(data):
    """What LZF makes of data that do not compress: literals only."""
    return b"".join(bytes([len(data[i:i + 32]) - 1]) + data[i:i + 32] for i in range(0, len(data), 32))


def clip(value):
    return value if value != value or abs(value) == float("inf") else min(max(value, -3.4e38), 3.4e38)


def write_pcd(points, width, height, kind, header=None, body=None):
    """`header` replaces lines by their first word."""
    fields = len(points[0]) if points else 4
    lines = {"VERSION": "0.7", "FIELDS": " ".join(["x", "y", "z", "intensity"][:fields]), "SIZE": " ".join(["4"] * fields),
             "TYPE": " ".join(["F"] * fields),
             "COUNT": " ".join(["1"] * fields), "WIDTH": width, "HEIGHT": height, "VIEWPOINT": "0 0 0 1 0 0 0",
             "POINTS": width * height, "DATA": kind}
    lines.update(header or {})
    text = "".join(f"{word} {value}\n" for word, value in lines.items() if value is not None).encode("utf-8", "replace")
    if body is None:
        if kind == "ascii":
            body = "".join(" ".join(f"{c:g}" for c in p) + "\n" for p in points).encode()
        elif kind == "binary":
            body = b"".join(struct.pack(f"<{len(p)}f", *map(clip, p)) for p in points)
        else:
            plain = b"".join(struct.pack(f"<{len(points)}f", *(clip(p[i]) for p in points)) for i in range(fields))
            body = struct.pack("<II", len(lzf(plain)), len(plain)) + lzf(plain)
    return text + body


def mutate_pcd(rng, points, width, height):
    kind = rng.choice(["ascii", "binary", "binary", "binary_compressed", "binary_compressed"])
    big = rng.choice([0, 1, -1, 2**16, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**40, 2**63, 10**9, 50_000, 10_000_000])
    header, body = {}, None
    for _ in range(rng.choice([1, 1, 2])):
        what = rng.choice(["points", "size", "size", "consistent", "fields", "field", "count", "type", "permute", "drop", "double",
                           "word", "compressed", "cut"])
        if what == "points":
            points = damaged_points(rng, points)
            if rng.random() < 0.7:
                width, height = len(points), 1
        elif what == "size":
            header[rng.choice(["WIDTH", "HEIGHT", "POINTS"])] = big
        elif what == "consistent":
            header.update(rng.choice([{"WIDTH": big, "HEIGHT": 1, "POINTS": big}, {"WIDTH": 1, "HEIGHT": big, "POINTS": big},
                                      {"WIDTH": 65536, "HEIGHT": 65536, "POINTS": 2**32}, {"WIDTH": 2**31, "HEIGHT": 2,
                                                                                           "POINTS": 2**32}]))
        elif what == "fields":
            header["FIELDS"] = rng.choice(["x y z", "x y", "y x z intensity", "x x x x", "x y z rgb", "x y z intensity normal_x",
                                           "", "a b c d", "x y z _",
                                           "x y z " + "i" * 10_000, " ".join(f"f{i}" for i in range(2000))])
        elif what == "field":
            header["SIZE"] = rng.choice(["4 4 4 0", "8 8 8 8", "1 1 1 1", "2 2 2 2", "4 4 4", "4 4 4 -4", "3 3 3 3", f"4 4 4 {big}",
                                         "16 16 16 16", "x y z i"])
        elif what == "count":
            header["COUNT"] = rng.choice(["1 1 1 0", "1 1 1 2", "1 1 1 -1", f"1 1 1 {big}", "0 0 0 0", "2 1 1 1", "1 1 1 1000000",
                                          "1 1 1"])
        elif what == "type":
            header["TYPE"] = rng.choice(["F F F I", "U U U U", "I I I I", "F F F X", "F F F", "D D D D", "F F F FF"])
        elif what == "permute":
            header["FIELDS"] = " ".join(rng.sample(["x", "y", "z", "intensity"], 4))
        elif what == "drop":
            header[rng.choice(["VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS",
                               "DATA"])] = None
        elif what == "double":
            header[rng.choice(["WIDTH ", "POINTS ", "DATA ", "FIELDS "])] = rng.choice(["1", "binary", "x y z", str(big)])
        elif what == "word":
            header[rng.choice(["VERSION", "VIEWPOINT", "DATA",
                               "WIDTH"])] = extremes.word(rng).replace("\n", " ") if rng.random() < 0.5 else extremes.number(rng)
        elif what == "compressed":
            kind = "binary_compressed"
            packed = rng.choice([b"", b"\x00", bytes([0xFF, 0xFF, 0xFF]) * 50, bytes([0xE0, 0xFF, 0x00]) * 100, rng.randbytes(300)])
            body = struct.pack("<II", rng.choice([len(packed), 0, 2**32 - 1, 2**31]),
                               rng.choice([0, 16, 2**31, 2**32 - 1, 4_000_000_000]) % 2**32) + packed
            if rng.random() < 0.6:
                width = rng.choice([1000, 10**8, 2**31 - 1])
                height = 1
        else:
            data = write_pcd(points, width, height, kind, header, body)
            return data[:rng.randrange(len(data))]
    return write_pcd(points, width, height, kind, header, body)


def mutate_ply(rng, points):
    kind = rng.choice(["ascii", "binary_little_endian", "binary_little_endian", "binary_big_endian"])
    properties = [("float", "x"), ("float", "y"), ("float", "z")]
    colours = [("uchar", name) for name in ("red", "green", "blue")]
    properties += rng.choice([[], colours, colours, colours + [("uchar", "alpha")], [("float", "intensity")],
                              [("float", "nx"), ("float", "ny"), ("float", "nz")],
                              [(rng.choice(list(TYPES)), "intensity")]])
    comments, extra, body, count = [], [], None, None
    for _ in range(rng.choice([1, 1, 2, 3])):
        what = rng.choices(["points", "permute", "list", "type", "name", "double", "drop", "count", "element", "faces", "comment",
                            "format", "cut", "many"],
                           [6, 9, 9, 4, 2, 2, 2, 3, 2, 2, 2, 1, 1, 2])[0]
        if what == "points":
            points = damaged_points(rng, points)
        elif what == "permute" and rng.random() < 0.3:
            rng.shuffle(properties)
        elif what == "permute":
            rest = properties[3:]
            rng.shuffle(rest)
            properties = rest + properties[:3] if rng.random() < 0.3 else properties[:3] + rest
        elif what == "list":
            properties.insert(rng.randrange(len(properties) + 1), (f"list {rng.choice(list(TYPES))} {rng.choice(list(TYPES))}",
                                                                   rng.choice(["vertex_indices", "x", "l", "red"])))
        elif what == "type":
            i = rng.randrange(len(properties))
            properties[i] = (rng.choice(list(TYPES) + ["float32", "uint8", "int64", "nothing", ""]), properties[i][1])
        elif what == "name":
            i = rng.randrange(len(properties))
            properties[i] = (properties[i][0], rng.choice(["x", "rgb", "rgba", "red", "green", "blue", "intensity", "normal_x", "",
                                                           "a" * 1000, "é", "vertex_indices"]))
        elif what == "double":
            properties.insert(rng.randrange(len(properties)), rng.choice(properties))
        elif what == "drop" and len(properties) > 1:
            del properties[rng.randrange(len(properties))]
        elif what == "count":
            count = rng.choice([0, -1, 1, 2**31 - 1, 2**31, 2**32, 2**63, 10**9, len(points) + 1, len(points) - 1, "x", "", "1e3"])
        elif what == "element":
            extra.append(rng.choice(["element vertex 3\nproperty float x\n", "element nothing 5\n",
                                     "element face 2000000000\nproperty list uchar int vertex_indices\n",
                                     "element camera 1\nproperty float view_px\nproperty int viewportx\n",
                                     "element range_grid 9\nproperty list uchar int vertex_indices\n",
                                     "element x -5\nproperty double y\n", "obj_info num_cols 100000\nobj_info num_rows 100000\n"]))
        elif what == "faces":
            extra.append("element face 1\nproperty list uchar int vertex_indices\n")
        elif what == "comment":
            comments.append(rng.choice(["comment " + extremes.word(rng).replace("\n", " "), "obj_info num_cols 5",
                                        "obj_info num_rows -1", "comment" + "x" * 100_000]))
        elif what == "format":
            comments.append(rng.choice(["format ascii 1.0", "format binary_little_endian 2.0", "end_header", "ply",
                                        "property float w"]))
        elif what == "many":
            properties += [("float", f"p{i}") for i in range(rng.choice([100, 5000]))]
        else:
            body = b""
    points = points[:300 if len(properties) < 50 else 5]
    head = "".join(["ply\n", f"format {kind} 1.0\n", *(c + "\n" for c in comments),
                    f"element vertex {len(points) if count is None else count}\n",
                    *(f"property {t} {n}\n" for t, n in properties), *extra, "end_header\n"]).encode("utf-8", "replace")
    if body is None:
        body = b"".join(ply_point(rng, point, properties, kind) for point in points)
    data = head + body
    return data[:rng.randrange(len(head) // 2, len(data) + 1)] if rng.random() < 0.15 else data


def ply_point(rng, point, properties, kind):
    """A vertex as the properties have it; lists hold three numbers."""
    words, raw, order = [], bytearray(), ">" if kind == "binary_big_endian" else "<"

    def add(type_name, value):
        code = TYPES.get(type_name, "f")
        value = clip(value) if code in "fd" else int(value) & 0x7F if value == value and abs(value) < 1e9 else 0
        words.append(f"{value:g}")
        raw.extend(struct.pack(order + code, value))
    for type_name, name in properties:
        value = point["xyz".index(name)] if name in ("x", "y", "z") else 100.0
        if type_name.startswith("list"):
            _, count_type, item_type = type_name.split()
            add(count_type, 3)
            for i in range(3):
                add(item_type, i)
        else:
            add(type_name, value)
    return (" ".join(words) + "\n").encode() if kind == "ascii" else bytes(raw)
