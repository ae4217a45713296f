# SPDX-License-Identifier: GPL-3.0-or-later
"""check_outfit.py SOURCE SAME WORN: what of a GLB goes through, by a reader of its own (numpy alone).

SAME is SOURCE read and written once more, compared vertex by vertex at equal places; WORN has another shape on the
vertices of SAME, so all but positions and normals must be equal. Prints one row; exit 1 where something is lost.
"""
import json
import struct
import sys

import numpy as np

TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Glb:
    def __init__(self, path):
        data = open(path, "rb").read()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json, self.binary = json.loads(data[20:20 + length]), data[28 + length:]

    def elements(self, view, offset, count, kind, width):
        v = self.json["bufferViews"][view]
        item = np.dtype(TYPES[kind]).itemsize * width
        step, begin = v.get("byteStride", item), v.get("byteOffset", 0) + offset
        rows = [np.frombuffer(self.binary, TYPES[kind], width, begin + i * step) for i in range(count)]
        return np.array(rows).reshape(count, width)

    def read(self, number):
        a = self.json["accessors"][number]
        kind, width, count = a["componentType"], WIDTHS[a["type"]], a["count"]
        values = np.zeros((count, width), TYPES[kind])
        if "bufferView" in a:
            values = self.elements(a["bufferView"], a.get("byteOffset", 0), count, kind, width).copy()
        if "sparse" in a:
            s = a["sparse"]
            at = self.elements(s["indices"]["bufferView"], s["indices"].get("byteOffset", 0), s["count"],
                               s["indices"]["componentType"], 1)[:, 0]
            values[at] = self.elements(s["values"]["bufferView"], s["values"].get("byteOffset", 0), s["count"], kind, width)
        if a.get("normalized"):
            values = np.maximum(values / np.iinfo(TYPES[kind]).max, -1)
        return values.astype(float) if kind == 5126 or a.get("normalized") else values.astype(np.int64)

    def tables(self):
        """By node name and material: places, and for each vertex its UV sets, weights by joint, moves by key."""
        found = {}
        for node in self.json["nodes"]:
            if "mesh" not in node:
                continue
            mesh = self.json["meshes"][node["mesh"]]
            keys = mesh.get("extras", {}).get("targetNames", [])
            shown = node.get("weights", mesh.get("weights", []))
            joints = self.json["skins"][node["skin"]]["joints"] if "skin" in node else []
            for p in mesh["primitives"]:
                material = self.json["materials"][p["material"]]["name"] if "material" in p else ""
                attributes = p["attributes"]
                places = self.read(attributes["POSITION"]).astype(float)
                rows = {}
                for name in ("TEXCOORD_0", "TEXCOORD_1"):
                    if name in attributes:
                        rows[name] = self.read(attributes[name])
                if "JOINTS_0" in attributes:
                    at, share = self.read(attributes["JOINTS_0"]), self.read(attributes["WEIGHTS_0"])
                    weights = np.zeros((len(places), len(joints)))
                    for k in range(4):
                        np.add.at(weights, (np.arange(len(places)), at[:, k]), share[:, k])
                    rows["weights"] = weights
                for k, target in enumerate(p.get("targets", [])):
                    moves = self.read(target["POSITION"])
                    rows["key " + keys[k]] = moves
                    places += (shown[k] if k < len(shown) else 0) * moves
                found.setdefault((node.get("name"), material), []).append((places, rows))
        return found


def main():
    source, same, worn = (Glb(path) for path in sys.argv[1:4])
    of_source, of_same, of_worn = source.tables(), same.tables(), worn.tables()
    lost = [f"part {name}" for name in of_source if name not in of_same]
    worst = {"place": 0.0, "uv": 0.0, "weights": 0.0, "keys": 0.0}
    for name, parts in of_source.items():
        for (places, rows), (found, has) in zip(parts, of_same.get(name, [])):
            lost += [f"{row} of {name}" for row in rows if row not in has]
            for v, place in enumerate(places):
                near = np.linalg.norm(found - place, axis=1)
                best = None
                for w in np.flatnonzero(near <= near.min() + 1e-6):  # at a seam there are several
                    gaps = {"place": near[w], "uv": 0.0, "weights": 0.0, "keys": 0.0}
                    for row in set(rows) & set(has):
                        kind = "uv" if row.startswith("TEX") else "weights" if row == "weights" else "keys"
                        gaps[kind] = max(gaps[kind], np.abs(rows[row][v] - has[row][w]).max())
                    if best is None or sum(gaps.values()) < sum(best.values()):
                        best = gaps
                worst = {kind: max(worst[kind], best[kind]) for kind in worst}
    for name, parts in of_same.items():
        for (_, rows), (_, has) in zip(parts, of_worn[name]):
            lost += [f"{row} of {name} in the worn one" for row in rows if row not in has or not np.array_equal(rows[row], has[row])]
    for what in ("VRM", "VRMC_vrm", "VRMC_springBone"):
        if source.json.get("extensions", {}).get(what) != worn.json.get("extensions", {}).get(what):
            lost.append(what)
    keys = sum(len(m.get("extras", {}).get("targetNames", [])) for m in source.json["meshes"])
    moved = max(np.abs(a - b).max() for n in of_same for (a, _), (b, _) in zip(of_same[n], of_worn[n]))
    print(f"RESULT {keys} keys, {len(source.json.get('materials', []))} materials; off by at most: place "
          f"{worst['place']:.1e} m, uv {worst['uv']:.1e}, weight {worst['weights']:.1e}, key {worst['keys']:.1e} m; "
          f"worn moves by up to {moved:.3f} m; lost: {', '.join(lost) or 'nothing'}")
    bad = lost or worst["weights"] > 1 / 255 or worst["uv"] > 1 / 65535 or worst["keys"] > 1e-6 or worst["place"] > 1e-6
    return 1 if bad else 0


sys.exit(main())
