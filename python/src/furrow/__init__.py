# SPDX-License-Identifier: GPL-3.0-or-later
"""Cloth that wrinkles where you draw: the jobs of the program `furrow`, on arrays of numpy.

    import furrow
    shirt = furrow.read_mesh("shirt.obj")
    worn = furrow.drape(shirt, body="body.obj", fabric="cotton")
    print(worn.report["garments"], worn.mesh.V.mean(axis=0))

Metres, y up, SI units. Keywords are the command line's flags with underscores (docs/python.md).
"""
import inspect as _inspect
import warnings as _warnings

from . import _furrow
from ._furrow import Columns, Mesh

__version__ = _furrow.version


class ContentError(Exception):
    """A mesh, a stroke, a scene or a file cannot be used; the message says where and what to do."""


class Cancelled(Exception):
    """A job ended because its `cancel` said so, before there was anything to report."""


class TooMuchWork(ValueError):
    """More memory or time than an option allows; the message says which."""


class FurrowWarning(UserWarning):
    """What is no error, and hardly what was meant."""

    def __init__(self, text, code="", where="", help=""):
        super().__init__(text)
        self.code, self.where, self.help = code, where, help


class FailureWarning(FurrowWarning):
    """Why a result is no success: the command line would exit with 4."""


_furrow.translate_errors({"ContentError": ContentError, "Cancelled": Cancelled, "TooMuchWork": TooMuchWork})


class Result:
    """What a job came to.

    report: what --json prints, as a dict. mesh: the garment as the job left it; None: there is none.
    meshes: of several garments, all. succeeded: whether the command line would exit with 0.
    failures: why not, each a FailureWarning.
    """

    def __init__(self, job, report, meshes, succeeded, failures):
        self.job, self.report, self.meshes = job, report, meshes
        self.succeeded, self.failures = succeeded, failures

    @property
    def mesh(self):
        return self.meshes[0] if self.meshes else None

    def __repr__(self):
        meshes = ", ".join(repr(m) for m in self.meshes) or "no mesh"
        return f"<furrow.Result of {self.job}: {'succeeded' if self.succeeded else 'failed'}, {meshes}>"


def _warner(category=FurrowWarning, level=4):
    def warn(code, text, where, help):
        warning = category(text, code, where, help)
        _warnings.warn(warning, stacklevel=level)
        return warning
    return warn


def _repaired(text, name):
    """Called where a mesh that was made of arrays had to be mended."""
    _warnings.warn(FurrowWarning(text, "repaired", name), stacklevel=2)


def _run(job, inputs, given):
    report, meshes, failures, succeeded = _furrow.run(job, inputs, given, _warner())
    failed = _warner(FailureWarning)
    return Result(job, report, meshes, succeeded, [failed(*failure) for failure in failures])


def _listed(value):
    return list(value) if isinstance(value, (list, tuple)) else [value]


# Of each job: its inputs, those that may be left out, and what it does.
_JOBS = {
    "wrinkle": (("garment", "strokes"), ("garment",),
                "Turn drawn ridge and valley lines into wrinkles.\n\n"
                "garment: a mesh or its file; None with state. strokes: their file, or a list of dicts with the\n"
                "keys of a stroke file (docs/strokes.md). Below a second for 10,000 vertices and ten lines."),
    "simulate": (("garment",), ("garment",),
                 "Let a garment hang, fall and rest on a body.\n\n"
                 "garment: a mesh, its file, a scene's file (.toml), or a dict of a scene's settings\n"
                 "(docs/scenes.md) in which meshes and lists of strokes may stand for files; None with state."),
    "drape": (("garment",), (),
              "Put a finished garment on a body, or hang it from its pins: how it comes to rest.\n\n"
              "garment: as in simulate; or a list of meshes that are worn over each other, the innermost first."),
    "keep": (("garment",), ("garment",),
             "Give a garment the rest state that keeps its drawn lines, and tell of each whether it will hold.\n\n"
             "garment: as in simulate; None with state."),
    "chart": (("scene",), (),
              "Judge integrators and steps on a scene, and name the cheapest within a tolerance.\n\n"
              "scene: as the garment of simulate. Without a mesh in its result."),
    "fit": (("worn",), (),
            "Tell how a worn garment fits: where it is tight, where it is loose, how much room there is.\n\n"
            "worn: a mesh or its file, or a list of them. The result's meshes have the columns fit_distance [m]\n"
            "and strain [-], and colours."),
    "transfer": (("original", "wrinkled"), (),
                 "Bring the shape of a wrinkled mesh back to the mesh it was made of."),
    "follow": (("garment",), (), "Give a garment the shape keys of its body, so that it goes along."),
    "bake": (("low", "high"), (),
             "Bake a wrinkled mesh into textures of the mesh it was made of: OUTPUT_normal.png and others."),
    "subdivide": (("mesh",), (), "Refine a mesh along strokes or everywhere; strokes leave its shape as it is."),
    "smooth": (("mesh",), (), "Smooth a whole mesh without shrinking it (Taubin)."),
    "body": (("mesh",), (), "Give a standing body a person's measurements, or tell those that it has."),
    "doctor": (("mesh",), (), "Say what is wrong with a mesh, where, and what mends it; with repair, mend it."),
    "quality": (("mesh",), (), "Measure how well a cloth is folded; each measure stands beside its target."),
}


def _function(job):
    inputs, optional, words = _JOBS[job]
    kinds = _inspect.Parameter
    positional = [kinds(name, kinds.POSITIONAL_OR_KEYWORD, default=None if name in optional else kinds.empty)
                  for name in inputs]
    if job == "wrinkle":  # what may be left out stands before what may not
        positional[1] = positional[1].replace(default=None)
    first = _inspect.Signature(positional)
    keywords = _furrow.keywords(job)

    def function(*args, **given):
        bound = first.bind(*args, **{name: given.pop(name) for name in inputs if name in given})
        bound.apply_defaults()
        values = list(bound.arguments.values())
        if job in ("drape", "fit"):
            values = _listed(values[0])
        if not values:
            raise ValueError(f"{inputs[0]}: an empty list; name one at least")
        return _run(job, values, given)

    function.__name__ = function.__qualname__ = job
    function.__signature__ = first.replace(
        parameters=positional + [kinds(name, kinds.KEYWORD_ONLY, default=None) for name, _, _ in keywords],
        return_annotation=Result)
    function.__doc__ = words + "\n\n" + "\n".join(f"{name}: {text}" for name, _, text in keywords)
    return function


globals().update({job: _function(job) for job in _JOBS})


def read_mesh(path, *, unit=None, up=None):
    """The mesh of a file, of any format of `furrow info --help`. unit: m, cm, mm, inch; up: y, z (as noted, or m, y)."""
    return _furrow.read_mesh(path, {"unit": unit, "up": up}, _warner(level=3))


def _write(self, path, *, unit=None, up=None):
    """Writes the mesh by the ending of the path: one that `furrow smooth --help` lists; whole or not at all."""
    _furrow.write_mesh(self, path, {"unit": unit, "up": up}, _warner(level=3))


def info(mesh, *, unit=None, up=None):
    """What a mesh, or that of a file, is: counts, topology, lengths [m], areas, faults, borders, lines."""
    if isinstance(mesh, Mesh):
        return _furrow.info(mesh)
    return _furrow.info(_furrow.read_mesh(mesh, {"unit": unit, "up": up}, _warner(level=3)))


def from_meshio(mesh, name=""):
    """A mesh of meshio: its triangles, quads and polygons, and what it has at each point as a number."""
    if not (hasattr(mesh, "cells") and hasattr(mesh, "points")):
        raise TypeError(f"mesh: must be a mesh of meshio, not {mesh!r:.60}")
    faces = [face for block in mesh.cells if block.type in ("triangle", "quad", "polygon")
             for face in block.data.tolist()]
    made = Mesh(mesh.points, faces, name=name)
    for key, values in mesh.point_data.items():
        if values.ndim == 1 and len(values) == len(made.V):
            made.vertex[key] = values
    return made


def to_meshio(mesh):
    """The mesh for meshio, with its vertex and face columns; positions are those of mesh.V, not a copy."""
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh: must be a furrow.Mesh, not {mesh!r:.60}")
    import meshio
    return meshio.Mesh(mesh.V, [("triangle", mesh.F)], point_data={n: mesh.vertex[n] for n in mesh.vertex},
                       cell_data={n: [mesh.face[n]] for n in mesh.face})


Mesh.write = _write
Mesh.__doc__ = """A mesh of triangles: positions V (n x 3 [m]), faces F (m x 3), edges E (k x 2), and columns by name.

V lies in the mesh: writing to it moves vertices. vertex, face, edge, corner are columns as in docs/rest-state.md;
those of numbers lie in the mesh, too, others are copies that cannot be written to; mesh.vertex["mass"] = … sets one.
Mesh(V, F) copies once, cuts polygons, and mends what is no oriented manifold; `repairs` says what.
"""
