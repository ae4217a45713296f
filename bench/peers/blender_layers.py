# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's cloth drapes two garments over each other on a body, all OBJ (metres, y up):

  OMP_NUM_THREADS=1 blender -b --factory-startup -t 1 --python-exit-code 1 -P blender_layers.py -- \
      INNER OUTER BODY INNER_OUTPUT OUTER_OUTPUT [--way one|two|over] [--self-distance 0.001] [--start INNER OUTER] ...

one: both are one cloth with self-collision. two: a cloth each, with self-collision, and each is a collision object
of the other, the inner one of its outer side (which is how Blender recovers what has passed through), the outer one
of both. over: likewise, but the inner one does not feel the outer one, as those do who dress layer by layer.

Both start as they lie in their files, or, as drawn cloth, where those of --start lie (the same meshes). Writes the
last shapes, vertices and faces in the garments' order, and prints one JSON line. What its numbers mean:
blender_cloth.py.
"""
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from blender_cloth import add_body, add_cloth, begin, parse, parser, read_obj, step, tell, write_obj


def options():
    p = parser()
    for name in ("inner", "outer", "body", "inner_output", "outer_output"):
        p.add_argument(name)
    p.add_argument("--way", choices=("one", "two", "over"), default="one")
    p.add_argument("--start", nargs=2, help="where the garments begin; what they are drawn as stays their rest shape")
    p.add_argument("--self-distance", type=float, default=0.001, help="[m]; Blender's least; its default is 0.015")
    p.add_argument("--self-friction", type=float, default=0, help="of cloth on cloth; Blender's default is 5")
    p.add_argument("--collision-quality", type=int, default=2, help="rounds of collisions a step; 2: Blender's default")
    return parse(p)


def joined(first, second):
    """Two lists of points and faces as one."""
    return first[0] + second[0], first[1] + [[c + len(first[0]) for c in face] for face in second[1]]


def add_layer(o, name, drawn, start):
    """A cloth with self-collision that begins at `start` and is at rest as `drawn`."""
    garment, cloth = add_cloth(o, name, start[0], drawn[1])
    garment.shape_key_add(name="start")
    rest = garment.shape_key_add(name="drawn")
    rest.data.foreach_set("co", [c for p in drawn[0] for c in p])
    cloth.settings.rest_shape_key = rest
    c = cloth.collision_settings
    c.use_self_collision, c.self_distance_min, c.self_friction = True, o.self_distance, o.self_friction
    c.collision_quality = o.collision_quality
    return garment, cloth


def make_collide(o, garment, one_sided):
    garment.modifiers.new("collision", "COLLISION")
    c = garment.collision
    c.thickness_outer = c.thickness_inner = 0.001
    c.use_culling = one_sided
    c.cloth_friction = o.self_friction


def add_layers(o, drawn, start):
    if o.way == "one":
        return [add_layer(o, "garments", joined(*drawn), joined(*start))]
    inner, outer = (add_layer(o, name, *shapes) for name, *shapes in zip(("inner", "outer"), drawn, start))
    make_collide(o, inner[0], True)
    if o.way == "two":
        make_collide(o, outer[0], False)
    return [inner, outer]


def main():
    o = options()
    begin()
    drawn = [read_obj(o.inner), read_obj(o.outer)]
    start = [read_obj(path) for path in o.start] if o.start else drawn
    if [len(points) for points, _ in start] != [len(points) for points, _ in drawn]:
        sys.exit("blender_layers: --start has other meshes than the garments")
    layers = add_layers(o, drawn, start)
    add_body(o)
    last, report = step(o, [garment for garment, _ in layers])
    inner = len(drawn[0][0])
    write_obj(o.inner_output, last[:inner], drawn[0][1])
    write_obj(o.outer_output, last[inner:], drawn[1][1])
    settings = layers[0][1].collision_settings
    tell(report | {
        "way": o.way, "self_distance_m": round(settings.self_distance_min, 6),
        "collision_quality": settings.collision_quality, "self_friction": settings.self_friction}, layers[0][1])


main()
