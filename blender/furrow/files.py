# SPDX-License-Identifier: GPL-3.0-or-later
"""Between Blender's data and the files that furrow reads and writes: metres, z up, in the world's place."""
import json
import re

import numpy


def coordinates(mesh):
    """Of the basis, whatever shape key is shown; (V, 3)."""
    points = mesh.shape_keys.reference_key.data if mesh.shape_keys else mesh.vertices
    flat = numpy.empty(3 * len(points), dtype=numpy.float64)
    points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def in_world(points, matrix, scale):
    m = numpy.array(matrix, dtype=numpy.float64)
    return (points @ m[:3, :3].T + m[:3, 3]) * scale


def in_object(points, matrix, scale):
    m = numpy.linalg.inv(numpy.array(matrix, dtype=numpy.float64))
    return (points / scale) @ m[:3, :3].T + m[:3, 3]


def parts_of(mesh):
    """Of each vertex: the lowest vertex of the part that hangs together with it, by edges."""
    ends = numpy.empty(2 * len(mesh.edges), dtype=numpy.int64)
    mesh.edges.foreach_get("vertices", ends)
    a, b = ends.reshape(-1, 2).T
    lowest, before = numpy.arange(len(mesh.vertices)), None
    while before is None or (lowest != before).any():
        before = lowest.copy()
        least = numpy.minimum(lowest[a], lowest[b])
        for end in (a, b):
            numpy.minimum.at(lowest, lowest[end], least)
            numpy.minimum.at(lowest, end, least)
        lowest = lowest[lowest]
    return lowest


def name_of_part(lowest):
    return "part_of_vertex_%d" % lowest


def write_obj(path, mesh, points):
    """The mesh at these points, with its texture coordinates; vertices and faces as Blender has them, each part a group."""
    uv, part, last = mesh.uv_layers.active, parts_of(mesh), None
    alone = (part == part[0]).all() if len(part) else True
    with open(path, "w") as out:
        out.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in points)
        if uv:
            out.writelines("vt %.9g %.9g\n" % tuple(loop.uv) for loop in uv.data)
        for face in mesh.polygons:
            if not alone and part[face.vertices[0]] != last:
                last = part[face.vertices[0]]
                out.write("g %s\n" % name_of_part(last))
            corners = zip(face.vertices, face.loop_indices)
            out.write("f " + " ".join("%d/%d" % (v + 1, l + 1) if uv else str(v + 1) for v, l in corners) + "\n")


def read_obj_points(path):
    with open(path) as text:
        return numpy.array([line.split()[1:4] for line in text if line.startswith("v ")], dtype=numpy.float64)


def read_ply_columns(path):
    """The vertices' columns of a PLY of furrow, by name."""
    kinds = {"double": "<f8", "float": "<f4", "int": "<i4", "uint": "<u4", "uchar": "u1", "char": "i1", "short": "<i2",
             "ushort": "<u2", "float64": "<f8", "float32": "<f4", "int32": "<i4", "uint32": "<u4", "uint8": "u1", "int8": "i1"}
    columns, count, element, binary = [], 0, "", False
    with open(path, "rb") as file:
        for line in iter(file.readline, b"end_header\n"):
            words = line.decode().split()
            if words[0] == "format":
                binary = words[1] == "binary_little_endian"
            elif words[0] == "element":
                element = words[1]
                count = int(words[2]) if element == "vertex" else count
            elif words[0] == "property" and element == "vertex":
                columns.append((words[2], kinds[words[1]]))
        if binary:
            rows = numpy.frombuffer(file.read(count * numpy.dtype(columns).itemsize), dtype=columns)
            return {name: rows[name] for name, _ in columns}
        rows = [file.readline().split() for _ in range(count)]
        return {name: numpy.array([float(row[i]) for row in rows]) for i, (name, _) in enumerate(columns)}


def line_of_layer(name, height):
    """What a layer's name says of its lines: "gather 80 %" draws them in; others have a height [m]."""
    share = re.search(r"gather\D*(\d+(?:\.\d+)?)\s*%", name.lower())
    if share:
        return {"gather": float(share[1]) / 100}
    told = re.search(r"(-?\d+(?:\.\d+)?)\s*mm", name)
    size = abs(float(told[1]) / 1000) if told else abs(height)
    valley = "valley" in name.lower() or (told and told[1].startswith("-")) or (not told and height < 0)
    return {"height": -size if valley and "ridge" not in name.lower() else size}


def pencil_strokes(pencil):
    """(layer's name, points as the object has them, closed) of each stroke in the frame that is shown."""
    for layer in pencil.data.layers:
        if layer.hide:
            continue
        name = layer.info if hasattr(layer, "info") else layer.name
        if hasattr(layer, "active_frame"):  # up to Blender 4.2
            strokes = layer.active_frame.strokes if layer.active_frame else []
            for stroke in strokes:
                yield name, [p.co for p in stroke.points], stroke.use_cyclic
        else:  # not tried by us
            frame = layer.current_frame()
            for stroke in frame.drawing.strokes if frame else []:
                yield name, [p.position for p in stroke.points], stroke.cyclic


def chains(edges):
    """Edges (pairs of vertices) as paths: (vertices, closed)."""
    beside = {}
    for a, b in edges:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    left = {frozenset(e) for e in edges}
    ends = [v for v in beside if len(beside[v]) != 2] + list(beside)
    for start in ends:
        for second in beside[start]:
            if frozenset((start, second)) not in left:
                continue
            path = [start, second]
            left.discard(frozenset(path))
            while len(beside[path[-1]]) == 2:
                following = [v for v in beside[path[-1]] if frozenset((path[-1], v)) in left]
                if not following:
                    break
                left.discard(frozenset((path[-1], following[0])))
                path.append(following[0])
            closed = path[0] == path[-1] and len(path) > 3
            yield path[:-1] if closed else path, closed


def write_strokes(path, strokes):
    with open(path, "w") as out:
        json.dump({"strokes": strokes}, out)
