# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's cloth drapes a garment on a body, both OBJ (metres, y up):

  OMP_NUM_THREADS=1 blender -b --factory-startup -t 1 --python-exit-code 1 -P blender_drape.py -- \
      GARMENT BODY OUTPUT [--frames 250] [--stiffness 15] ...

Writes the last shape, vertices and faces in the garment's order, and prints one JSON line. What its numbers mean:
blender_cloth.py.
"""
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from blender_cloth import add_body, add_cloth, begin, parse, parser, read_obj, step, tell, write_obj


def options():
    p = parser()
    p.add_argument("garment")
    p.add_argument("body")
    p.add_argument("output")
    return parse(p)


def main():
    o = options()
    begin()
    points, faces = read_obj(o.garment)
    add_body(o)
    garment, cloth = add_cloth(o, "garment", points, faces)
    last, report = step(o, [garment])
    write_obj(o.output, last, faces)
    tell(report, cloth)


main()
