"""glTF and GLB: meshes, buffers and nodes that contradict one another, or are far too many."""
import base64
import json
import struct

import extremes
import mutate_text


def box(size=0.06):
    """A closed box as (JSON, bytes of its buffer)."""
    corners = [(x, y, z) for x in (-size / 2, size / 2) for y in (0.0, size) for z in (-size / 2, size / 2)]
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
             (1, 5, 7), (1, 7, 3)]
    data = b"".join(struct.pack("<3f", *c) for c in corners) + b"".join(struct.pack("<3I", *f) for f in faces)
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
            "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1], "metallicFactor": 0,
                                                                 "roughnessFactor": 1},
                           "extensions": {"KHR_materials_ior": {"ior": 1.5},
                                          "KHR_materials_transmission": {"transmissionFactor": 0}}}],
            "accessors": [{"bufferView": 0, "byteOffset": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1],
                           "max": [1, 1, 1]},
                          {"bufferView": 1, "componentType": 5125, "count": 36, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 144}],
            "buffers": [{"uri": "box.bin", "byteLength": 240}]}, data


def mutate_gltf(rng, folder):
    """(JSON text, buffer)."""
    tree, data = box()
    if rng.random() < 0.3:
        tree["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 1  # a clear body
    what = rng.choice(["json", "json", "json", "nest", "nest text", "many", "places", "uri", "uri", "required", "accessor", "view",
                       "values", "values", "cycle", "matrix"])
    if what == "nest":
        depth = rng.choice([50, 101, 5000, 20_000])
        tree["nodes"] = [{"children": [i + 1]} for i in range(depth)] + [{"mesh": 0}]
    elif what == "nest text":
        depth = rng.choice([1000, 20_000, 100_000])
        text = json.dumps({**tree, "extras": "HERE"})
        return text.replace('"HERE"', rng.choice(["[" * depth + "]" * depth, '{"a":' * depth + "1" + "}" * depth])), data
    elif what == "many":
        count = rng.choice([1000, 50_000])
        key = rng.choice(["nodes", "meshes", "materials", "accessors", "bufferViews", "scenes"])
        tree[key] = tree[key] * count
    elif what == "places":
        count = rng.choice([2, 1000, 10_000, 100_000])
        tree["nodes"] = [{"mesh": 0} for _ in range(count)]
        tree["scenes"][0]["nodes"] = list(range(count))
    elif what == "uri":
        tree["buffers"][0]["uri"] = rng.choice(extremes.paths(folder) + ["box.bin?x", "./box.bin", "%62ox.bin", "data:,",
                                                                         "data:application/octet-stream;base64,####",
                                                "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
                                                                         "../in/box.bin", "data:" + "A" * 1_000_000])
        if rng.random() < 0.4:
            tree["buffers"][0]["byteLength"] = rng.choice([0, -1, 1, 241, 2**31, 2**32, 2**63, 8_000_000_000])
        if rng.random() < 0.2:
            tree["images"] = [{"uri": rng.choice(extremes.paths(folder))}]
    elif what == "required":
        tree["extensionsRequired"] = rng.choice([["KHR_draco_mesh_compression"], ["EXT_meshopt_compression"], ["x"] * 1000, [1],
                                                 "x", ["KHR_materials_ior"]])
    elif what == "accessor":
        accessor = rng.choice(tree["accessors"])
        accessor[rng.choice(["count", "byteOffset", "bufferView", "componentType", "type"])] = rng.choice(
            [-1, 0, 1, 7, 2**31 - 1, 2**31, 2**32, 2**62, 1e300, 5120, 5121, 5123, 5130, "VEC2", "MAT4", "SCALAR", None])
        if rng.random() < 0.2:
            accessor["sparse"] = {"count": rng.choice([1, 2**31]), "indices": {"bufferView": 1, "componentType": 5125},
                                  "values": {"bufferView": 0}}
    elif what == "view":
        rng.choice(tree["bufferViews"])[rng.choice(["byteOffset", "byteLength", "byteStride", "buffer"])] = rng.choice(
            [-1, 0, 1, 2, 3, 4, 13, 255, 256, 2**31, 2**32, 2**63, 1e300, -2**31])
    elif what == "values":
        raw = bytearray(data)
        for _ in range(rng.choice([1, 1, 5, 60])):
            at = 4 * rng.randrange(60)
            raw[at:at + 4] = struct.pack("<f", rng.choice([float("nan"), float("inf"), 3e38, -3e38, 1e22, 1e-38, 0.0,
                                                           1e5])) if at < 96 else struct.pack(
                "<I", rng.choice([0, 7, 8, 2**31, 2**32 - 1]))
        data = bytes(raw)
    elif what == "cycle":
        tree["nodes"] = rng.choice([[{"mesh": 0, "children": [0]}], [{"children": [1]}, {"children": [0], "mesh": 0}],
                                    [{"mesh": 0, "children": [1, 1]}, {"mesh": 0}]])
    elif what == "matrix":
        number = rng.choice([0, 1e22, 1e-22, -1, 1e300, 1e38])
        tree["nodes"][0] = {"mesh": 0, **rng.choice([{"matrix": [number] * 16},
                                                     {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, number, 0, 0, 1]},
                                                     {"scale": [number] * 3},
                                                     {"rotation": [number] * 4}, {"translation": [number] * 3},
                                                     {"matrix": [1] * 15}])}
    text = json.dumps(tree)
    if what == "json" or rng.random() < 0.1:
        text = mutate_text.mutate_json(rng, text, folder)
    if rng.random() < 0.1:
        data = data[:rng.randrange(len(data))]
    return text, data


def glb(rng, text, data):
    """Both in one file; its lengths may lie."""
    raw = text.encode("utf-8", "surrogatepass")
    raw += b" " * (-len(raw) % 4)
    lengths = [12 + 8 + len(raw) + 8 + len(data), len(raw), len(data)]
    version, kinds = 2, [b"JSON", b"BIN\0"]
    if rng.random() < 0.4:
        lengths[rng.randrange(3)] = rng.choice([0, 1, 3, 2**31 - 1, 2**31, 2**32 - 1, lengths[1] + 1, lengths[1] - 4])
    if rng.random() < 0.1:
        version, kinds = rng.choice([(1, kinds), (3, kinds), (2, [b"BIN\0", b"JSON"]), (2, [b"JSON", b"JSON"]),
                                     (2, [b"JSON", b"????"])])
    return (b"glTF" + struct.pack("<III", version, lengths[0], lengths[1]) + kinds[0] + raw + struct.pack("<I", lengths[2]) +
            kinds[1] + data)
