# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as arrays: what crosses the boundary, and how."""
import os
import pickle
import tempfile
import unittest
import warnings

import numpy as np

import furrow
from paths import MESHES

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


class MeshArrays(unittest.TestCase):
    def test_positions_are_those_of_the_mesh_by_address(self):
        mesh = furrow.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
        view = mesh.V
        self.assertEqual(view.__array_interface__["data"][0], mesh._address)
        self.assertIs(view.base, mesh)
        view[2] = [2, 2, 0.5]
        np.testing.assert_array_equal(mesh.V[2], [2, 2, 0.5])
        self.assertEqual((mesh.V.dtype, mesh.F.dtype), (np.float64, np.int32))

    def test_a_view_keeps_its_mesh_alive(self):
        view = furrow.read_mesh(MESHES / "sheet.obj").V
        again = furrow.read_mesh(MESHES / "sheet.obj").V
        np.testing.assert_array_equal(view, again)

    def test_what_jobs_return_is_not_copied_and_what_they_take_is(self):
        mesh = furrow.read_mesh(MESHES / "sheet.obj")
        before = mesh.V.copy()
        result = furrow.smooth(mesh, iterations=3)
        self.assertEqual(result.mesh.V.__array_interface__["data"][0], result.mesh._address)
        np.testing.assert_array_equal(mesh.V, before)
        self.assertGreater(np.abs(result.mesh.V - before).max(), 0)

    def test_faces_keep_their_corners_and_their_order(self):
        faces = [[0, 1, 2], [2, 3, 0]]
        mesh = furrow.Mesh(SQUARE, faces)
        for given, kept in zip(faces, mesh.F.tolist()):
            self.assertIn(kept, [given[i:] + given[:i] for i in range(3)])
        with self.assertRaises(ValueError):
            mesh.F[0, 0] = 1
        self.assertEqual(sorted(map(sorted, mesh.E.tolist())), [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]])

    def test_quads_and_polygons_are_cut(self):
        quad = furrow.Mesh(SQUARE, np.array([[0, 1, 2, 3]]))
        self.assertEqual(len(quad.F), 2)
        self.assertEqual(quad.repairs["triangulated_faces"], 1)
        self.assertEqual(quad.edge["diagonal"].sum(), 1)
        mixed = furrow.Mesh(SQUARE + [[2, 0.5, 0]], [[0, 1, 2, 3], [1, 4, 2]])
        self.assertEqual(len(mixed.F), 3)

    def test_what_is_no_manifold_is_mended_with_a_warning(self):
        with self.assertWarns(furrow.FurrowWarning) as told:
            mesh = furrow.Mesh(SQUARE, [[0, 1, 2], [0, 3, 2], [0, 0, 1]])
        self.assertEqual(told.warning.code, "repaired")
        self.assertEqual((mesh.repairs["reversed_faces"], mesh.repairs["degenerate_faces"]), (1, 1))

    def test_arrays_that_cannot_be_are_refused(self):
        for V, F in [([[0, 0]], [[0, 0, 0]]), ([[0, 0, np.nan]] * 3, [[0, 1, 2]]), (SQUARE, [[0, 1, -1]]),
                     (SQUARE, [[0.0, 1.0, 2.0]]), (SQUARE, [0, 1, 2])]:
            with self.assertRaises((ValueError, TypeError)):
                furrow.Mesh(V, F)
        with self.assertRaises(furrow.ContentError):
            furrow.Mesh(SQUARE, [[0, 1, 9]])
        mesh = furrow.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
        for V in (np.zeros((3, 3)), np.full((4, 3), np.inf)):
            with self.assertRaises(ValueError):
                mesh.V = V
        np.testing.assert_array_equal(mesh.V, SQUARE)


class Columns(unittest.TestCase):
    def setUp(self):
        self.mesh = furrow.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])

    def test_numbers_lie_in_the_mesh_and_truths_are_copies(self):
        self.mesh.vertex["mass"] = [1, 2, 3, 4]
        view = self.mesh.vertex["mass"]
        view[1] = 5
        self.assertEqual(self.mesh.vertex["mass"][1], 5)
        self.mesh.edge["line_edge"] = np.arange(5) % 2 == 0
        with self.assertRaises(ValueError):
            self.mesh.edge["line_edge"][0] = False
        np.testing.assert_array_equal(self.mesh.edge["line_edge"], [True, False, True, False, True])

    def test_every_kind_of_element_has_columns_of_its_shape(self):
        texture = np.random.default_rng(1).random((2, 3, 2))
        self.mesh.corner["texture"] = texture
        self.mesh.face["group"] = [0, 1]
        self.mesh.face["warp"] = [[0, 1, 0]] * 2
        self.mesh.edge["rest_length"] = np.full(5, 1.5)
        self.mesh.vertex["weight_arm"] = [0, 0.5, 0.5, 1]
        np.testing.assert_array_equal(self.mesh.corner["texture"], texture)
        self.assertEqual(self.mesh.face["group"].dtype, np.int32)
        self.assertEqual(self.mesh.face["warp"].shape, (2, 3))
        self.assertEqual(list(self.mesh.vertex), ["weight_arm"])
        self.assertIn("rest_length", self.mesh.edge)
        self.assertNotIn("tension", self.mesh.edge)

    def test_numbers_that_cannot_be_are_refused_before_anything_changes(self):
        for columns, name, values in [(self.mesh.vertex, "mass", [1, 1, 1, -1]),
                                      (self.mesh.edge, "rest_length", [1, 1, 1, 1, 0]),
                                      (self.mesh.edge, "rest_angle", [0, 0, 0, 0, 4]),
                                      (self.mesh.face, "group", [0, 0.5]), (self.mesh.vertex, "mass", [1, 2])]:
            with self.assertRaises(ValueError):
                columns[name] = values
            self.assertNotIn(name, columns)
        with self.assertRaises(KeyError):
            self.mesh.edge["no_such"]
        with self.assertRaises(KeyError):
            self.mesh.edge["no_such"] = np.zeros(5)


class Files(unittest.TestCase):
    def test_every_format_gives_back_what_it_was_given(self):
        mesh = furrow.read_mesh(MESHES / "skirt.obj")
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("obj", "ply", "off"):
                path = os.path.join(folder, "skirt." + ending)
                mesh.write(path)
                again = furrow.read_mesh(path)
                np.testing.assert_array_equal(again.V, mesh.V)
                np.testing.assert_array_equal(again.F, mesh.F)
            path = os.path.join(folder, "skirt.stl")
            mesh.write(path)
            self.assertEqual(len(furrow.read_mesh(path).F), len(mesh.F))
            mesh.write(os.path.join(folder, "cm.obj"), unit="cm", up="z")
            back = furrow.read_mesh(os.path.join(folder, "cm.obj"), unit="cm", up="z")
            np.testing.assert_allclose(back.V, mesh.V, atol=1e-15)

    def test_a_file_that_cannot_be_read_says_where(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "broken.obj")
            with open(path, "w") as file:
                file.write("v 0 0 0\nv 1 0\n")
            with self.assertRaisesRegex(furrow.ContentError, "broken.obj:2"):
                furrow.read_mesh(path)
        with self.assertRaises(ValueError):
            furrow.read_mesh(MESHES / "sheet.obj", unit="ell")

    def test_columns_go_through_a_ply(self):
        mesh = furrow.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
        mesh.vertex["mass"] = [1, 2, 3, 4]
        mesh.edge["rest_length"] = [1, 2, 3, 4, 5]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "square.ply")
            mesh.write(path)
            again = furrow.read_mesh(path)
        np.testing.assert_array_equal(again.vertex["mass"], [1, 2, 3, 4])
        lengths = {tuple(sorted(e)): l for e, l in zip(mesh.E.tolist(), mesh.edge["rest_length"])}
        back = {tuple(sorted(e)): l for e, l in zip(again.E.tolist(), again.edge["rest_length"])}
        self.assertEqual(back, lengths)

    def test_a_mesh_goes_to_another_process(self):
        mesh = furrow.read_mesh(MESHES / "panelled.obj")
        mesh.vertex["weight_arm"] = np.linspace(0, 1, len(mesh.V))
        again = pickle.loads(pickle.dumps(mesh))
        np.testing.assert_array_equal(again.V, mesh.V)
        np.testing.assert_array_equal(again.F, mesh.F)
        np.testing.assert_array_equal(again.vertex["weight_arm"], mesh.vertex["weight_arm"])
        np.testing.assert_array_equal(again.corner["texture"], mesh.corner["texture"])
        self.assertEqual((again.name, again.group_names), ("panelled", mesh.group_names))

    def test_meshio_takes_and_gives_meshes(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is not installed")
        mesh = furrow.read_mesh(MESHES / "sheet.obj")
        mesh.vertex["weight_arm"] = np.linspace(0, 1, len(mesh.V))
        theirs = furrow.to_meshio(mesh)
        self.assertEqual(theirs.points.__array_interface__["data"][0], mesh._address)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sheet.vtu")
            theirs.write(path)
            back = furrow.from_meshio(meshio.read(path))
        np.testing.assert_array_equal(back.V, mesh.V)
        np.testing.assert_array_equal(back.F, mesh.F)
        np.testing.assert_array_equal(back.vertex["weight_arm"], mesh.vertex["weight_arm"])

    def test_trimesh_takes_and_gives_meshes(self):
        try:
            import trimesh
        except ImportError:
            self.skipTest("trimesh is not installed")
        mesh = furrow.read_mesh(MESHES / "sheet.obj")
        theirs = trimesh.Trimesh(mesh.V, mesh.F, process=False)
        back = furrow.Mesh(theirs.vertices, theirs.faces)
        np.testing.assert_array_equal(back.V, mesh.V)
        np.testing.assert_array_equal(back.F, mesh.F)


if __name__ == "__main__":
    warnings.simplefilter("always")
    unittest.main()
