"""hl.Scene, Fingers, trace and closest: closed forms, the same bits alone and together, errors, threads, memory."""
import copy
import csv
import gc
import os
import pickle
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path

import numpy as np

import hl
from hl import _hl

HL = os.environ["HL_PROGRAM"]
SQUARE = (np.array([[-0.1, 0, -0.1], [0.1, 0, -0.1], [0.1, 0, 0.1], [-0.1, 0, 0.1]]), np.array([[0, 1, 2], [0, 2, 3]]))


def random_walks(scene, walks, steps, seed):
    """(walks, steps, 3): wandering fingers in and around the scene's box."""
    random = np.random.default_rng(seed)
    low, high = scene.bounds
    begin = random.uniform(low, high, (walks, 1, 3))
    return begin + np.cumsum(random.normal(0, 0.01 * np.max(high - low), (walks, steps, 3)), axis=1)


class ClosedForms(unittest.TestCase):
    def test_a_plane_pushes_by_spring_times_depth(self):
        plane = hl.Scene(*SQUARE)
        fingers = hl.Fingers(plane, 3, hl.Settings(radius=0.001, spring=500))
        above = np.array([[0, 0.01, 0], [0.02, 0.01, 0.01], [0, 0.02, 0]])
        fingers.step(above)
        felt = fingers.step(above - [0, 0.015, 0])
        depth = np.maximum(0, 0.001 - (above[:, 1] - 0.015))
        np.testing.assert_allclose(felt.force, np.outer(500 * depth, [0, 1, 0]), atol=1e-9)
        np.testing.assert_array_equal(felt.contacts, [1, 1, 0])

    def test_friction_pulls_back_by_mu_times_the_normal_force(self):
        plane = hl.Scene(*SQUARE)
        t = np.arange(2000) * 1e-3
        path = np.column_stack([t, 0.02 * t, np.full_like(t, -0.001), np.zeros_like(t)])
        path[0, 2] = 0.01
        felt = hl.trace(plane, path, hl.Settings(static_friction=0.4, dynamic_friction=0.4))
        self.assertAlmostEqual(-felt.force[-1, 0] / felt.force[-1, 1], 0.4, places=6)

    def test_closest_points_of_a_plane(self):
        nearest = hl.closest(hl.Scene(*SQUARE), [[0.01, 0.05, 0.02], [0.3, -0.1, 0]])
        np.testing.assert_allclose(nearest.point, [[0.01, 0, 0.02], [0.1, 0, 0]], atol=1e-15)
        np.testing.assert_allclose(nearest.distance, [0.05, np.hypot(0.2, 0.1)])
        np.testing.assert_allclose(nearest.normal[0], [0, 1, 0], atol=1e-12)

    def test_a_primitive_is_the_row_of_its_triangle_whatever_was_left_out(self):
        vertices, triangles = SQUARE
        rows = np.array([[0, 0, 1], triangles[0], [2, 2, 2], triangles[1]])
        found = hl.closest(hl.Scene(vertices, rows), [[0.05, 0.01, -0.05], [-0.05, 0.01, 0.05]])
        self.assertEqual(found.primitive.tolist(), [1, 3])

    def test_arrays_of_every_layout_and_type_are_the_same_points(self):
        scene = hl.Scene("teapot", size=0.1)
        points = np.random.default_rng(1).normal(0, 0.05, (64, 3)).astype(np.float32)
        wide = np.zeros((128, 6), dtype=np.float32)
        wide[::2, ::2] = points
        unaligned = np.frombuffer(b"x" + points.tobytes(), dtype=np.uint8)[1:].view(np.float32).reshape(-1, 3)
        expected = hl.closest(scene, points)
        for same in (wide[::2, ::2], np.asfortranarray(points), points[::-1].copy()[::-1], points.astype(">f8"),
                     unaligned, points.astype(object), points.astype(np.longdouble), points.tolist()):
            for one, other in zip(hl.closest(scene, same), expected):
                np.testing.assert_array_equal(one, other)

    def test_bounds_and_count(self):
        scene = hl.Scene("teapot", size=0.1)
        self.assertAlmostEqual(float(np.max(scene.bounds[1] - scene.bounds[0])), 0.1)
        self.assertGreater(scene.primitives, 1000)
        self.assertIn("primitives", repr(scene))


class Heights(unittest.TestCase):
    def test_a_field_is_felt_as_the_triangles_of_its_samples(self):
        random = np.random.default_rng(4)
        heights = random.normal(0, 0.002, (20, 30)).astype(np.float32)
        field = hl.Scene(heights=heights, spacing=(0.01, 0.02))
        self.assertEqual(field.primitives, 2 * 19 * 29)
        np.testing.assert_allclose(field.bounds, [[-0.145, heights.min(), -0.19], [0.145, heights.max(), 0.19]], atol=1e-12)
        x, z = np.meshgrid(0.01 * np.arange(30) - 0.145, 0.02 * np.arange(20) - 0.19)
        vertices = np.column_stack([x.ravel(), heights.astype(float).ravel(), z.ravel()])
        a = (30 * np.arange(19)[:, None] + np.arange(29)).ravel()
        triangles = np.vstack([np.column_stack([a, a + 31, a + 1]), np.column_stack([a, a + 30, a + 31])])
        mesh = hl.Scene(vertices, triangles)
        points = random.uniform(-0.1, 0.1, (200, 3))
        np.testing.assert_allclose(
            hl.closest(field, points).distance, hl.closest(mesh, points).distance, rtol=0, atol=1e-12)

    def test_samples_of_16_bits_have_a_scale_and_holes(self):
        heights = np.full((5, 5), 300, np.int16)
        heights[0, 0] = -1
        field = hl.Scene(heights=heights, spacing=0.1, vertical_scale=1e-3, missing=-1)
        np.testing.assert_allclose(field.bounds[:, 1], 0.3)
        self.assertAlmostEqual(hl.closest(field, [[0, 1, 0]]).distance[0], 0.7)
        self.assertGreater(hl.closest(field, [[-0.19, 0.3, -0.19]]).distance[0], 0.05)

    def test_what_is_no_field_is_refused(self):
        for wrong in ([1, 2, 3], [[1.0]], [["a", "b"], ["c", "d"]], [[1 + 2j] * 2] * 2):
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(heights=wrong))
        good = np.zeros((3, 3), np.float32)
        for spacing in (0, -1.0, (1.0, float("nan"))):
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(heights=good, spacing=spacing))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene("teapot", heights=good))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(heights=np.full((3, 3), np.nan)))


class Warnings(unittest.TestCase):
    def test_what_is_left_out_is_said(self):
        corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        with self.assertWarnsRegex(UserWarning, "skipped 1 triangles"):
            scene = hl.Scene(corners, [[0, 1, 2], [0, 0, 1]])
        self.assertEqual(scene.primitives, 1)
        self.assertEqual(len(scene.warnings), 1)
        self.assertEqual(hl.Scene(corners, [[0, 1, 2]]).warnings, [])

    def test_which_of_several_grids_is_said_by_a_scene_file(self):
        with self.assertRaisesRegex(hl.InvalidValueError, "scene file.*grid"):
            hl.Scene("two.vdb", grid="density")
        with self.assertRaisesRegex(hl.InvalidValueError, "several grids"):
            hl.Scene(heights=np.zeros((3, 3)), grid="density")


class Nothing(unittest.TestCase):
    def test_no_points_have_no_closest_points(self):
        for none in ([], np.zeros((0, 3))):
            self.assertEqual(hl.closest(hl.Scene("sphere:100"), none).distance.shape, (0,))


class CadFiles(unittest.TestCase):
    @unittest.skipUnless((Path(HL).parent / "hl-cad").exists(), "hl-cad is not built")
    def test_a_step_file_is_a_scene_in_metres(self):
        with tempfile.TemporaryDirectory() as cache:
            os.environ["PATH"] += f":{Path(HL).parent}"
            os.environ["XDG_CACHE_HOME"] = cache
            part = hl.Scene(Path(os.environ["HL_SOURCE"]) / "scenes/examples/flange.step")
        np.testing.assert_allclose(part.bounds, [[-0.03, -0.02, 0], [0.03, 0.02, 0.02]], atol=1e-9)


class Volumes(unittest.TestCase):
    def test_planes_are_where_their_values_are(self):
        z, y, x = np.meshgrid(np.arange(6), np.arange(5), np.arange(4), indexing="ij")
        for axis, (values, middle) in enumerate([(x, 1.5), (y, 2.0), (z, 2.5)]):
            scene = hl.Scene(volume=values.astype(np.int16), iso=[1.25, 1.75], spacing=(0.01, 0.02, 0.04))
            step = (0.01, 0.02, 0.04)[axis]
            np.testing.assert_allclose(
                hl.closest(scene, [[0, 0, 0]]).distance, [abs(middle - 1.75) * step], rtol=0, atol=1e-12)

    def test_below_is_above_of_the_values_turned_around(self):
        z, y, x = np.meshgrid(*3 * [np.linspace(-0.05, 0.05, 41)], indexing="ij")
        ball = np.sqrt(x * x + y * y + z * z).astype(np.float32)
        below = hl.Scene(volume=ball, iso=0.04, spacing=0.0025, below=True)
        above = hl.Scene(volume=-ball, iso=-0.04, spacing=0.0025)
        path = np.array([[0.001 * i, 0.003, 0.055 - 1e-4 * i, 0.001 * i / 30] for i in range(300)])
        smooth = hl.Settings(radius=0.001, smooth=True)
        felt = hl.trace(below, path, smooth).force
        np.testing.assert_allclose(felt, hl.trace(above, path, smooth).force, rtol=0, atol=1e-9)
        self.assertGreater(np.abs(felt).max(), 5)
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene("teapot", below=True))

    def test_points_are_felt_as_points_or_as_surfels(self):
        steps = np.arange(-10, 11) * 0.0005
        x, z = np.meshgrid(steps, steps)
        points = np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])
        path = np.array([[0.001 * i, 0.00025, 0.003 - 1e-5 * i, 0.00025] for i in range(400)])
        settings = hl.Settings(radius=0.001)
        bare, surfels = hl.Scene(points=points), hl.Scene(points=points, surfels=True)
        self.assertEqual((bare.primitives, surfels.primitives), (441, 4 * 441))
        sunk = 0.001 - hl.trace(bare, path, settings).proxy[-1][1]
        self.assertAlmostEqual(sunk, 64.6e-6, delta=2e-7)
        self.assertAlmostEqual(hl.trace(surfels, path, settings).proxy[-1][1], 0.001, delta=1e-7)

    def test_what_is_no_cloud_is_refused(self):
        good = np.zeros((1, 3))
        for wrong in ([1.0, 2.0], np.zeros((2, 2)), np.full((2, 3), np.nan), np.zeros((0, 3))):
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(points=wrong))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(points=good, normals=np.zeros((2, 3))))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(points=good, surfels=11.0))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene("teapot", points=good))

    def test_an_implicit_surface_pushes_as_far_as_it_reaches(self):
        ball = {"expression": {"sphere": {"radius": 0.02}}}
        of_numpy = {"expression": {"sphere": {"radius": np.float64(0.02)}}, "error": np.float32(1e-6)}
        for given in (ball, of_numpy, '{"expression": {"sphere": {"radius": 0.02}}}'):
            scene = hl.Scene(implicit=given)
            fingers = hl.Fingers(scene, 1, hl.Settings(radius=0.001, spring=1000))
            fingers.step([[0, 0.03, 0]])
            felt = fingers.step([[0, 0.019, 0]])
            np.testing.assert_allclose(felt.force, [[0, 2, 0]], atol=0.02)

    def test_whole_numbers_of_python_are_indices_whatever_array_they_are_in(self):
        vertices, triangles = SQUARE
        boxed = np.array(triangles, dtype=object)
        self.assertEqual(hl.Scene(vertices, boxed).primitives, hl.Scene(vertices, triangles).primitives)
        for wrong in (0.5, None, "1", 2**70):
            boxed[0, 0] = wrong
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(vertices, boxed))

    def test_options_of_other_scenes_are_refused_by_their_names(self):
        grid = np.zeros((3, 3), dtype=np.float32)
        volume = np.arange(27, dtype=np.float32).reshape(3, 3, 3)
        made_of = {
            "heights": ({"heights": grid}, {"spacing": 0.1, "vertical_scale": 2.0, "missing": 5.0}),
            "volume": ({"volume": volume, "iso": 3.5}, {"spacing": 0.1, "missing": 50.0, "below": True}),
            "points": ({"points": np.eye(3)}, {"normals": np.eye(3), "surfels": True}),
            "implicit": ({"implicit": {"expression": {"sphere": {"radius": 0.02}}}}, {}),
            "file": ({"source": "sphere:500"}, {"size": 0.2}),
            "vertices": ({"vertices": np.eye(3), "triangles": [[0, 1, 2]]}, {"normals": np.eye(3)}),
        }
        every = {name: value for _, options in made_of.values() for name, value in options.items()}
        for kind, (needed, options) in made_of.items():
            for name, value in every.items():
                with self.subTest(f"{name} with {kind}"):
                    if name in options:
                        self.assertGreater(hl.Scene(**needed, **{name: options[name]}).primitives, 0)
                    else:
                        with self.assertRaisesRegex(hl.InvalidValueError, f"^{name} "):
                            hl.Scene(**needed, **{name: value})

    def test_stray_points_that_ruin_a_cloud_are_refused(self):
        random = np.random.default_rng(1)
        points = random.uniform(-0.5, 0.5, (2000, 3))
        for far in (10, 1000, 1e5):
            self.assertEqual(hl.Scene(points=np.vstack([points, [far, 0, 0]])).primitives, 2001)
        with self.assertRaisesRegex(hl.InvalidValueError, "1e.?08 0 0 lies so far from the rest.*remove"):
            hl.Scene(points=np.vstack([points, [1e8, 0, 0]]))

    def test_what_is_no_implicit_surface_is_refused(self):
        deep = {}
        for _ in range(100_000):
            deep = {"shell": deep}
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(implicit=deep))
        for wrong in ({}, {"expression": {"ball": {}}}, {"expression": {"sphere": {"radius": -1}}}, "sphere", 3, {1},
                      {"a": object()}):
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(implicit=wrong))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene("teapot", implicit={}))

    def test_samples_may_be_booleans(self):
        ball = np.linalg.norm(np.indices((9, 9, 9)) - 4, axis=0) < 3
        self.assertEqual(
            hl.Scene(volume=ball, iso=0.5).primitives, hl.Scene(volume=ball.astype(np.float32), iso=0.5).primitives
        )
        steps = hl.Scene(heights=ball[4])
        np.testing.assert_allclose(steps.bounds, [[-4, 0, -4], [4, 1, 4]], atol=1e-3)

    def test_heights_beyond_single_precision_are_missing(self):
        heights = np.zeros((5, 5))
        heights[0, 0] = 1e300
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(hl.Scene(heights=heights).primitives, 30)

    def test_what_a_scene_file_says_of_another_file_is_told(self):
        for name, value in (("iso", 300), ("below", True), ("surfels", True)):
            with self.assertRaisesRegex(hl.InvalidValueError, f"^{name} of a file belongs into a scene file: "):
                hl.Scene("head.nii.gz", **{name: value})

    def test_bounds_and_size_are_of_the_surface_itself(self):
        z, y, x = np.meshgrid(*3 * [np.arange(-8.0, 9)], indexing="ij")
        ball = hl.Scene(volume=3 - np.sqrt(x * x + y * y + z * z), iso=0.0)
        np.testing.assert_allclose(ball.bounds, [[-3] * 3, [3] * 3], atol=0.1)

    def test_what_is_no_volume_is_refused(self):
        good = np.arange(8, dtype=np.float32).reshape(2, 2, 2)
        hl.Scene(volume=good, iso=3.5)
        for wrong in ([[1.0, 2.0]], np.zeros((2, 2, 1)), np.full((2, 2, 2), "a")):
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(volume=wrong, iso=0.5))
        for iso in (None, 8.0, 7.0001, 0.0, float("nan"), [], "a"):
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(volume=good, iso=iso))
        for spacing in (0, -1.0, (-1, 1, 1), (1, 1, 0), (1, float("nan"), 1), float("inf")):
            with self.assertRaisesRegex(hl.InvalidValueError, "^spacing must be from 1e-12 to 1e9 m along each axis"):
                hl.Scene(volume=good, iso=3.5, spacing=spacing)
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(volume=good, iso=3.5, spacing=(1, 2)))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(volume=good, iso=3.5, missing=float("inf")))
        self.assertRaises(hl.InvalidValueError, lambda: hl.Scene("teapot", volume=good, iso=3.5))


class SameBits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = hl.Scene("rough:20000", size=0.1)
        cls.settings = hl.Settings(static_friction=0.3, dynamic_friction=0.2, smooth=True)

    def assert_same(self, one, other):
        for a, b in zip(one, other):
            self.assertEqual(a.tobytes(), np.ascontiguousarray(b).tobytes())

    def test_fingers_together_are_as_fingers_alone(self):
        walks = random_walks(self.scene, 40, 60, 1)
        together = hl.Fingers(self.scene, 40, self.settings)
        alone = [hl.Fingers(self.scene, 1, self.settings) for _ in walks]
        for step in range(walks.shape[1]):
            all_felt = together.step(walks[:, step], threads=step % 3)
            for i, finger in enumerate(alone):
                self.assert_same(finger.step(walks[i : i + 1, step]), [part[i : i + 1] for part in all_felt])

    def test_paths_together_are_as_paths_alone_in_every_form(self):
        walks = random_walks(self.scene, 6, 80, 2)
        t = np.broadcast_to(np.arange(80)[:, None] * 1e-3, (6, 80, 1))
        paths = np.concatenate([t, walks], axis=2)
        block = hl.trace(self.scene, paths, self.settings, threads=2)
        listed = hl.trace(self.scene, [paths[0], paths[1][:33], paths[2][:0]], self.settings)
        self.assertEqual(block.proxy.shape, (6, 80, 3))
        self.assertEqual(listed[2].force.shape, (0, 3))
        for i, path in enumerate(paths):
            self.assert_same(hl.trace(self.scene, path, self.settings), [part[i] for part in block])
        self.assert_same(listed[0], [part[0] for part in block])
        self.assert_same(listed[1], [part[1][:33] for part in block])

    def test_a_trace_is_that_of_the_command(self):
        walk = random_walks(self.scene, 1, 300, 3)[0]
        path = np.column_stack([np.arange(300) * 1e-3, walk])
        with tempfile.TemporaryDirectory() as folder:
            rows, out = Path(folder) / "p.csv", Path(folder) / "o.csv"
            rows.write_text("t,x,y,z\n" + "".join(",".join(map(repr, row)) + "\n" for row in path.tolist()), encoding="ascii")
            subprocess.run([HL, "trace", "rough:20000", "--fit", "0.1", "--path", rows, "--out", out, "--radius", "0.002",
                            "--dynamic-friction", "0.2", "--static-friction", "0.3", "--shade", "smooth"], check=True)
            with out.open(encoding="ascii") as file:
                table = list(csv.DictReader(file))
        felt = hl.trace(self.scene, path, self.settings)
        for row, force, proxy in zip(table, felt.force, felt.proxy):
            self.assertEqual([float(row[f"force_{axis}"]) for axis in "xyz"], force.tolist())
            self.assertEqual([float(row[f"proxy_{axis}"]) for axis in "xyz"], proxy.tolist())

    def test_a_reset_begins_anew(self):
        fingers = hl.Fingers(self.scene, 2, self.settings)
        walks = random_walks(self.scene, 2, 20, 4)
        first = [fingers.step(walks[:, i]) for i in range(20)]
        fingers.reset([True, False])
        fingers.reset()
        for i in range(20):
            self.assert_same(fingers.step(walks[:, i]), first[i])


class Errors(unittest.TestCase):
    def test_each_is_told_in_a_line_and_is_a_value_error(self):
        scene = hl.Scene(*SQUARE)
        fingers = hl.Fingers(scene, 2)
        wrong = [
            ("there is no such file", lambda: hl.Scene("missing.obj")),
            ("nothing in it can be touched", lambda: hl.Scene(np.zeros((3, 3)), [[0, 1, 2]])),
            ("needs triangles", lambda: hl.Scene(SQUARE[0])),
            ("must be integers", lambda: hl.Scene(SQUARE[0], [[0.0, 1.0, 2.0]])),
            ("names no vertex", lambda: hl.Scene(SQUARE[0], [[0, 1, 9]])),
            ("names no vertex", lambda: hl.Scene(SQUARE[0], [[0, 1, -1]])),
            ("shape (n, 3)", lambda: hl.Scene([[0, 0]], [[0, 0, 0]])),
            ("must be finite", lambda: hl.Scene(SQUARE[0] * np.nan, SQUARE[1])),
            ("one row for each vertex", lambda: hl.Scene(*SQUARE, [[0, 1, 0]])),
            ("one row for each finger", lambda: fingers.step([[0, 0, 0]])),
            ("must be finite", lambda: fingers.step([[0, 0, 0], [np.inf, 0, 0]])),
            ("one element for each finger", lambda: fingers.reset([True])),
            ("must not be negative", lambda: fingers.step(np.zeros((2, 3)), threads=-1)),
            ("must rise", lambda: hl.trace(scene, [[0, 0, 0, 0], [0, 0, 0, 0]])),
            ("(n, 4)", lambda: hl.trace(scene, np.zeros((3, 3)))),
            ("1e-12 to 1e9", lambda: hl.Fingers(scene, 1, hl.Settings(radius=0))),
            ("out of its range", lambda: hl.Fingers(scene, 1, hl.Settings(stiffness=1.5))),
            ("shape (n, 3)", lambda: hl.closest(scene, [0, 0, 0])),
            ("must be numbers", lambda: hl.closest(scene, "abc")),
            ("must be numbers", lambda: fingers.step([["a", "b", "c"]] * 2)),
            ("must be numbers", lambda: hl.Scene([["a", "b", "c"]], [[0, 0, 0]])),
            ("must be an hl.Scene", lambda: hl.Fingers(fingers, 2)),
            ("not be negative", lambda: hl.Fingers(scene, -1)),
            ("count must be a whole number, and is 1.5", lambda: hl.Fingers(scene, 1.5)),
            ("count must be", lambda: hl.Fingers(scene, 2**70)),
            ("threads must be a whole number, and is None", lambda: fingers.step(np.zeros((2, 3)), threads=None)),
            ("threads must be a whole number", lambda: hl.closest(scene, np.zeros((2, 3)), threads=1.5)),
            ("settings must be an hl.Settings, and is float", lambda: hl.trace(scene, np.zeros((1, 4)), 0.001)),
            ("settings must be an hl.Settings, and is dict", lambda: hl.Fingers(scene, 1, {})),
            ("radius must be a number, and is 'a'", lambda: hl.Fingers(scene, 1, hl.Settings(radius="a"))),
            ("viscosity must be a number", lambda: hl.Fingers(scene, 1, hl.Settings(viscosity="a"))),
            ("smooth must be", lambda: hl.Fingers(scene, 1, hl.Settings(smooth="yes"))),
            ("HL_STATIC_FRICTION is out of its range, 0 to 10",
             lambda: hl.Fingers(scene, 1, hl.Settings(static_friction=11))),
            ("1e-9 to 1e9", lambda: hl.Fingers(scene, 1, hl.Settings(spring=1e30))),
            ("1e-15 to 1e15", lambda: hl.Fingers(scene, 1, hl.Settings(period=1e-300))),
            ("within 1e15", lambda: fingers.step(np.full((2, 3), 1e16))),
            ("within 1e15", lambda: hl.closest(scene, [[1e160, 0, 0]])),
            ("within 1e15", lambda: hl.trace(scene, [[0, 1e300, 0, 0]])),
            ("must rise, by 1e-15 s", lambda: hl.trace(scene, [[0, 0, 0, 0], [1e-300, 0, 0, 0]])),
            ("beyond 1e9 m", lambda: hl.Scene(SQUARE[0] * 1e20, SQUARE[1])),
            ("must be numbers, and are complex128", lambda: hl.closest(scene, np.zeros((2, 3), complex))),
            ("must be numbers, and are datetime64", lambda: hl.closest(scene, np.zeros((2, 3), "M8[s]"))),
            ("mask must be booleans, and are int64", lambda: fingers.reset([0, 1])),
            ("must be integers", lambda: hl.Scene(SQUARE[0], [[0, 1, 2], [0, 1]])),
            ("size must be a number", lambda: hl.Scene("teapot", size="big")),
            ("hl.Scene('teapot', size=0.1)", lambda: hl.Scene("teapot", 0.1)),
            ("a zero in it", lambda: hl.Scene("teapot\0")),
            ("no such file", lambda: hl.Scene(b"\xff.obj")),
            ("a scene is made of one of", hl.Scene),
            ("not enough memory", lambda: hl.Fingers(scene, 10**15)),
        ]
        for text, call in wrong:
            with self.subTest(text), self.assertRaises(hl.InvalidValueError) as raised:
                call()
            self.assertIn(text, str(raised.exception))
            self.assertNotIn("\n", str(raised.exception))
            self.assertIsInstance(raised.exception, ValueError)
        fingers.step(np.zeros((2, 3)))
        self.assertEqual(hl.Scene(vertices=SQUARE[0], triangles=SQUARE[1]).primitives, 2)

    def test_settings_have_every_quantity_of_a_surface(self):
        table = (Path(os.environ["HL_SOURCE"]) / "src/base/quantities.def").read_text(encoding="utf-8")
        rows = re.findall(r"^HL_QUANTITY\(\w+,\s*\w+,\s*(\w+)", table, re.MULTILINE)
        self.assertEqual([name.upper() for name in hl.batch.SURFACE], rows)
        for name, number in hl.batch.SURFACE.items():
            self.assertEqual(getattr(_hl.calls, "HL_" + name.upper()), number)
            hl.Fingers(hl.Scene(*SQUARE), 1, hl.Settings(**{name: 0.5}))


class Threads(unittest.TestCase):
    def test_other_threads_run_while_a_call_computes(self):
        scene = hl.Scene("terrain:100000", size=0.2)
        path = np.column_stack([np.arange(200000) * 1e-3, random_walks(scene, 1, 200000, 5)[0] % 0.2 - 0.1])
        counted, ends = [0], threading.Event()

        def count():
            while not ends.is_set():
                counted[0] += 1
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        try:
            before = counted[0]
            hl.trace(scene, path, threads=1)
            during = counted[0] - before
        finally:
            ends.set()
            counter.join()
        # A lock that is held lets at most one turn through at each end of the call.
        self.assertGreater(during, 10)

    def test_threads_may_share_a_scene_and_fingers(self):
        scene = hl.Scene("teapot", size=0.1)
        fingers = hl.Fingers(scene, 50)
        failed = []

        def work(seed):
            try:
                for walk in random_walks(scene, 30, 50, seed):
                    fingers.step(walk)
                    hl.closest(scene, walk)
            except hl.Error as error:
                failed.append(error)

        threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failed, [])

    def test_more_threads_than_the_machine_has_are_as_all(self):
        scene = hl.Scene("teapot", size=0.1)
        points = random_walks(scene, 1, 500, 6)[0]
        expected = hl.closest(scene, points, threads=1).distance.tobytes()
        for threads in (1000, 10**6, 2**70):
            self.assertEqual(hl.closest(scene, points, threads=threads).distance.tobytes(), expected)

    def test_a_file_is_read_after_threads_have_been_used(self):
        hl.closest(hl.Scene("teapot"), np.zeros((1000, 3)))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "square.obj"
            file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="ascii")
            self.assertEqual(hl.Scene(file).primitives, 1)


class Interrupted(Exception):
    pass


class Signals(unittest.TestCase):
    """A signal that is heard only when a call has ended runs its handler once, however often it came meanwhile."""

    def interrupt_when_heard_thrice(self, call):
        heard = []

        def hear(_number, _frame):
            heard.append(1)
            if len(heard) == 3:
                raise Interrupted

        before = signal.signal(signal.SIGALRM, hear)
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        try:
            call()
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)

    def test_they_end_long_calls_and_leave_nothing_behind(self):
        scene = hl.Scene("rough:20000", size=0.1)
        walk = random_walks(scene, 1, 600000, 7)[0] % 0.1 - 0.05
        path = np.column_stack([np.arange(len(walk)) * 1e-3, walk])
        expected = hl.trace(scene, path[:2000])
        for call in (lambda: hl.trace(scene, path), lambda: hl.trace(scene, [path, path], threads=1),
                     lambda: hl.closest(scene, walk)):
            with self.assertRaises(Interrupted):
                self.interrupt_when_heard_thrice(call)
        self.assertEqual(hl.trace(scene, path[:2000]).force.tobytes(), expected.force.tobytes())


    def test_daemon_threads_that_compute_when_the_program_ends_do_no_harm(self):
        program = """if True:
            import sys, threading, time
            import hl, numpy as np
            scene = hl.Scene("teapot", size=0.1)
            points = np.random.default_rng(0).uniform(-0.1, 0.1, (int(sys.argv[1]), 3))
            def compute():
                while True:
                    hl.closest(scene, points, threads=1)
            for _ in range(3):
                threading.Thread(target=compute, daemon=True).start()
            time.sleep(0.2)"""
        for count in (20, 200, 300, 100000):
            done = subprocess.run([sys.executable, "-c", program, str(count)], check=False)
            self.assertEqual(done.returncode, 0)


class OtherProcesses(unittest.TestCase):
    def test_fingers_are_not_copied_by_chance(self):
        fingers = hl.Fingers(hl.Scene(*SQUARE), 1)
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "make others"):
                copied(fingers)

    def test_a_subinterpreter_is_refused(self):
        program = """if True:
            import _xxsubinterpreters as interpreters
            try:
                interpreters.run_string(interpreters.create(), "import hl")
            except interpreters.RunFailedError as error:
                print(error)
            import hl
            print(hl.Scene("teapot").primitives > 0)"""
        said = subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.PIPE, text=True).stdout
        self.assertIn("does not run in a subinterpreter", said)
        self.assertIn("True", said)

    def test_a_scene_of_a_name_is_made_anew_there(self):
        scene = hl.Scene("teapot", size=0.1)
        again = pickle.loads(pickle.dumps(scene))
        np.testing.assert_array_equal(again.bounds, scene.bounds)
        self.assertIs(copy.deepcopy(scene), scene)
        with self.assertRaisesRegex(TypeError, "send the arrays"):
            pickle.dumps(hl.Scene(*SQUARE))


class Memory(unittest.TestCase):
    def test_a_hundred_thousand_scenes_leave_nothing(self):
        def make(count):
            for _ in range(count):
                scene = hl.Scene(*SQUARE)
                hl.Fingers(scene, 2).step(np.zeros((2, 3)), threads=1)

        make(5000)  # what is made once is made
        gc.collect()
        objects, before_kB = len(gc.get_objects()), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        make(100000)
        gc.collect()
        self.assertLessEqual(len(gc.get_objects()), objects + 10)
        # A leak of one scene (some kB) each would be hundreds of MB; what is tolerated is the allocator's slack.
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before_kB, 4096)


if __name__ == "__main__":
    unittest.main()
