# SPDX-License-Identifier: GPL-3.0-or-later
"""blender -b --factory-startup -P check_blender.py -- FOLDER: what Blender makes of the files of write_animation."""
import array
import os
import sys

import bpy
import mathutils
import numpy

# The importer of Debian 12's Blender 3.4.1 uses numpy.bool, a name that Debian's NumPy 1.24 no longer has.
if "bool" not in vars(numpy):
    numpy.bool = bool

FPS = 25
LIMIT = 1e-6  # [m]
folder = sys.argv[sys.argv.index("--") + 1]
failures = []


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = FPS


def expected_frames(vertices):
    numbers = array.array("d")
    with open(os.path.join(folder, "expected.f64"), "rb") as file:
        numbers.frombytes(file.read())
    assert sys.byteorder == "little" and len(numbers) % (3 * vertices) == 0
    points = list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))
    return [points[i : i + vertices] for i in range(0, len(points), vertices)]


def evaluated(obj):
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return [tuple(obj.matrix_world @ v.co) for v in mesh.vertices]


def y_up(points):  # Blender's importers turn y up into z up
    return [(x, z, -y) for x, y, z in points]


def farthest(found, wanted):
    return max(abs(a - b) for p, q in zip(found, wanted) for a, b in zip(p, q))


def judge(what, error):
    good = error <= LIMIT
    print(f"RESULT {what}: largest difference {error:.2e} m {'ok' if good else 'TOO LARGE'}")
    if not good:
        failures.append(what)


def load_sheet():
    clear()
    bpy.ops.wm.obj_import(filepath=os.path.join(folder, "sheet.obj"))  # y up, as a user's click does it
    return bpy.context.selected_objects[0]


def check_cache(name, kind):
    obj = load_sheet()
    frames = expected_frames(len(obj.data.vertices))
    cache = obj.modifiers.new("cache", "MESH_CACHE")
    cache.cache_format = kind
    cache.filepath = os.path.join(folder, name)
    cache.time_mode = "FRAME"
    cache.frame_start = 0
    worst = 0
    for i, wanted in enumerate(frames):
        bpy.context.scene.frame_set(i)
        worst = max(worst, farthest(y_up(evaluated(obj)), wanted))
    judge(f"{name} through a Mesh Cache modifier, {len(frames)} frames of {len(obj.data.vertices)} vertices", worst)


def check_glb(name, halfway):
    frames = expected_frames(len(load_sheet().data.vertices))
    clear()
    bpy.ops.import_scene.gltf(filepath=os.path.join(folder, name))
    obj = next(o for o in bpy.data.objects if o.type == "MESH")
    keys = obj.data.shape_keys.key_blocks
    if len(keys) != len(frames):
        failures.append(name)
    print(f"RESULT {name}: {len(keys)} shape keys with the basis, {len(frames)} frames; {len(obj.data.vertices)} vertices")
    # Vertices at a texture seam appear twice: find by its place in frame 0 which vertex of ours each one is.
    ours = mathutils.kdtree.KDTree(len(frames[0]))
    for i, p in enumerate(frames[0]):
        ours.insert(p, i)
    ours.balance()
    index = [ours.find(p)[1] for p in y_up([v.co for v in obj.data.vertices])]
    assert set(index) == set(range(len(frames[0])))
    error = max(farthest(y_up([k.co for k in key.data]), [frames[i][v] for v in index]) for i, key in enumerate(keys))
    judge(f"{name}, shape keys", error)
    error = 0
    for i in range(len(frames)):
        bpy.context.scene.frame_set(i)
        error = max(error, farthest(y_up(evaluated(obj)), [frames[i][v] for v in index]))
    judge(f"{name}, played", error)
    bpy.context.scene.frame_set(3, subframe=0.5)
    between = [tuple((1 - halfway) * a + halfway * b for a, b in zip(frames[3][v], frames[4][v])) for v in index]
    judge(f"{name}, played at frame 3.5", farthest(y_up(evaluated(obj)), between))


try:
    check_cache("sheet.pc2", "PC2")
    check_cache("sheet.mdd", "MDD")
    check_glb("sheet-linear.glb", 0.5)
    check_glb("sheet-step.glb", 0)
except Exception as error:  # Blender would end with 0
    failures.append(repr(error))
if failures:
    print("FAILED:", "; ".join(failures))
    sys.exit(1)
