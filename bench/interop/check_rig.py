# SPDX-License-Identifier: GPL-3.0-or-later
"""blender -b --factory-startup -P check_rig.py -- SOURCE.glb MADE.glb: what Blender makes of a garment that came and went.

Bones, materials, pictures, groups and action are the same; where a vertex of the source is in what was made, it has
the same weights and texture coordinates, and stands in the same place at rest and posed."""
import sys

import bpy
import mathutils
import numpy

if "bool" not in vars(numpy):  # as in check_blender.py
    numpy.bool = bool

SAME = 2e-6  # [m]
source, made = sys.argv[sys.argv.index("--") + 1 :]
failures = []


def points_of(shirt):
    bpy.context.view_layer.update()
    shown = shirt.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [tuple(shown.matrix_world @ v.co) for v in shown.data.vertices]


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    rig = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    shirt = next(o for o in bpy.data.objects if o.type == "MESH" and o.parent == rig)
    mesh = shirt.data
    told = {
        "bones": [(b.name, b.parent.name if b.parent else None, tuple(rig.matrix_world @ b.head_local),
                   tuple(rig.matrix_world @ b.tail_local)) for b in rig.data.bones],
        "materials": [m.name for m in mesh.materials],
        "pictures": [(i.name, tuple(i.size)) for i in bpy.data.images if i.size[0]],
        "groups": sorted(g.name for g in shirt.vertex_groups),
        "armature": [m.object.name for m in shirt.modifiers if m.type == "ARMATURE"],
        "actions": [(a.name, len(a.fcurves)) for a in bpy.data.actions],
    }
    weights = [{shirt.vertex_groups[g.group].name: g.weight for g in v.groups} for v in mesh.vertices]
    coordinates = [set() for v in mesh.vertices]
    for loop, uv in zip(mesh.loops, mesh.uv_layers[0].data):
        coordinates[loop.vertex_index].add((round(uv.uv[0], 5), round(uv.uv[1], 5)))
    raw = [tuple(v.co) for v in mesh.vertices]
    bpy.context.scene.frame_set(1)
    rest = points_of(shirt)
    bpy.context.scene.frame_set(20)
    return told, raw, weights, coordinates, rest, points_of(shirt)


def apart(p, q):
    return max(abs(a - b) for a, b in zip(p, q))


told, raw, weights, coordinates, rest, posed = load(source)
told_2, raw_2, weights_2, coordinates_2, rest_2, posed_2 = load(made)
for what in told:
    if told[what] != told_2[what]:
        failures.append(f"{what}: {told[what]} became {told_2[what]}")
by_place = {}
for i, p in enumerate(raw_2):
    by_place.setdefault(p, []).append(i)
found = {i: min(by_place[p], key=lambda j: len(coordinates[i] ^ coordinates_2[j])) for i, p in enumerate(raw) if p in by_place}
worst = max((abs(weights[i].get(g, 0) - weights_2[j].get(g, 0))
             for i, j in found.items() for g in {*weights[i], *weights_2[j]}), default=0)
at_rest = max((apart(rest[i], rest_2[j]) for i, j in found.items()), default=0)
when_posed = max((apart(posed[i], posed_2[j]) for i, j in found.items()), default=0)
other = sum(coordinates[i] != coordinates_2[j] for i, j in found.items())
tree = mathutils.kdtree.KDTree(len(posed_2))
for i, p in enumerate(posed_2):
    tree.insert(p, i)
tree.balance()
far = max(tree.find(p)[2] for p in posed)
print(f"RESULT {made}: {len(raw_2)} vertices, {len(found)} of {len(raw)} in place; weights within {worst:.1e}, "
      f"{other} other texture coordinates, {at_rest:.1e} m apart at rest, {when_posed:.1e} m posed; "
      f"farthest of all from the nearest, posed: {1000 * far:.2f} mm")
if worst > 1e-6 or other or at_rest > SAME or when_posed > SAME:
    failures.append("what did not move is not as it was")
if failures:
    print("RESULT FAILED:", "; ".join(failures))
    sys.exit(1)
