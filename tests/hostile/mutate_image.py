"""EXR and PNG, taken apart and put together again with something wrong."""
import struct
import zlib

MAGIC_EXR = 20000630


def parse_exr(data):
    """(version, attributes as [(name, type, value)], chunks as [(y, packed)]) of a one-part scanline file."""
    version, at, attributes = struct.unpack_from("<I", data, 4)[0], 8, []
    while data[at]:
        name, at = cstring(data, at)
        kind, at = cstring(data, at)
        size = struct.unpack_from("<I", data, at)[0]
        attributes.append((name, kind, data[at + 4:at + 4 + size]))
        at += 4 + size
    at += 1
    window = struct.unpack("<4i", dict((n, v) for n, _, v in attributes)["dataWindow"])
    lines = {0: 1, 1: 1, 2: 1, 3: 16}[dict((n, v) for n, _, v in attributes)["compression"][0]]
    rows = window[3] - window[1] + 1
    at += 8 * ((rows + lines - 1) // lines)
    chunks = []
    while at < len(data):
        y, size = struct.unpack_from("<ii", data, at)
        chunks.append((y, data[at + 8:at + 8 + size]))
        at += 8 + size
    return version, attributes, chunks


def cstring(data, at):
    end = data.index(0, at)
    return data[at:end].decode("latin-1"), end + 1


def write_exr(version, attributes, chunks, table=None):
    head = struct.pack("<II", MAGIC_EXR, version)
    for name, kind, value in attributes:
        head += name.encode("latin-1") + b"\0" + kind.encode("latin-1") + b"\0" + struct.pack("<I", len(value)) + value
    head += b"\0"
    table = len(chunks) if table is None else table
    offsets, body, at = [], b"", len(head) + 8 * table
    for y, packed in chunks:
        offsets.append(at + len(body))
        body += struct.pack("<ii", y, len(packed)) + packed
    offsets = (offsets + [at] * table)[:table]
    return head + struct.pack(f"<{table}Q", *offsets) + body


def unpacked(packed, size):
    """Pixel bytes of a ZIP chunk; one that would not shrink stands as it is."""
    if len(packed) == size:
        return packed
    raw = bytearray(zlib.decompress(packed))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 0xFF
    half = (len(raw) + 1) // 2
    result = bytearray(len(raw))
    result[0::2], result[1::2] = raw[:half], raw[half:]
    return bytes(result)


def packed(raw):
    order = bytearray(raw[0::2] + raw[1::2])
    for i in range(len(order) - 1, 0, -1):
        order[i] = (order[i] - order[i - 1] + 128) & 0xFF
    return zlib.compress(bytes(order))


def channel_list(names, kind=2, sampling=(1, 1)):
    return b"".join(n.encode() + b"\0" + struct.pack("<iBxxxii", kind, 0, *sampling) for n in names) + b"\0"


def mutate_exr(rng, data):
    version, attributes, chunks = parse_exr(data)
    table = None

    def put(name, value, kind=None):
        attributes[:] = [(n, kind or k, value) if n == name else (n, k, v) for n, k, v in attributes]
    for _ in range(rng.choice([1, 1, 2])):
        what = rng.choice(["window", "window", "channels", "channels", "flags", "compression", "order", "values", "values", "table",
                           "chunk", "attribute", "drop", "type", "cut", "bomb"])
        if what == "window":
            x0, y0, x1, y1 = rng.choice([(0, 0, 59_999, 59_999), (0, 0, 2**31 - 2, 0), (0, 0, 0, 2**31 - 2),
                                         (-2**31, 0, 2**31 - 1, 0), (5, 5, 4, 4), (0, 0, -1, -1), (10, 10, 0, 0),
                                         (-2**31, -2**31, -2**31 + 31, -2**31 + 23), (2**31 - 32, 0, 2**31 - 1, 23),
                                         (0, 0, 8191, 8191), (0, 0, 30, 22), (0, 0, 32, 24), (0, 0, 100_000, 23),
                                         (100, 100, 131, 123)])
            put("dataWindow", struct.pack("<4i", x0, y0, x1, y1))
            if rng.random() < 0.7:
                put("displayWindow", struct.pack("<4i", x0, y0, x1, y1))
            if rng.random() < 0.3:
                table = min((y1 - y0) // 16 + 1, 10_000) if y1 > y0 else 1
        elif what == "channels":
            count = rng.choice([0, 2, 100, 2000, 20_000])
            names = rng.choice([["Z"], ["Y"], ["Y", "Y"], ["y"], ["Y", "Z"], [f"c{i:05}" for i in range(count)],
                                ["Y"] + [f"c{i:05}" for i in range(count)], ["Y" * 200], ["é"], [" "]])
            put("channels", channel_list(names, rng.choice([2, 2, 2, 1, 0, 3, -1, 99]),
                                         rng.choice([(1, 1), (1, 1), (1, 1), (2, 2), (0, 0), (-1, -1), (2**31 - 1, 1)])))
        elif what == "flags":
            version = rng.choice([2 | 0x200, 2 | 0x400, 2 | 0x800, 2 | 0x1000, 2 | 0x1800, 1, 3, 255, 0, 2 | 0x2000, 0xFFFFFFFF])
            if rng.random() < 0.5:
                attributes.append(("tiles", "tiledesc", struct.pack("<IIB", *rng.choice([(64, 64, 0), (1, 1, 0), (2**31, 2**31, 0),
                                                                                         (0, 0, 0), (60_000, 60_000, 1),
                                                                                         (16, 16, 2)]))))
        elif what == "compression":
            put("compression", bytes([rng.randrange(12)]))
        elif what == "order":
            put("lineOrder", bytes([rng.randrange(4)]))
        elif what == "values":
            chunks = [(y, damaged_values(rng, p)) for y, p in chunks]
        elif what == "table":
            table = rng.choice([0, 1, len(chunks) + 1, 1000])
        elif what == "chunk":
            i = rng.randrange(len(chunks))
            y, p = chunks[i]
            chunks[i] = rng.choice([(rng.choice([-1, 2**31 - 1, -2**31, y + 1]), p), (y, p[:len(p) // 2]), (y, b""),
                                    (y, rng.randbytes(50)), (y, p + b"\0" * 1000)])
        elif what == "attribute":
            name, kind, value = rng.choice([("x", "string", b"y" * 1_000_000),
                                            ("preview", "preview", struct.pack("<II", 60_000, 60_000)),
                                            ("x" * 300, "int", b"\0\0\0\0"), ("x", "y" * 300, b""),
                                            ("x", "stringvector", struct.pack("<I", 2**31)), ("type", "string", b"deepscanline"),
                                            ("chunkCount", "int", struct.pack("<i", rng.choice([-1, 2**31 - 1]))),
                                            ("multiView", "stringvector", struct.pack("<I", 3) + b"abc"),
                                            ("dataWindow", "box2i", b"\0" * 16)])
            attributes.insert(rng.randrange(len(attributes)), (name, kind, value))
        elif what == "drop":
            del attributes[rng.randrange(len(attributes))]
        elif what == "type":
            i = rng.randrange(len(attributes))
            attributes[i] = (attributes[i][0], rng.choice(["int", "string", "box2i", "float", ""]),
                             attributes[i][2][:rng.randrange(len(attributes[i][2]) + 1)])
        elif what == "bomb":
            chunks = [(y, zlib.compress(b"\0" * 20_000_000)) for y, _ in chunks[:1]]
        else:
            whole = write_exr(version, attributes, chunks, table)
            return whole[:rng.randrange(len(whole))]
    return write_exr(version, attributes, chunks, table)


def damaged_values(rng, chunk):
    try:
        raw = bytearray(unpacked(chunk, -1))
    except zlib.error:
        return chunk
    for _ in range(rng.choice([1, 20, len(raw) // 4])):
        at = 4 * rng.randrange(max(1, len(raw) // 4))
        raw[at:at + 4] = struct.pack("<f", rng.choice([float("nan"), float("inf"), -float("inf"), -1.0, 1e30, 3e38, 1e-30, 1e6, 0.0,
                                                       63.0]))
    return packed(bytes(raw))


def write_png(width, height, bits, colour, interlace, raw, chunks=(), sizes=None):
    def chunk(kind, value, crc=None):
        return struct.pack(">I", len(value)) + kind + value + struct.pack(">I", zlib.crc32(kind + value) if crc is None else crc)
    head = struct.pack(">IIBBBBB", width % 2**32, height % 2**32, bits, colour, 0, 0, interlace)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + b"".join(chunk(*c) for c in chunks) + chunk(b"IDAT", raw if isinstance(raw, bytes) else zlib.compress(bytes(raw))) + chunk(b"IEND", b"")


def grey_png(width, height, bits=8):
    """Dots on black."""
    row = bytes(255 if i % 7 == 3 else 0 for i in range(width * bits // 8))
    return write_png(width, height, bits, 0, 0, zlib.compress((b"\0" + row) * height))


def mutate_png(rng, width, height):
    bits, colour, interlace, chunks = rng.choice([8, 8, 8, 16]), 0, 0, []
    rows, kind = height, rng.choice(["size", "size", "size", "bits", "colour", "interlace", "chunk", "chunk", "filter", "data",
                                     "short", "bomb", "good"])
    claim = (width, height)
    if kind == "size":
        claim = rng.choice([(2**31 - 1, 1), (1, 2**31 - 1), (60_000, 60_000), (1_000_000, 1_000_000), (0, 0), (0, 5),
                            (2**32 - 1, 2**32 - 1), (2**31, 2**31), (1, 1), (width + 1, height), (width, height + 1),
                            (65_535, 65_535), (1_000_000, 1), (1, 1_000_000), (1, 100_000_000), (20_000, 20_000)])
    elif kind == "bits":
        bits = rng.choice([0, 1, 2, 4, 3, 32, 64, 255])
    elif kind == "colour":
        colour = rng.choice([1, 2, 3, 4, 5, 6, 7, 255])
    elif kind == "interlace":
        interlace = rng.choice([1, 2, 255])
    elif kind == "chunk":
        big = zlib.compress(b"a" * 50_000_000)
        chunks.append(rng.choice([(b"iCCP", b"x\0\0" + big), (b"zTXt", b"x\0\0" + big), (b"iTXt", b"x\0\1\0\0\0" + big),
                                  (b"tEXt", b"x\0" + b"y" * 1_000_000), (b"PLTE", b"\0" * 768), (b"tRNS", b"\0" * 2),
                                  (b"gAMA", struct.pack(">I", 0)), (b"ABCD", b"x"), (b"sBIT", b"\xff"), (b"IHDR", b"\0" * 13),
                                  (b"IEND", b""), (b"IDAT", b""), (b"tIME", b"x"), (b"gAMA", b"1234", 0)]))
    raw = b"".join(bytes([rng.randrange(256) if kind == "filter" else 0]) + bytes(255 if i % 7 == 3 else 0
                                                                                  for i in range(width * max(1, bits // 8)))
                   for _ in range(rows))
    body = zlib.compress(raw)
    if kind == "data":
        body = rng.choice([b"", body[:len(body) // 2], rng.randbytes(100), body + b"x" * 1000, zlib.compress(b"\xff" * len(raw)),
                           zlib.compress(b"\0" * len(raw))])
    elif kind == "short":
        body = zlib.compress(raw[:rng.randrange(len(raw))])
    elif kind == "bomb":
        body = zlib.compress(b"\0" * 100_000_000)
    data = write_png(*claim, bits, colour, interlace, body, chunks)
    return data[:rng.randrange(8, len(data))] if rng.random() < 0.1 else data
