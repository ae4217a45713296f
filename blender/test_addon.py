# SPDX-License-Identifier: GPL-3.0-or-later
"""blender -b --factory-startup -P test_addon.py -- FURROW MESHES FOLDER: the add-on, as its zip installs it, on a skirt and
its body: strokes of the Grease Pencil wrinkle it, it settles, keeps its lines and tells how it fits; it goes to another figure; edges as
lines; tangles; what the garment has beside its shape stays; a run that is stopped, or refused, leaves the scene as it was."""
import json
import os
import subprocess
import sys
import time

import bmesh
import bpy
import mathutils
import numpy

furrow, meshes, folder = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.preferences.addon_install(filepath=os.path.join(folder, "furrow-blender.zip"), overwrite=True)
bpy.ops.preferences.addon_enable(module="furrow")
bpy.context.preferences.addons["furrow"].preferences.program = furrow
import furrow.colours as colours_of_tangles
import furrow.files as files
import furrow.operators as operators
import furrow.runs as runs


def check(what, holds):
    print(("ok: " if holds else "FAILED: ") + what)
    if not holds:
        sys.stdout.flush()
        os._exit(1)


def from_obj(name):
    """A mesh object of an OBJ in metres, y up: z up here, moved and turned, as objects are."""
    points, faces = [], []
    with open(os.path.join(meshes, name)) as text:
        for line in text:
            words = line.split()
            if words and words[0] == "v":
                x, y, z = map(float, words[1:4])
                points.append((x, -z, y))
            elif words and words[0] == "f":
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def shape_of(obj, key=None):
    data = obj.data.shape_keys.key_blocks[key].data if key else obj.data.vertices
    flat = numpy.empty(3 * len(data))
    data.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def all_beside_shape(obj):
    """What must stay: UVs, materials, groups and weights, modifiers, faces, basis."""
    mesh = obj.data
    uv = [tuple(l.uv) for l in mesh.uv_layers.active.data]
    weights = [sorted((g.group, round(g.weight, 6)) for g in v.groups) for v in mesh.vertices]
    return (uv, [s.material.name for s in obj.material_slots], [p.material_index for p in mesh.polygons],
            [g.name for g in obj.vertex_groups], weights, [(m.name, m.type) for m in obj.modifiers],
            [tuple(p.vertices) for p in mesh.polygons], shape_of(obj).tolist())


for other in list(bpy.data.objects):
    bpy.data.objects.remove(other)
skirt, body = from_obj("skirt.obj"), from_obj("mannequin.obj")
place = mathutils.Matrix.Translation((0.3, -0.2, 0.1)) @ mathutils.Matrix.Rotation(0.4, 4, "Z")
skirt.matrix_world = body.matrix_world = place
uv = skirt.data.uv_layers.new(name="UV")
high = max(v.co.z for v in skirt.data.vertices)
low = min(v.co.z for v in skirt.data.vertices)
for face in skirt.data.polygons:
    angles = [numpy.arctan2(skirt.data.vertices[v].co.y, skirt.data.vertices[v].co.x) for v in face.vertices]
    turn = 2 * numpy.pi if max(angles) - min(angles) > numpy.pi else 0
    for angle, loop, v in zip(angles, face.loop_indices, face.vertices):
        u = (angle + (turn if angle < 0 else 0) + numpy.pi) / (3.5 * numpy.pi)
        uv.data[loop].uv = (u, 0.02 + 0.9 * (skirt.data.vertices[v].co.z - low) / (high - low))
top = skirt.vertex_groups.new(name="waist")
top.add([v.index for v in skirt.data.vertices if v.co.z > high - 0.01], 1.0, "REPLACE")
skirt.vertex_groups.new(name="bone").add(list(range(len(skirt.data.vertices))), 0.7, "REPLACE")
for name in ("cloth", "lining"):
    skirt.data.materials.append(bpy.data.materials.new(name))
rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
bpy.context.collection.objects.link(rig)
skirt.modifiers.new("Armature", "ARMATURE").object = rig
before = all_beside_shape(skirt)

pencil = bpy.data.grease_pencils.new("lines")
drawn = bpy.data.objects.new("lines", pencil)
bpy.context.collection.objects.link(drawn)
drawn.matrix_world = place
for name, angles in (("ridge 20 mm", (-1.57, -1.2)), ("valley", (-1.9,))):
    layer = pencil.layers.new(name)
    strokes = layer.frames.new(1).strokes
    for angle in angles:
        on = [v.co for v in skirt.data.vertices if abs(numpy.arctan2(v.co.y, v.co.x) - angle) < 0.03 and v.co.z < low + 0.35]
        on = sorted(on, key=lambda p: p.z)[::3]
        stroke = strokes.new()
        stroke.points.add(len(on))
        for point, at in zip(stroke.points, on):
            point.co = at

scene = bpy.context.scene
scene.frame_set(1)
scene.furrow.pencil, scene.furrow.body, scene.furrow.pins = drawn, body, "waist"
scene.furrow.height, scene.furrow.maps, scene.furrow.texels = -0.012, True, 256
bpy.context.view_layer.objects.active = skirt
skirt.select_set(True)

check("keep is not offered before there are lines", not bpy.ops.furrow.keep.poll())
check("wrinkle ends", bpy.ops.furrow.wrinkle() == {"FINISHED"})
far = numpy.linalg.norm(shape_of(skirt, "Furrow wrinkled") - shape_of(skirt), axis=1)
check("a shape key has the lines (moved by up to %.1f mm)" % (1000 * far.max()), 0.006 < far.max() < 0.05)
check("and the rest of the skirt is where it was", numpy.median(far) < 1e-3)
check("what is beside the shape stays", all_beside_shape(skirt) == before)
shader = next(n for n in bpy.data.materials["cloth"].node_tree.nodes if n.type == "BSDF_PRINCIPLED")
check("the map is wired to the normal", shader.inputs["Normal"].is_linked)
check("both materials have it", len([m for m in bpy.data.materials if m.node_tree and any(n.get("furrow") for n in m.node_tree.nodes)]) == 2)

check("settle ends", bpy.ops.furrow.settle() == {"FINISHED"})
held = [v.index for v in skirt.data.vertices if v.co.z > high - 0.01]
settled = shape_of(skirt, "Furrow settled")
check("what is pinned stays", numpy.abs(settled[held] - shape_of(skirt)[held]).max() < 1e-4)
there = operators.folder_of(skirt)
by_hand = [furrow, "wrinkle", "garment.obj", "lines.json", "--settle", "--body", "worn.obj", "--unit", "m", "--up", "z", "--pin-vertices",
           ",".join(map(str, held)), "--fabric", scene.furrow.fabric, "-o", os.path.join(folder, "by_hand.ply"), "--json", "-q"]
rest = json.loads(subprocess.run(by_hand, cwd=there, stdout=subprocess.PIPE, check=True).stdout)["at_rest"]
check("the program keeps 3 mm (%s)" % rest["gap"], rest["outcome"] == "at rest" and rest["gap"] == 0.003)
subprocess.run([furrow, "transfer", "garment.obj", os.path.join(folder, "by_hand.ply"), "-o", os.path.join(folder, "by_hand.obj"),
                "--unit", "m", "--up", "z", "-q"], cwd=there, check=True)
off = numpy.abs(files.in_world(settled, skirt.matrix_world, 1) - files.read_obj_points(os.path.join(folder, "by_hand.obj"))).max()
check("and the add-on's garment lies as the program's (%.2g m)" % off, off < 1e-5)
check("the rest hangs", numpy.linalg.norm(settled - shape_of(skirt), axis=1).max() > 0.004)
keys = skirt.data.shape_keys.key_blocks
check("the latest shape is shown alone", [k.value for k in keys] == [0.0, 0.0, 1.0] or keys["Furrow settled"].value == 1 and keys["Furrow wrinkled"].value == 0)
check("what is beside the shape stays", all_beside_shape(skirt) == before)

check("fit ends", bpy.ops.furrow.fit() == {"FINISHED"})
colours = skirt.data.color_attributes["Furrow fit"].data
check("and colours the skirt", len({tuple(round(c, 2) for c in d.color) for d in colours}) > 3)

# A run that is stopped leaves nothing; one that is refused says why.
shapes = [k.name for k in keys]


run = type("Begun", (operators.Job,), {"key": "settled", "prepare": operators.Settle.prepare})().begin(bpy.context)
run.poll()
time.sleep(0.3)
run.stop()
check("a run that is stopped has ended", run.process.poll() is not None)
check("and leaves the scene as it was", [k.name for k in keys] == shapes and all_beside_shape(skirt) == before)
scene.furrow.pins, scene.furrow.body = "", None
try:
    bpy.ops.furrow.settle()
    refused = ""
except RuntimeError as e:
    refused = str(e)
check("without pins and body it says what is missing", "nothing holds the garment" in refused)

# Made for the mannequin, worn by a taller figure that stands elsewhere.
def refusal(operator):
    try:
        return "nothing" if operator() == {"FINISHED"} else "no word"
    except RuntimeError as e:
        return str(e)


def in_world(points):
    return files.in_world(points, skirt.matrix_world, 1)


def length(points):
    return sum(numpy.linalg.norm(points[e.vertices[0]] - points[e.vertices[1]]) for e in skirt.data.edges)


def check_worn(how):
    """That it lies about the tall figure, in the size that it was made in."""
    now, made = in_world(shape_of(skirt, "Furrow settled")), in_world(shape_of(skirt))
    aside = numpy.linalg.norm((now.mean(axis=0) - made.mean(axis=0) - step)[:2])
    check("%s, it lies about the other figure (%.0f mm off)" % (how, 1000 * aside), aside < 0.03)
    raised = (now[held, 2].mean() - floor) / (made[held, 2].mean() - floor)
    check("at her waist (%.3f as high)" % raised, 1.05 < raised < 1.07)
    check("in its own size (%.4f)" % (length(now) / length(made)), abs(length(now) / length(made) - 1) < 0.02)
    check("and what is beside the shape stays", all_beside_shape(skirt) == before)


step, floor = numpy.array((0.9, 0.4, 0.0)), place.translation.z
tall = bpy.data.objects.new("tall", body.data)
bpy.context.collection.objects.link(tall)
tall.matrix_world = mathutils.Matrix.Translation(step) @ place @ mathutils.Matrix.Diagonal((1, 1, 1.06, 1))
sphere = bmesh.new()
bmesh.ops.create_icosphere(sphere, subdivisions=3, radius=0.8)
ball = bpy.data.objects.new("ball", bpy.data.meshes.new("ball"))
sphere.to_mesh(ball.data)
bpy.context.collection.objects.link(ball)
bpy.context.view_layer.update()
settled = settled.copy()
scene.furrow.maps, scene.furrow.made_for, scene.furrow.body, scene.furrow.pins = False, body, None, "waist"
check("made for a body and worn by none is refused as the command line does",
      "--made-for: brings a garment from one body to another" in refusal(bpy.ops.furrow.settle))
scene.furrow.body, scene.furrow.made_for = tall, skirt
check("a garment is not the body that it was made for", "is the garment itself" in refusal(bpy.ops.furrow.settle))
check("and the shape is as it was", (shape_of(skirt, "Furrow settled") == settled).all())
scene.furrow.made_for = body
check("settled on one body, it is brought to another", refusal(bpy.ops.furrow.settle) == "nothing")
check_worn("brought from there")
first = shape_of(skirt, "Furrow settled")
check("settled once more it goes on", refusal(bpy.ops.furrow.settle) == "nothing")
far = numpy.linalg.norm(shape_of(skirt, "Furrow settled") - first, axis=1).max()
check("from where it lies (%.1f mm)" % (1000 * far), far < 0.03)
check("wrinkled anew it lies as it was made", refusal(bpy.ops.furrow.wrinkle) == "nothing")
check("so it is not kept on the other figure", "settle it on tall first" in refusal(bpy.ops.furrow.keep))
check("nor is its fit told", "settle it on tall first" in refusal(bpy.ops.furrow.fit))
scene.furrow.made_for = ball
check("what is no figure is refused as the command line does", "made_for.obj: the body has no" in refusal(bpy.ops.furrow.settle))
scene.furrow.made_for = body
check("from the body that it was made for it is brought", refusal(bpy.ops.furrow.settle) == "nothing")
check_worn("brought as it was made")
scene.furrow.made_for = None

named = {name: files.line_of_layer(name, 0.01) for name in ("belly", "valley 12 mm", "ridge 20 mm", "Gather to 80 %")}
check("layers' names say what their lines are", named == {"belly": {"height": 0.01}, "valley 12 mm": {"height": -0.012},
                                                          "ridge 20 mm": {"height": 0.02}, "Gather to 80 %": {"gather": 0.8}})

# Edges of the mesh as lines, on another object.
n, size = 14, 0.03
grid = bpy.data.meshes.new("sheet")
grid.from_pydata([(size * (i - n / 2), 0, size * j) for j in range(n + 1) for i in range(n + 1)], [],
                 [(a, a + 1, a + n + 2, a + n + 1) for j in range(n) for a in range(j * (n + 1), j * (n + 1) + n)])
sheet = bpy.data.objects.new("sheet", grid)
bpy.context.collection.objects.link(sheet)
bpy.context.view_layer.objects.active = sheet
row = {(n + 1) * 7 + i for i in range(2, n - 1)}
for part in (sheet.data.vertices, sheet.data.polygons):  # all are selected in a new mesh
    part.foreach_set("select", [False] * len(part))
for v in row:
    sheet.data.vertices[v].select = True
for edge in sheet.data.edges:
    edge.select = edge.vertices[0] in row and edge.vertices[1] in row
selected = [tuple(e.vertices) for e in sheet.data.edges if e.select]
paths = list(files.chains([(0, 1), (1, 2), (5, 6), (6, 7), (7, 5), (2, 3)]))
check("edges become paths and loops", sorted((sorted(p), c) for p, c in paths) == [([0, 1, 2, 3], False), ([5, 6, 7], True)])
scene.furrow.lines_from, scene.furrow.height, scene.furrow.maps = "EDGES", 0.015, False
check("the sheet has a row of edges", len(selected) > 5)
bpy.ops.object.mode_set(mode="EDIT")  # as who selects edges is in
check("edges as lines end", bpy.ops.furrow.wrinkle() == {"FINISHED"})
check("and raise the sheet", numpy.abs(shape_of(sheet, "Furrow wrinkled") - shape_of(sheet)).max() > 0.008)

scene.furrow.pins = sheet.vertex_groups.new(name="top").name
sheet.vertex_groups["top"].add([v.index for v in sheet.data.vertices if v.co.z > max(w.co.z for w in sheet.data.vertices) - 1e-3], 1.0, "REPLACE")
check("keep ends", bpy.ops.furrow.keep() == {"FINISHED"})
check("and colours its line by the verdict", len({tuple(round(c, 2) for c in d.color) for d in sheet.data.color_attributes["Furrow verdict"].data}) > 1)
# A tongue through the sheet, and a ball within which it is held, are marked where they are.
def marked(colour):
    layer = crossed.data.color_attributes.get("Furrow tangles")
    return [i for i, d in enumerate(layer.data) if numpy.allclose(tuple(d.color)[:3], colour, atol=0.01)] if layer else None


check("cloth that crosses nowhere has no mark", "Furrow tangles" not in sheet.data.color_attributes and "Furrow tangles" not in skirt.data.color_attributes)
tongue = len(grid.vertices)
at = numpy.array((0.01, 0, 5.4 * size))  # within a face of the sheet
mesh = bpy.data.meshes.new("crossed")
mesh.from_pydata([tuple(v.co) for v in grid.vertices] + [tuple(at + p) for p in ((-0.004, -0.05, 0.004), (0.004, -0.05, 0.004), (0, 0.05, 0))],
                 [], [tuple(p.vertices) for p in grid.polygons] + [(tongue, tongue + 1, tongue + 2)])
crossed = bpy.data.objects.new("crossed", mesh)
bpy.context.collection.objects.link(crossed)
bpy.context.view_layer.objects.active = crossed
for part in (mesh.vertices, mesh.polygons):
    part.foreach_set("select", [False] * len(part))
row = {(n + 1) * 10 + i for i in range(2, n - 1)}
for edge in mesh.edges:
    edge.select = edge.vertices[0] in row and edge.vertices[1] in row
scene.furrow.width = 0.45  # so wide that the sheet swings
check("cloth that crosses itself is wrinkled", bpy.ops.furrow.wrinkle() == {"FINISHED"})
scene.furrow.width = 0
through = marked(colours_of_tangles.crossing)
cut = next(p for p in mesh.polygons if abs(p.center.x - at[0]) < size / 2 and abs(p.center.z - at[2]) < size / 2)
check("the tongue is marked, and three corners of the cell that it goes through", through[-3:] == [tongue, tongue + 1, tongue + 2]
      and len(through) == 6 and set(through[:3]) < set(cut.vertices))
check("and nothing else", len(marked(colours_of_tangles.pale)) == len(mesh.vertices) - 6)
top = crossed.vertex_groups.new(name="top")
top.add([v.index for v in mesh.vertices if v.co.z > size * n - 1e-3] + [tongue, tongue + 1, tongue + 2], 1.0, "REPLACE")
scene.furrow.body = None
check("cloth that swings off it is settled", bpy.ops.furrow.settle() == {"FINISHED"})
check("and the marks are gone", marked(colours_of_tangles.pale) is None)
ball.location, ball.scale = (0, 0, size * n), (1 / 16, 1 / 16, 1 / 16)  # 5 cm
bpy.context.view_layer.update()
scene.furrow.body = ball
check("cloth that is held inside a body is settled", bpy.ops.furrow.settle() == {"FINISHED"})
inside = marked(colours_of_tangles.pierced)
middle = (n + 1) * n + n // 2
off = numpy.linalg.norm(shape_of(crossed, "Furrow settled")[inside] - numpy.array(ball.location), axis=1)
check("the body is marked where it comes through (%d vertices)" % len(inside), middle in inside and len(inside) > 3)
check("and nowhere else (%.0f mm off its middle)" % (1000 * off.max()), off.max() < 0.05 + 1.5 * size)
check("for there the cloth does not cross itself", marked(colours_of_tangles.crossing) == [])

# A patch before the sheet goes along with it, or falls, as its vertex group says.
def sheet_with_patch(off):
    first, at = len(grid.vertices), numpy.array((0, -off, 6.5 * size))
    mesh = bpy.data.meshes.new("patched")
    mesh.from_pydata([tuple(v.co) for v in grid.vertices] + [tuple(at + 0.02 * numpy.array(p)) for p in ((-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1))],
                     [], [tuple(p.vertices) for p in grid.polygons] + [(first, first + 1, first + 2, first + 3)])
    obj = bpy.data.objects.new("patched %g" % off, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    rim = [v.index for v in mesh.vertices if v.co.z > size * n - 1e-3 and v.index < first]
    obj.vertex_groups.new(name="top").add(rim, 1.0, "REPLACE")
    obj.vertex_groups.new(name="patch").add([first + 2], 1.0, "REPLACE")  # one vertex names its part
    return obj


def said_of_patch(obj):
    """The program's warnings, as it settles the sheet from its own shape."""
    obj.pop("furrow_cloth", None)
    run = type("Begun", (operators.Job,), {"key": "settled", "prepare": operators.Settle.prepare})().begin(bpy.context)
    run.wait()
    return [line for line in run.warnings if "'part_of_vertex_%d'" % (len(obj.data.vertices) - 4) in line]


scene.furrow.body, scene.furrow.pins = None, "top"
far, near = sheet_with_patch(0.15), sheet_with_patch(0.001)
found, loose = "lies on other cloth, and goes with it", "nothing holds 1 of its 2 parts"
for obj, attach, free, expected in ((far, "", "", loose), (far, "patch", "", ""), (far, "", "patch", loose), (near, "", "", found), (near, "", "patch", loose)):
    bpy.context.view_layer.objects.active = obj
    scene.furrow.attach, scene.furrow.free = attach, free
    said = "".join(said_of_patch(obj))
    check("%s, along: '%s', freely: '%s': '%s'" % (obj.name, attach, free, expected), expected in said and bool(expected) == bool(said))
scene.furrow.attach = ""
check("the patched sheet is settled", refusal(bpy.ops.furrow.settle) == "nothing")
scene.furrow.free, scene.furrow.attach = "", "patch"
check("and settled again from there, with another choice", refusal(bpy.ops.furrow.settle) == "nothing")
scene.furrow.free, scene.furrow.attach = "", "top"
check("what carries the others is refused by name", "part_of_vertex_0" in refusal(bpy.ops.furrow.settle))
scene.furrow.attach = ""
print("all passed")
