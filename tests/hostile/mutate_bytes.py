"""Mutants that know nothing of the format."""
import struct


def mutate_bytes(rng, data, other=b""):
    """Bits flipped, pieces cut, doubled, filled or taken from another file of the kind."""
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 1, 2, 4, 16])):
        if not data:
            break
        near_start = rng.random() < 0.5  # headers are small
        i = rng.randrange(min(len(data), 400) if near_start else len(data))
        n = min(len(data) - i, rng.choice([1, 2, 4, 8, 16, 64, 1000]))
        what = rng.choice(["flip", "flip", "byte", "word", "cut", "end", "double", "fill", "splice", "insert"])
        if what == "flip":
            data[i] ^= 1 << rng.randrange(8)
        elif what == "byte":
            data[i] = rng.choice([0, 1, 0x7F, 0x80, 0xFF, 0x0A, 0x20, 0x22, 0x2D, 0x39, rng.randrange(256)])
        elif what == "word":
            raw = struct.pack("<q", rng.choice([0, -1, 1, 2**31 - 1, -2**31, 2**32 - 1, 2**62, 0x7FC00000, 0x7F800000, 60_000,
                                                2**24]))
            data[i:i + 4] = raw[:len(data[i:i + 4])]
        elif what == "cut":
            del data[i:i + n]
        elif what == "end":
            del data[i:]
        elif what == "double":
            data[i:i] = data[i:i + n] * rng.choice([1, 2, 100])
        elif what == "fill":
            data[i:i + n] = bytes([rng.choice([0, 0xFF, 0x20])]) * n
        elif what == "splice" and other:
            data[i:] = other[rng.randrange(len(other)):]
        else:
            data[i:i] = rng.randbytes(n)
    return bytes(data)
