# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad arguments for all that the package has. The table is made of what the module tells of itself, so that a new
function, keyword or property is tried without anybody adding it here."""
import functools
import inspect
import math
import os
import re
import tempfile
import time
import unittest
import warnings

import numpy as np

import furrow
from furrow import _furrow
from paths import MESHES

RIDGE = [{"name": "ridge", "height": 0.01, "points": [[-0.1, 0, 0], [0.1, 0, 0]]}]
REFUSALS = (ValueError, TypeError, KeyError, furrow.ContentError, OSError)  # TooMuchWork is a ValueError
JUNK = [object(), 1j, b"bytes", {1: 2}, [[[]]], float("nan")]  # no keyword and no input is any of these
NUMBERS = [math.inf, -1.0, 0.0, 1e300, 5e-324]
WHOLES = [-1, 0, 2**31 - 1, 2**63, 10**400]
LONGEST = 0.05  # [s] that a call may go on which is not refused


def sheet(n=4):
    """A square of 0.4 m in the plane of x and z, with texture coordinates."""
    x, z = np.meshgrid(np.linspace(-0.2, 0.2, n), np.linspace(-0.2, 0.2, n))
    V = np.column_stack([x.ravel(), np.zeros(n * n), z.ravel()])
    mesh = furrow.Mesh(V, [[i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1]
                           for i in range(n - 1) for j in range(n - 1)], name="sheet")
    mesh.edge["rest_length"] = np.linalg.norm(np.diff(mesh.V[mesh.E], axis=1)[:, 0], axis=1)
    mesh.vertex["mass"] = np.full(n * n, 0.001)
    mesh.corner["texture"] = mesh.V[mesh.F][:, :, [0, 2]] / 0.4 + 0.5
    mesh.face["group"] = np.zeros(len(mesh.F), int)
    mesh.group_names = ["front"]
    return mesh


def written(column, value):
    """A mesh that was right when it was made, and was written to by a view."""
    def make():
        mesh = sheet()
        kind, name = column
        if kind == "V":
            mesh.V[5, 1] = value
        else:
            getattr(mesh, kind)[name][0] = value
        return mesh
    return make


def collapsed():
    mesh = sheet()
    mesh.V[:] = 0
    return mesh


REFUSED_MESHES = {"V not a number": written(("V", ""), math.nan), "V infinite": written(("V", ""), math.inf)}
ODD_MESHES = {"all at one place": collapsed, "V 1e300": written(("V", ""), 1e300),
              "rest length < 0": written(("edge", "rest_length"), -1.0),
              "rest length none": written(("edge", "rest_length"), math.nan),
              "mass < 0": written(("vertex", "mass"), -1.0), "mass none": written(("vertex", "mass"), math.nan),
              "group beyond": written(("face", "group"), 2**31 - 1), "group before": written(("face", "group"), -9)}


@functools.cache
def wrinkled():
    return furrow.wrinkle(sheet(), RIDGE).mesh


def ball():
    corners = [[x, y, z] for x in (-0.05, 0.05) for y in (-0.05, 0.05) for z in (-0.05, 0.05)]
    return furrow.Mesh(corners, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


# What a job needs beside its inputs, or in place of a sheet.
NEEDS = {"drape": {"pin_vertices": [0, 1, 2, 3]}, "fit": {"body": ball}, "subdivide": {"all": True},
         "keep": {"garment": wrinkled, "pin_vertices": [0, 1, 2, 3], "gust": 0.0}, "transfer": {"wrinkled": wrinkled},
         "follow": {"body": sheet, "body_keys": lambda: [sheet()], "mixes": 3},
         "bake": {"output": "maps"}, "body": {"mesh": lambda: furrow.read_mesh(MESHES / "mannequin.obj")}}


def inputs_of(job):
    """A right call: strokes for what is called so, a sheet for all other inputs, and what the job needs."""
    given = {name: RIDGE if name == "strokes" else sheet() for name in furrow._JOBS[job][0]}
    return given | {name: value() if callable(value) else value for name, value in NEEDS.get(job, {}).items()}


def keywords_of(job):
    return [(name, kind) for name, kind, _ in _furrow.keywords(job)]


def numbers_in(value):
    if isinstance(value, dict):
        for item in value.values():
            yield from numbers_in(item)
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from numbers_in(item)
    elif isinstance(value, float):
        yield value


class Doors(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")
        self.addCleanup(warnings.resetwarnings)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def refused(self, function, *args, of=None, **given):
        """Whether it was, by a message that names `of`; what is not must end without a number that is none."""
        end = time.monotonic() + LONGEST
        if hasattr(function, "__signature__") and "cancel" in function.__signature__.parameters:
            given.setdefault("cancel", lambda: time.monotonic() > end)
        try:
            result = function(*args, **given)
        except REFUSALS as refusal:
            self.assertIn(of.split("_")[0] if of else "", str(refusal))
            self.assertTrue(str(refusal))
            return True
        except furrow.Cancelled:
            return False
        if isinstance(result, furrow.Result):
            self.assertFalse(any(map(math.isnan, numbers_in(result.report))), result.report)
            for mesh in result.meshes:
                self.assertTrue(np.isfinite(mesh.V).all())
        return False

    def test_every_job_takes_what_is_right(self):
        for job in furrow._JOBS:
            with self.subTest(job=job):
                self.assertFalse(self.refused(getattr(furrow, job), **inputs_of(job)))

    def test_every_keyword_refuses_what_is_none_of_its_values(self):
        for job in furrow._JOBS:
            for name, kind in keywords_of(job):
                for value in JUNK + ([5] if "Path" in kind or kind in ("str", "bool") else []):
                    with self.subTest(job=job, keyword=name, kind=kind, value=repr(value)):
                        call = inputs_of(job) | {name: value}
                        self.assertTrue(self.refused(getattr(furrow, job), of=name, **call))

    def test_every_number_is_taken_whole_or_refused(self):
        for job in furrow._JOBS:
            for name, kind in keywords_of(job):
                values = NUMBERS if "float" in kind else WHOLES if "int" in kind else []
                for value in values:
                    with self.subTest(job=job, keyword=name, value=value):
                        self.refused(getattr(furrow, job), **(inputs_of(job) | {name: value}))

    def test_every_input_refuses_what_is_no_mesh(self):
        for job in furrow._JOBS:
            for name in furrow._JOBS[job][0]:
                for value in JUNK + [5, "", "no such file.obj", "no such ending"]:
                    with self.subTest(job=job, input=name, value=repr(value)):
                        self.assertTrue(self.refused(getattr(furrow, job), **(inputs_of(job) | {name: value})))

    def test_every_input_refuses_a_broken_mesh(self):
        for job in furrow._JOBS:
            names = [n for n in furrow._JOBS[job][0] if n != "strokes"]
            names += [n for n, kind in keywords_of(job) if kind.startswith("Mesh")]
            for name in names:
                for what, make in (REFUSED_MESHES | ODD_MESHES).items():
                    with self.subTest(job=job, input=name, mesh=what):
                        refused = self.refused(getattr(furrow, job), **(inputs_of(job) | {name: make()}))
                        if what in REFUSED_MESHES:
                            self.assertTrue(refused)

    def test_every_other_function_refuses_what_it_cannot_take(self):
        for name in dir(furrow):
            function = getattr(furrow, name)
            if name.startswith("_") or name in furrow._JOBS or not inspect.isfunction(function):
                continue
            parameters = list(inspect.signature(function).parameters.values())
            for value in JUNK + [5, None, "", "no such file.obj"]:
                with self.subTest(function=name, value=repr(value)):
                    self.assertTrue(self.refused(function, value))
            for parameter in parameters:
                if parameter.kind is parameter.KEYWORD_ONLY:
                    with self.subTest(function=name, keyword=parameter.name):
                        mesh = f"{self.folder}/sheet.ply"
                        sheet().write(mesh)
                        self.assertTrue(self.refused(function, mesh, **{parameter.name: "ell"}))

    def test_every_property_and_method_of_a_mesh_refuses_junk(self):
        for name, member in inspect.getmembers(furrow.Mesh):
            if isinstance(member, property) and not name.startswith("_"):
                for value in [5, None, [[1, 2]]] + [v for v in JUNK if v != b"bytes"]:  # a name may be bytes
                    with self.subTest(property=name, value=repr(value)):
                        with self.assertRaises(REFUSALS + (AttributeError,)):
                            setattr(sheet(), name, value)
        for kind in ("vertex", "face", "edge", "corner"):
            columns = getattr(sheet(), kind)
            for name in list(columns) + ["of_my_own", ""]:
                for value in [object(), 1j, {1: 2}, [[[]]], None, [1], "text", np.full((7, 7), 1.0)]:
                    with self.subTest(columns=kind, column=name, value=repr(value)):
                        self.assertRaises(REFUSALS, columns.__setitem__, name, value)
            for value in JUNK + [5, None, ""]:
                self.assertRaises(REFUSALS, columns.__getitem__, value)

    def test_a_mesh_is_not_made_of_junk(self):
        for V in JUNK + [5, None, np.zeros((0, 3)), np.zeros((3, 2))]:
            for F in JUNK + [5, None, [[0, 1, 2]], [[0, 1, 2**63]], [[0, 1]], np.zeros((0, 3), int)]:
                with self.subTest(V=repr(V), F=repr(F)):
                    self.assertTrue(self.refused(furrow.Mesh, V, F))

    def test_every_writer_refuses_a_broken_mesh(self):
        for ending in ("obj", "ply", "off", "stl", "glb"):
            for what, make in (REFUSED_MESHES | ODD_MESHES).items():
                with self.subTest(ending=ending, mesh=what):
                    refused = self.refused(make().write, f"{self.folder}/a.{ending}")
                    if what in REFUSED_MESHES:
                        self.assertTrue(refused)
        for what, make in REFUSED_MESHES.items():
            self.assertTrue(self.refused(furrow.info, make()), what)

    def test_no_public_name_is_left_out(self):
        text = {name for name in dir(furrow) if not name.startswith("_")}
        tried = set(furrow._JOBS) | {n for n in text if inspect.isfunction(getattr(furrow, n))} | {"Mesh", "Columns"}
        made = {n for n in text if inspect.isclass(getattr(furrow, n)) and
                issubclass(getattr(furrow, n), (Exception, furrow.Result))}
        self.assertEqual(text - tried - made, set())


if __name__ == "__main__":
    unittest.main()
