"""Mutants of JSON and CSV that know what these are made of. All take the text and an rng and return text or bytes."""
import json

import extremes


class Object(list):
    """Pairs of key and value: keys may come twice."""


class Raw(str):
    """Stands in the file as it is: numbers, and what is no JSON."""


def parse(text):
    return json.loads(text, object_pairs_hook=Object, parse_int=Raw, parse_float=Raw, parse_constant=Raw)


def write(value):
    if isinstance(value, Raw):
        return str(value)
    if isinstance(value, Object):
        return "{" + ", ".join(f"{key if isinstance(key, Raw) else json.dumps(key)}: {write(item)}" for key, item in value) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(write, value)) + "]"
    return json.dumps(value)


def places(value, found):
    """Every (container, index) of a tree."""
    if isinstance(value, list):
        for i, item in enumerate(value):
            found.append((value, i))
            places(item[1] if isinstance(value, Object) else item, found)
    return found


def get(place):
    container, i = place
    return container[i][1] if isinstance(container, Object) else container[i]


def put(place, value):
    container, i = place
    container[i] = (container[i][0], value) if isinstance(container, Object) else value


def other_type(rng):
    return rng.choice([None, True, False, Raw("1"), Raw("-1.5"), "", "text", [], Object(), [[]], [Raw("1"), Raw("2"), Raw("3")],
                       Object([("a", Raw("1"))]),
                       [None], ["x"], Raw(rng.choice(extremes.NO_NUMBERS))])


def nested(rng, value):
    depth = rng.choice([10, 100, 1000, 20_000, 200_000])
    opening, closing = rng.choice([("[", "]"), ('{"a":', "}"), ('{"children":[', "]}")])
    return Raw(opening * depth + write(value) + closing * depth)


def extreme(rng, value, folder):
    """Another value of the same type."""
    if isinstance(value, Raw):
        return Raw(extremes.number(rng, value)) if rng.random() < 0.9 else Raw(rng.choice(extremes.NO_NUMBERS))
    if isinstance(value, bool) or value is None:
        return rng.choice([True, False, None])
    if isinstance(value, str):
        return rng.choice(extremes.paths(folder)) if rng.random() < 0.35 else extremes.word(rng)
    if isinstance(value, Object):
        return Object(rng.sample(value, len(value) // 2))
    return [extreme(rng, item, folder) for item in value]


def change(rng, tree, folder):
    found = places(tree, [])
    if not found:
        return
    place = rng.choice(found)
    container, i = place
    what = rng.choices(["extreme", "delete", "double", "retype", "rename", "length", "nest", "swap", "copy"],
                       [40, 8, 6, 10, 6, 8, 3, 4, 6])[0]
    if what == "extreme":
        put(place, extreme(rng, get(place), folder))
    elif what == "delete":
        del container[i]
    elif what == "double":
        container.insert(i, container[i])
        if rng.random() < 0.5:
            put((container, i), extreme(rng, get((container, i)), folder))
    elif what == "retype":
        put(place, other_type(rng))
    elif what == "rename" and isinstance(container, Object):
        key = extremes.word(rng) if rng.random() < 0.5 else rng.choice(["", container[i][0].upper(), container[i][0] + " ",
                                                                        "x" + container[i][0]])
        container[i] = (key, container[i][1])
    elif what == "length":
        lists = [get(p) for p in found if isinstance(get(p), list)] or [tree]
        items = rng.choice(lists)
        if isinstance(items, list) and items:
            count = rng.choice([0, 1, 2, len(items) + 1, 2 * len(items), 100, 3000])
            again = [(f"{k}_{n}", v) if isinstance(items, Object) else v
                     for n, (k, v) in enumerate((e if isinstance(items, Object) else (None, e))
                                                for e in items * (count // len(items) + 1))]
            items[:] = again[:count]
    elif what == "nest":
        put(place, nested(rng, get(place)))
    else:
        other = rng.choice(found)
        value, theirs = get(place), get(other)
        if what == "swap" and not contains(value, theirs) and not contains(theirs, value):
            put(other, value)
        if not contains(theirs, container):
            put(place, theirs)


def contains(value, part):
    """Whether a tree would hold itself."""
    return value is part or isinstance(value, list) and any(contains(v[1] if isinstance(value, Object) else v, part) for v in value)


def mutate_json(rng, text, folder):
    tree = parse(text)
    for _ in range(1 if rng.random() < 0.6 else rng.randint(2, 4)):
        change(rng, tree, folder)
        tree = parse(json_again) if (json_again := as_json(tree)) else tree  # shared parts become copies
    result = write(tree)
    if rng.random() < 0.04:
        result = rng.choice([result + result, "\ufeff" + result, result + ",", "[" + result, result.replace(":", ",", 1), "// x\n" +
                             result,
                             result[:-1], " " * 1_000_000 + result, result + "\x00", result.replace('"', "'"), "null", "[]", "{}",
                             "1"])
    return result


def as_json(tree):
    """The tree's text where it is still JSON and small; else None."""
    text = write(tree)
    try:
        parse(text)
    except (ValueError, RecursionError):
        return None
    return text


def mutate_csv(rng, text, folder):
    rows = [line.split(",") for line in text.splitlines()]
    for _ in range(1 if rng.random() < 0.6 else rng.randint(2, 5)):
        r, c = rng.randrange(len(rows)), rng.randrange(max(1, len(rows[0])))
        row = rows[r]
        c = min(c, len(row) - 1)
        what = rng.choices(["cell", "column", "drop column", "double column", "swap columns", "drop row", "double row", "cut row",
                            "many", "quote", "head"],
                           [40, 6, 5, 5, 5, 6, 6, 4, 2, 4, 5])[0]
        if what == "cell":
            row[c] = cell(rng, row[c], folder)
        elif what == "column":
            for other in rows[1:]:
                if c < len(other):
                    other[c] = cell(rng, other[c], folder) if rng.random() < 0.5 else row[c]
        elif what == "drop column":
            for other in rows:
                del other[c:c + 1]
        elif what == "double column":
            for other in rows:
                other[c:c] = other[c:c + 1]
        elif what == "swap columns":
            d = rng.randrange(len(row))
            for other in rows[rng.randrange(2):]:
                if max(c, d) < len(other):
                    other[c], other[d] = other[d], other[c]
        elif what == "drop row":
            del rows[r]
        elif what == "double row":
            rows[r:r] = [list(row)] * rng.choice([1, 1, 2, 500])
        elif what == "cut row":
            del row[c:]
        elif what == "many":
            count = rng.choice([100, 5000, 50_000])
            rows = [other + [f"c{i}" if j == 0 else "0" for i in range(count)] for j, other in enumerate(rows)]
        elif what == "quote":
            row[c] = rng.choice(['"', '""', '"a', 'a"b', '"a,b"', '"a\nb"', "'"])
        else:
            rows[0][min(c, len(rows[0]) - 1)] = extremes.word(rng)
        if not rows or not rows[0]:
            return rng.choice(["", "\n", "frame\n"])
        rows = [row or [""] for row in rows]
    separator, end = rng.choice([(",", "\n")] * 8 + [(";", "\n"), ("\t", "\r\n"), (",", "\r"), (",", "\n\n")])
    return end.join(separator.join(row) for row in rows) + ("" if rng.random() < 0.1 else end)


def cell(rng, was, folder):
    roll = rng.random()
    if roll < 0.6:
        return extremes.number(rng, was or "1")
    if roll < 0.7:
        return rng.choice(extremes.NO_NUMBERS)
    return rng.choice(extremes.paths(folder)) if roll < 0.8 else extremes.word(rng)
