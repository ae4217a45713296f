# SPDX-License-Identifier: GPL-3.0-or-later
"""Garments, a body and steps of Blender's cloth, for blender_drape.py and blender_layers.py.

A frame is 31.6 ms whatever the frame rate, for gravity is 0.00981 m per frame and frame. Processor seconds are of
stepping alone.

Mass is the preset's, 0.3 kg a vertex: how cloth hangs depends on stiffness over mass. The true mass of cotton, 0.02 g
a vertex, at the preset's stiffness is more than the solver takes: without air, 3,150 vertices fall 22 mm
in ten frames in place of 490. (Of springs: force a strain is stiffness times 1000 s^-2 times their length over the
mean length, so that 150 is about cotton's 1000 N/m for that mesh.)

Friction is that of the body, in hundredths of Coulomb's coefficient. The cloth keeps the sum of its own distance and
the body's thickness from it, neither of which can be below 1 mm.
"""
import argparse
import json
import sys
import time

import bpy
import numpy


def parser():
    """With the options of every drape."""
    p = argparse.ArgumentParser()
    p.add_argument("--frames", type=int, default=250, help="at most")
    p.add_argument("--still", type=float, default=4.9e-6,
                   help="ends when no vertex moves farther in a frame [m]; so far falls in it, from rest, what a "
                   "thousandth of gravity pulls, which is the residual force at which `furrow drape` ends")
    p.add_argument("--gap", type=float, default=0.003, help="[m]")
    p.add_argument("--friction", type=float, default=0.4, help="Coulomb's coefficient")
    p.add_argument("--stiffness", type=float, default=15, help="tension, compression and shear; 15: its preset of cotton")
    p.add_argument("--bending", type=float, default=0.5, help="0.5: its preset of cotton")
    p.add_argument("--quality", type=int, default=5, help="steps a frame; 5: its preset of cotton")
    return p


def parse(p):
    return p.parse_args(sys.argv[sys.argv.index("--") + 1:])


def read_obj(path):
    points, faces = [], []
    with open(path) as lines:
        for words in map(str.split, lines):
            if words[:1] == ["v"]:
                points.append([float(w) for w in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(w.split("/")[0]) for w in words[1:]]
                faces.append([c - 1 if c > 0 else len(points) + c for c in corners])
    return points, faces


def write_obj(path, points, faces):
    with open(path, "w") as out:
        for p in points:
            out.write("v %.9g %.9g %.9g\n" % tuple(p))
        for f in faces:
            out.write("f " + " ".join(str(c + 1) for c in f) + "\n")


def add_object(name, points, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def positions(thing):
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    flat = numpy.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def add_cloth(o, name, points, faces):
    """A garment and its modifier, without self-collision."""
    garment = add_object(name, points, faces)
    cloth = garment.modifiers.new("cloth", "CLOTH")
    s = cloth.settings
    s.quality = o.quality
    s.mass = 0.3
    s.tension_stiffness = s.compression_stiffness = s.shear_stiffness = o.stiffness
    s.bending_stiffness = o.bending
    s.tension_damping = s.compression_damping = s.shear_damping = 5
    s.bending_damping = 0.5
    s.air_damping = 1
    c = cloth.collision_settings
    c.use_collision, c.use_self_collision = True, False
    c.distance_min = o.gap - 0.001
    cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, o.frames + 1
    return garment, cloth


def add_body(o):
    body = add_object("body", *read_obj(o.body))
    body.modifiers.new("collision", "COLLISION")
    body.collision.thickness_outer = 0.001
    body.collision.cloth_friction = 100 * o.friction


def begin():
    """An empty scene with gravity."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.use_gravity, scene.gravity = True, (0, -9.81, 0)


def step(o, garments):
    """Frames until all are still, or o.frames: the last shapes, and what main programs tell of the way."""
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, o.frames + 1
    scene.frame_set(1)
    last, seconds, motion = numpy.concatenate([positions(g) for g in garments]), [], []
    while len(motion) < o.frames:
        before, start = last, time.process_time()
        scene.frame_set(len(motion) + 2)
        seconds.append(time.process_time() - start)
        last = numpy.concatenate([positions(g) for g in garments])
        moves = numpy.linalg.norm(last - before, axis=1)
        motion.append(float(moves.max()))
        if not motion[-1] > o.still:
            break
    below = next((i for i in range(len(motion)) if max(motion[i:]) < 1e-3), None)  # and stays there
    return last, {
        "version": bpy.app.version_string, "vertices": len(last), "frames": len(motion),
        "processor_seconds": round(sum(seconds), 3), "motion_mm": round(1e3 * motion[-1], 4),
        "motion_p95_mm": round(1e3 * float(numpy.percentile(moves, 95)), 4),
        "processor_seconds_to_1_mm": None if below is None else round(sum(seconds[:below + 1]), 3),
        "threads": scene.render.threads, "finite": bool(numpy.isfinite(last).all())}


def tell(report, cloth):
    """One line of JSON, with the modifier's settings as Blender took them."""
    print(json.dumps(report | {
        "stiffness": cloth.settings.tension_stiffness, "quality": cloth.settings.quality,
        "distance_m": round(cloth.collision_settings.distance_min + 0.001, 6)}), flush=True)
