# SPDX-License-Identifier: GPL-3.0-or-later
"""blender -b --factory-startup -P make_rig.py -- FILE.glb: a shirt with arms on a figure in T-pose, as a shop sells it.

Its armature stands off the origin, turned, and 1.1 times as large; two materials, one of them with a picture; a seam
in the texture; two to four joints at a vertex; an action that bends an arm."""
import math
import sys

import bpy
import numpy

if "bool" not in vars(numpy):  # as in check_blender.py
    numpy.bool = bool

AROUND, ALONG = 48, 40


def add_armature():
    armature = bpy.data.armatures.new("Rig")
    rig = bpy.data.objects.new("Rig", armature)
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")

    def bone(name, head, tail, parent=None):
        made = armature.edit_bones.new(name)
        made.head, made.tail = head, tail
        made.parent = armature.edit_bones[parent] if parent else None

    bone("hips", (0, 0, 0.9), (0, 0, 1.1))
    bone("spine", (0, 0, 1.1), (0, 0, 1.5), "hips")
    for side, x in (("L", 1), ("R", -1)):
        bone(f"upper arm.{side}", (0.18 * x, 0, 1.4), (0.45 * x, 0, 1.4), "spine")
        bone(f"hand.{side}", (0.45 * x, 0, 1.4), (0.75 * x, 0, 1.4), f"upper arm.{side}")
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.location, rig.rotation_euler, rig.scale = (0.1, 0.2, 0.05), (0, 0, 0.3), (1.1, 1.1, 1.1)
    return rig


def add_tube(points, faces, coordinates, place):
    """A tube of quads; its seam has two texture coordinates."""
    first = len(points)
    for j in range(ALONG + 1):
        for i in range(AROUND):
            points.append(place(2 * math.pi * i / AROUND, j / ALONG))
    for j in range(ALONG):
        for i in range(AROUND):
            k = (i + 1) % AROUND
            corners = (j * AROUND + i, j * AROUND + k, (j + 1) * AROUND + k, (j + 1) * AROUND + i)
            faces.append(tuple(first + c for c in corners))
            u, v = (i / AROUND, (i + 1) / AROUND), (j / ALONG, (j + 1) / ALONG)
            coordinates.append([(u[0], v[0]), (u[1], v[0]), (u[1], v[1]), (u[0], v[1])])


def sleeve(side):
    turn = lambda a: a if side > 0 else -a  # so that faces look outwards on both sides
    return lambda a, t: (side * (0.2 + 0.5 * t), 0.07 * math.cos(turn(a)), 1.36 + 0.07 * math.sin(turn(a)))


def add_mesh(rig):
    points, faces, coordinates = [], [], []
    add_tube(points, faces, coordinates,
             lambda a, t: (0.187 * math.cos(a), 0.136 * math.sin(a), 0.9 + 0.55 * t))
    for side in (1, -1):
        add_tube(points, faces, coordinates, sleeve(side))
    mesh = bpy.data.meshes.new("ShirtMesh")
    mesh.from_pydata(points, [], faces)
    layer = mesh.uv_layers.new(name="UVMap")
    for polygon, corners in zip(mesh.polygons, coordinates):
        polygon.use_smooth = True
        for corner, loop in zip(corners, polygon.loop_indices):
            layer.data[loop].uv = corner
    shirt = bpy.data.objects.new("Shirt", mesh)
    bpy.context.collection.objects.link(shirt)
    shirt.parent = rig
    shirt.modifiers.new("Armature", "ARMATURE").object = rig
    return shirt


def add_materials(mesh):
    image = bpy.data.images.new("weave", 16, 16)
    image.pixels = [value for y in range(16) for x in range(16) for value in ((x + y) % 2, 0.3, y / 16, 1)]
    image.pack()
    for name, colour in (("silk", (1, 1, 1, 1)), ("hem", (0.8, 0.1, 0.1, 1))):
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        shader = material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = colour
        if name == "silk":
            texture = material.node_tree.nodes.new("ShaderNodeTexImage")
            texture.image = image
            material.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
        mesh.materials.append(material)
    for polygon in mesh.polygons:
        polygon.material_index = 1 if polygon.center.z < 1.0 else 0


def clamp(x):
    return min(max(x, 0), 1)


def add_weights(shirt, rig):
    groups = {bone.name: shirt.vertex_groups.new(name=bone.name) for bone in rig.data.bones}
    for vertex in shirt.data.vertices:
        x, z = vertex.co.x, vertex.co.z
        side = "L" if x > 0 else "R"
        up, out, far = clamp((z - 1.0) / 0.2), clamp((abs(x) - 0.1) / 0.15) * clamp((z - 1.25) / 0.05), clamp((abs(x) - 0.35) / 0.2)
        weights = {"hips": (1 - up) * (1 - out), "spine": up * (1 - out),
                   f"upper arm.{side}": out * (1 - far), f"hand.{side}": out * far}
        for name, weight in weights.items():
            if weight > 0:
                groups[name].add([vertex.index], weight, "REPLACE")


def add_action(rig):
    bone = rig.pose.bones["upper arm.L"]
    bone.rotation_mode = "QUATERNION"
    for frame, angle in ((1, 0), (20, 0.8)):
        bone.rotation_quaternion = (math.cos(angle / 2), math.sin(angle / 2), 0, 0)
        bone.keyframe_insert("rotation_quaternion", frame=frame)
    bpy.context.scene.frame_set(1)


bpy.ops.wm.read_factory_settings(use_empty=True)
rig = add_armature()
shirt = add_mesh(rig)
add_materials(shirt.data)
add_weights(shirt, rig)
add_action(rig)
try:
    bpy.ops.export_scene.gltf(filepath=sys.argv[sys.argv.index("--") + 1], export_format="GLB")
except Exception as error:  # Blender would end with 0
    print(error)
    sys.exit(1)
