# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs from Python: what they take and give, how they warn, fail and end."""
import inspect
import json
import os
import re
import signal
import subprocess
import tempfile
import threading
import unittest
import warnings

import numpy as np

import furrow
from paths import MESHES, PROGRAM

RIDGE = [{"name": "ridge", "height": 0.02, "points": [[-0.3, 0, 0], [0.3, 0, 0]]}]
# What the command line has for files of its own, for people and for pictures.
OF_PROGRAM = {"help", "help_all",
              "json", "verbose", "quiet", "set", "picture", "no_legend", "compare", "captions", "view", "eye",
              "target", "camera", "camera_up", "size", "quality", "save_camera", "fov", "wire", "thickness",
              "orthographic", "oversample", "progress"}
# What Python has for callables and dicts.
OF_PYTHON = {"settings", "progress", "cancel", "watch"}


def strip(rows=12, columns=12):
    """A square metre of cloth in the plane of x and z."""
    x, z = np.meshgrid(np.linspace(-0.5, 0.5, columns), np.linspace(-0.5, 0.5, rows))
    V = np.column_stack([x.ravel(), np.zeros(rows * columns), z.ravel()])
    F = [[i * columns + j, (i + 1) * columns + j, (i + 1) * columns + j + 1, i * columns + j + 1]
         for i in range(rows - 1) for j in range(columns - 1)]
    return furrow.Mesh(V, F, name="strip")


def program(*arguments):
    """What the command line reports as --json."""
    done = subprocess.run([PROGRAM, *map(str, arguments), "--json"], capture_output=True, text=True)
    return json.loads(done.stdout)


def silent(call, *arguments, **keywords):
    """What the call returns; its warnings are another test's."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", furrow.FurrowWarning)
        return call(*arguments, **keywords)


def key_tree(report):
    """The keys of a report, without those of lists."""
    return {key: key_tree(value) for key, value in report.items()} if isinstance(report, dict) else None


class Simulate(unittest.TestCase):
    def test_a_cloth_in_memory_falls_as_gravity_says(self):
        result = silent(furrow.simulate, strip(), seconds=0.2, integrator="leapfrog", dt=5e-4, drag=0)
        self.assertTrue(result.succeeded)
        self.assertAlmostEqual(result.mesh.V[:, 1].mean(), -9.81 * 0.2**2 / 2, places=3)
        self.assertEqual(result.mesh.name, "strip")

    def test_a_scene_is_a_dict_a_file_or_keywords(self):
        with tempfile.TemporaryDirectory() as folder:
            strip().write(os.path.join(folder, "strip.ply"))
            with open(os.path.join(folder, "scene.toml"), "w") as file:
                file.write('[garment]\nmesh = "strip.ply"\n[[pins]]\nvertices = [0, 11]\n'
                           '[simulation]\nseconds = 0.1\n[forces]\ngravity = 5\n')
            of_file = furrow.simulate(os.path.join(folder, "scene.toml"))
        of_keywords = furrow.simulate(strip(), seconds=0.1, gravity=5, pin_vertices=[0, 11])
        of_dict = furrow.simulate({"garment": {"mesh": strip()}, "pins": [{"vertices": [0, 11]}],
                                   "simulation": {"seconds": 0.1}, "forces": {"gravity": 5}})
        of_settings = furrow.simulate(strip(), settings={"simulation.seconds": 0.1, "forces": {"gravity": 5},
                                                         "pins": [{"vertices": [0, 11]}]})
        for other in (of_keywords, of_dict, of_settings):
            np.testing.assert_array_equal(other.mesh.V, of_file.mesh.V)

    def test_pins_come_one_by_one_or_as_lists(self):
        still = furrow.simulate(strip(), seconds=0.1, pin_box=[[-1, -1, -1, -0.4, 1, 1], [0.4, -1, -1, 1, 1, 1]])
        held = np.abs(strip().V[:, 0]) > 0.4
        np.testing.assert_array_equal(still.mesh.V[held], strip().V[held])
        self.assertLess(still.mesh.V[~held, 1].max(), 0)

    def test_the_watch_sees_the_cloth_and_may_keep_what_it_saw(self):
        seen = []
        result = furrow.simulate(strip(), seconds=0.1, integrator="implicit", pin_vertices=[0, 11],
                                 watch=lambda time, V: seen.append((time, V)))
        self.assertGreater(len(seen), 2)
        self.assertEqual(seen[0][1].shape, strip().V.shape)
        np.testing.assert_allclose(seen[-1][1], result.mesh.V, atol=1e-12)

    def test_a_state_is_gone_on_from(self):
        whole = furrow.simulate(strip(), seconds=0.2, pin_vertices=[0, 11], dt=5e-4)
        with tempfile.TemporaryDirectory() as folder:
            state = os.path.join(folder, "state.ply")
            strip().write(os.path.join(folder, "strip.ply"))
            furrow.simulate(os.path.join(folder, "strip.ply"), seconds=0.2, pin_vertices=[0, 11], dt=5e-4,
                            stop_at=0.1, save_state=state)
            rest = furrow.simulate(state=state)
        np.testing.assert_array_equal(rest.mesh.V, whole.mesh.V)

    def test_a_run_that_diverges_is_no_success(self):
        with self.assertWarns(furrow.FailureWarning):
            result = furrow.simulate(strip(), seconds=1, integrator="leapfrog", dt=0.05, force_dt=True,
                                     pin_vertices=[0, 11])
        self.assertFalse(result.succeeded)
        self.assertIsNone(result.mesh)
        self.assertEqual(result.failures[0].code, "diverged")


class Drape(unittest.TestCase):
    def test_a_cloth_hangs_from_its_pins(self):
        result = furrow.drape(strip(), pin_vertices=[0, 11], fabric="cotton", subdivide=0)
        self.assertTrue(result.succeeded, result.failures)
        self.assertEqual(result.report["outcome"], "at rest")
        self.assertLess(result.mesh.V[:, 1].min(), -0.5)

    def test_the_command_line_comes_to_the_same_bits(self):
        if not PROGRAM:
            self.skipTest("the command line is not built")
        with tempfile.TemporaryDirectory() as folder:
            source, target = os.path.join(folder, "strip.ply"), os.path.join(folder, "hung.ply")
            strip().write(source)
            theirs = program("drape", source, "--pin-vertices", "0,11", "--subdivide", "0", "-o", target)
            ours = furrow.drape(source, pin_vertices=[0, 11], subdivide=0, output=target, replace=True)
            np.testing.assert_array_equal(furrow.read_mesh(target).V, ours.mesh.V)
        self.assertEqual(key_tree(ours.report), key_tree(theirs))

    def test_a_body_in_memory_serves_as_one_of_a_file(self):
        sheet = strip()
        V = sheet.V
        V[:, 1] += 0.3
        box = furrow.Mesh([[x, y, z] for x in (-0.2, 0.2) for y in (-0.4, 0.2) for z in (-0.2, 0.2)],
                          [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
                          name="box")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ours = furrow.drape(sheet, body=box, subdivide=0)
            with tempfile.TemporaryDirectory() as folder:
                sheet.write(os.path.join(folder, "strip.ply"))
                box.write(os.path.join(folder, "box.ply"))
                theirs = furrow.drape(os.path.join(folder, "strip.ply"), body=os.path.join(folder, "box.ply"),
                                      subdivide=0)
        np.testing.assert_array_equal(ours.mesh.V, theirs.mesh.V)
        self.assertGreater(ours.mesh.V[:, 1].max(), 0.2)


class Others(unittest.TestCase):
    def test_lines_are_drawn_measured_and_brought_back(self):
        sheet = furrow.read_mesh(MESHES / "sheet.obj")
        drawn = furrow.wrinkle(sheet, RIDGE)
        self.assertTrue(drawn.succeeded)
        self.assertGreater(len(drawn.mesh.V), len(sheet.V))
        self.assertIn("line", drawn.mesh.vertex)
        back = furrow.transfer(sheet, drawn.mesh)
        self.assertEqual(len(back.mesh.V), len(sheet.V))
        self.assertGreater(np.abs(back.mesh.V - sheet.V).max(), 0.005)
        self.assertIn("measures", furrow.quality(drawn.mesh).report)
        less = furrow.wrinkle(sheet, RIDGE, rule="safe", height=0.01, iterations=2)
        self.assertNotEqual(len(less.mesh.V), len(drawn.mesh.V))

    def test_a_mesh_is_refined_smoothed_and_examined(self):
        sheet = strip(4, 4)
        self.assertEqual(len(furrow.subdivide(sheet, linear=1).mesh.F), 4 * len(sheet.F))
        self.assertEqual(furrow.info(sheet)["vertices"], 16)
        self.assertTrue(furrow.doctor(sheet).succeeded)
        torn = furrow.Mesh(np.vstack([sheet.V, sheet.V]), np.vstack([sheet.F, sheet.F + 16]))
        self.assertFalse(furrow.doctor(torn).succeeded)

    def test_a_body_gets_measurements(self):
        mannequin = furrow.read_mesh(MESHES / "mannequin.obj")
        anna = furrow.body(mannequin, height=1.68, waist=0.74)
        self.assertTrue(anna.succeeded)
        told = furrow.body(anna.mesh).report["reached"]
        self.assertAlmostEqual(told["height"], 1.68, delta=1e-3)
        self.assertAlmostEqual(told["waist"], 0.74, delta=1e-3)
        self.assertFalse(furrow.body(mannequin, waist=0.92).succeeded)

    def test_a_worn_garment_is_measured(self):
        body = furrow.read_mesh(MESHES / "mannequin.obj")
        skirt = furrow.read_mesh(MESHES / "skirt.obj")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = furrow.fit(skirt, body=body, rest_shape=skirt, section={"hip": 0.9})
        self.assertEqual(result.mesh.vertex["fit_distance"].shape, (len(skirt.V),))
        self.assertEqual(np.abs(result.mesh.vertex["strain"]).max(), 0)

    def test_a_scene_is_judged(self):
        result = furrow.chart(strip(5, 5), accuracy="5%", budget=2,
                              settings={"simulation.seconds": 0.05, "pins": [{"vertices": [0, 4]}]})
        self.assertIn("candidates", result.report)
        self.assertIsNone(result.mesh)


class Errors(unittest.TestCase):
    def test_bad_options_are_value_errors_with_our_words(self):
        for call, words in [(lambda: furrow.simulate(strip(), friction=-1), "friction"),
                            (lambda: furrow.simulate(strip(), integrator="verlet"), "integrator"),
                            (lambda: furrow.simulate(strip(), seconds="long"), "seconds"),
                            (lambda: furrow.simulate({"material": {"frictoin": 1}, "garment": {"mesh": strip()}}),
                             "frictoin"),
                            (lambda: furrow.drape(strip(), pin_vertices=0, residual=0), "residual"),
                            (lambda: furrow.drape(strip()), "pin_loop"),
                            (lambda: furrow.drape(strip(), pin_vertices=0, cloth_thickness=0.1),
                             r"cloth_thickness takes a number in \[1e-05, 0.05\], not 0.1"),
                            (lambda: furrow.drape(strip(), pin_vertices=0, band={"top": 3}), "band: the length"),
                            (lambda: furrow.drape(strip(), pin_vertices=0, self_contact="maybe"), "self_contact"),
                            (lambda: furrow.smooth(strip(), iterations=-1), "iterations"),
                            (lambda: furrow.bake(strip(), strip()), "output"),
                            (lambda: furrow.fit(strip()), "body"),
                            (lambda: furrow.wrinkle(strip(), RIDGE, fold_iterations=1, rule="safe"), "rule"),
                            (lambda: furrow.keep(strip(), kept=2), "kept"),
                            (lambda: furrow.subdivide(strip()), "one of")]:
            with self.assertRaisesRegex(ValueError, words):
                call()

    def test_unknown_keywords_are_type_errors_that_know_the_nearest(self):
        with self.assertRaisesRegex(TypeError, "did you mean 'friction'"):
            furrow.simulate(strip(), fricton=0.3)
        with self.assertRaises(TypeError):
            furrow.drape()

    def test_content_that_cannot_be_used_is_a_content_error(self):
        with tempfile.TemporaryDirectory() as folder:
            missing = os.path.join(folder, "missing.obj")
            with self.assertRaisesRegex(furrow.ContentError, "missing.obj"):
                furrow.drape(strip(), body=missing)
            scene = os.path.join(folder, "scene.toml")
            with open(scene, "w") as file:
                file.write("[garment]\nmesh = 1\n")
            with self.assertRaisesRegex(furrow.ContentError, "scene.toml:2"):
                furrow.simulate(scene)
        with self.assertRaises(furrow.ContentError):
            furrow.wrinkle(strip(), [{"points": [[9, 9, 9], [9, 9, 8]]}])

    def test_messages_name_keywords(self):
        with self.assertRaisesRegex(ValueError, "name a body with body, or what is held with pin_loop, pin_group"):
            furrow.drape(strip())
        with self.assertRaisesRegex(ValueError, 'self_contact="off": several garments need it'):
            furrow.drape([strip(), strip()], body=strip(), self_contact="off")
        with self.assertWarnsRegex(furrow.FurrowWarning, "furrow.simulate has"):
            furrow.drape(strip(), pin_vertices=[0, 11], subdivide=0, settings={"simulation.seconds": 3})

    def test_warnings_have_a_code_and_name_the_line_that_called(self):
        with self.assertWarns(furrow.FurrowWarning) as told:
            furrow.drape(strip(), pin_vertices=[0, 11], subdivide=0, settings={"simulation.seconds": 3})
        self.assertEqual(told.warning.code, "settings_unused")
        self.assertEqual(os.path.basename(told.filename), "jobs_test.py")
        with warnings.catch_warnings():
            warnings.simplefilter("error", furrow.FurrowWarning)
            with self.assertRaises(furrow.FurrowWarning):
                furrow.drape(strip(), pin_vertices=[0, 11], subdivide=0, settings={"simulation.seconds": 3})


class Ends(unittest.TestCase):
    LONG = dict(seconds=1000, integrator="leapfrog", dt=1e-4, pin_vertices=[0, 11], force=True)

    def test_progress_is_told_and_cancel_is_asked(self):
        told = []
        result = silent(furrow.simulate, strip(), progress=lambda what, share: told.append((what, share)),
                        cancel=lambda: len(told) > 2, **self.LONG)
        self.assertFalse(result.succeeded)
        self.assertEqual(result.report["outcome"], "interrupted")
        self.assertGreater(result.report["time"] if "time" in result.report else 1, 0)
        self.assertTrue(all(0 <= share <= 1 for _, share in told))
        with self.assertRaises(furrow.Cancelled):
            furrow.simulate(strip(), cancel=lambda: True, **self.LONG)

    def test_an_exception_of_a_callable_comes_out(self):
        def fail(what, share):
            raise KeyError("mine")
        with self.assertRaisesRegex(KeyError, "mine"):
            furrow.simulate(strip(), progress=fail, **self.LONG)

    def test_ctrl_c_ends_a_job(self):
        # What a shell starts in the background ignores Ctrl-C.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            furrow.simulate(strip(), **self.LONG)

    def test_others_run_while_a_job_does(self):
        turns = []
        stop = threading.Event()

        def turn():
            while not stop.is_set():
                turns.append(1)
                stop.wait(0.005)
        thread = threading.Thread(target=turn)
        seen = []

        def cancel():
            seen.append(len(turns))
            return len(seen) > 4
        thread.start()
        try:
            silent(furrow.simulate, strip(), cancel=cancel, **self.LONG)
        finally:
            stop.set()
            thread.join()
        self.assertGreater(seen[-1], seen[1])

    def test_two_jobs_at_once_come_to_the_bits_of_one(self):
        alone = furrow.drape(strip(), pin_vertices=[0, 11], subdivide=0).mesh.V
        results = [None, None]

        def work(i):
            results[i] = furrow.drape(strip(), pin_vertices=[0, 11], subdivide=0).mesh.V
        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for V in results:
            np.testing.assert_array_equal(V, alone)


class Keywords(unittest.TestCase):
    def test_flags_of_the_command_line_and_keywords_are_the_same(self):
        if not PROGRAM:
            self.skipTest("the command line is not built")
        for job in furrow._JOBS:
            text = subprocess.run([PROGRAM, job, "--help-all"], capture_output=True, text=True).stdout
            flags = {f.replace("-", "_") for f in re.findall(r"^ +(?:-\w,)?(?:\w+,)?--([a-z][a-z0-9-]+)", text, re.M)}
            self.assertGreater(len(flags), 5, text)
            known = {name.rstrip("_") for name in inspect.signature(getattr(furrow, job)).parameters}
            picture = {"drape": {"colour"}, "quality": {"check"}}.get(job, set())
            self.assertEqual(flags - OF_PROGRAM - picture - known, set(), job)
            keywords = {name.rstrip("_") for name, p in inspect.signature(getattr(furrow, job)).parameters.items()
                        if p.kind is p.KEYWORD_ONLY}
            self.assertEqual(keywords - OF_PYTHON - flags, set(), job)

    def test_signatures_and_docstrings_tell_them(self):
        for job in furrow._JOBS:
            function = getattr(furrow, job)
            for name, parameter in inspect.signature(function).parameters.items():
                if parameter.kind is parameter.KEYWORD_ONLY:
                    self.assertIn(f"\n{name}: ", function.__doc__)


if __name__ == "__main__":
    unittest.main()
