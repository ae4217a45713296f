# SPDX-License-Identifier: GPL-3.0-or-later
"""What is told of the cloth, as colour attributes of the mesh: verdicts, fit, and where the cloth crosses itself or the
body. The cloth may be finer than the mesh; the mesh is taken in the shape that is shown."""
import json
import os

import mathutils
import numpy

from . import files

pale, crossing, pierced = (0.85, 0.82, 0.78), (0.84, 0.0, 0.58), (0.95, 0.53, 0.24)


def nearest(points, asked):
    """Of each that is asked, the index of the point next to it."""
    tree = mathutils.kdtree.KDTree(len(points))
    for i, p in enumerate(points):
        tree.insert(p, i)
    tree.balance()
    return numpy.array([tree.find(p)[1] for p in asked], dtype=int)


def places(columns):
    """Of the cloth's vertices, by the columns of its PLY."""
    return numpy.stack([columns[c] for c in "xyz"], axis=1).astype(numpy.float64)


def shown_points(job):
    return files.read_obj_points(os.path.join(job.folder, "shape.obj"))


def paint(mesh, name, colours):
    """A colour of each vertex, as the attribute of that name, which is shown."""
    layer = mesh.color_attributes.get(name) or mesh.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    rgba = numpy.ones((len(colours), 4), dtype=numpy.float32)
    rgba[:, :3] = colours
    layer.data.foreach_set("color", rgba.ravel())
    mesh.color_attributes.active_color = layer


def colour_by_nearest(job, columns, colours, name):
    """Colours of the cloth's vertices, at the mesh's: that of the nearest."""
    paint(job.obj.data, name, colours[nearest(places(columns), shown_points(job))])


def told_tangles(report):
    """Of a program's report: vertices of faces of the cloth that cross, and of those that the body comes through."""
    fit = report.get("fit") or {}
    return report["crossings"].get("corners", []), (fit.get("distance") or {}).get("pierced_corners", [])


def colour_tangles(job, run):
    """Marks each vertex of the mesh next to which the cloth crosses itself or the body, and those of the mesh's own faces
    that cross, if they do. Without any, an earlier result's marks are taken away."""
    name, mesh = "Furrow tangles", job.obj.data
    crossed, through = told_tangles(json.loads(run.outputs[0]))
    own, _ = told_tangles(json.loads(run.outputs[1]))
    if not crossed and not through and not own:
        if mesh.color_attributes.get(name):
            mesh.color_attributes.remove(mesh.color_attributes[name])
        return
    cloth = places(files.read_ply_columns(os.path.join(job.folder, "cloth.ply")))
    shape = shown_points(job)
    of_shape = nearest(cloth, shape)
    colours = numpy.tile(pale, (len(shape), 1))
    for corners, colour in ((through, pierced), (crossed, crossing)):
        colours[numpy.isin(of_shape, corners)] = colour
        colours[nearest(shape, cloth[corners])] = colour
    colours[own] = crossing
    paint(mesh, name, colours)
