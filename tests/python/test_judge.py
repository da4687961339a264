"""Random soups and finger paths: what hl returns against plain judges, which know nothing of hl's code.

HL_JUDGE_CASES=20000 python3 tests/python/test_judge.py draws so many cases, HL_JUDGE_FIRST the number of the first.
"""
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import hl
import judge

CASES = int(os.environ.get("HL_JUDGE_CASES", "60"))
FIRST = int(os.environ.get("HL_JUDGE_FIRST", "1"))
HL = os.environ["HL_PROGRAM"]

CLEARANCE = 1e-6  # parts of the radius by which a proxy may be nearer than its radius (docs/trace.md)
UNRESISTED = 2e-5  # parts of the pull that contacts may leave: 1.5e-5 (docs/trace.md), and what this judge rounds
TANK_J = 0.01  # what the energy tank holds at first; only what contacts dissipate refills it (docs/trace.md)
TOUCHING = 1e-7  # parts of the radius: what is nearer counts as a contact; hl's own skin is 1e-10
BOX = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])  # outward


class Case:
    """A scene of random triangles, a radius and a path, all drawn from one number."""

    def __init__(self, number):
        self.random = np.random.default_rng(number)
        self.size = 10.0 ** self.random.uniform(-4, 3)  # m
        self.radius = self.size * 10.0 ** self.random.uniform(-2.5, -0.7)
        self.spring = 10.0 ** self.random.uniform(1, 4)  # N/m
        vertices, indices, self.shell = self._triangles()
        order = self.random.permutation(len(indices))
        place = self.size * self.random.uniform(-2, 2, 3)
        self.vertices = self.size * vertices + place
        self.indices = indices[order]
        self.closed = np.flatnonzero(order < self.shell)  # the numbers of the triangles of a closed box
        self.triangles, self.kept = judge.triangles_of(self.vertices, self.indices)
        self.scene = hl.Scene(self.vertices, self.indices)
        self.path = self._path(place)

    def _triangles(self):
        """Vertices about -1 .. 1, indices, and how many of the first triangles are a closed box."""
        random = self.random
        parts, shell = [], 0
        if random.random() < 0.5:
            corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
            parts.append((corners * random.uniform(0.3, 0.8, 3) + random.normal(0, 0.02, (8, 3)), BOX))
            shell = len(BOX)
        parts.append(self._soup(random.integers(1, 30)))
        if random.random() < 0.5:
            parts.append(self._sheets())
        firsts = np.cumsum([0] + [len(vertices) for vertices, _ in parts])
        return (np.concatenate([vertices for vertices, _ in parts]),
                np.concatenate([indices + first for (_, indices), first in zip(parts, firsts)]), shell)

    def _soup(self, count):
        """Triangles anywhere, some twice, some of two or of one point."""
        random = self.random
        vertices = (random.uniform(-1, 1, (count, 1, 3)) + random.normal(0, random.uniform(0.05, 0.8), (count, 3, 3)))
        indices = np.arange(3 * count).reshape(-1, 3)
        again = indices[random.integers(0, count, random.integers(0, 4))]
        none = np.array([[0, 0, 1], [2, 2, 2], [1, 0, 1]])[: random.integers(0, 4)]
        return vertices.reshape(-1, 3), np.concatenate([indices, again[:, [1, 2, 0]], none])

    def _sheets(self):
        """Pairs of parallel triangles, whose gap is up to three radii, and triangles that end near them."""
        random = self.random
        first = random.normal(0, 0.6, (3, 3))
        normal = np.cross(first[1] - first[0], first[2] - first[0])
        gap = random.uniform(0, 3) * self.radius / self.size
        second = first + gap * normal / np.linalg.norm(normal)
        third = np.array([first[0], first[1], first.mean(axis=0) + normal])
        return np.concatenate([first, second, third]), np.arange(9).reshape(-1, 3)

    def _path(self, place):
        """A walk with small steps, some jumps, some rests, and some ways straight at a vertex."""
        random, steps = self.random, 120
        step = self.size * 10.0 ** random.uniform(-3, -0.5)
        moves = random.normal(0, step, (steps, 3))
        moves[random.random(steps) < 0.05] *= 10
        moves[random.random(steps) < 0.1] = 0
        walk = place + self.size * random.uniform(-1.2, 1.2, 3) + np.cumsum(moves, axis=0)
        low, high = place - 1.5 * self.size, place + 1.5 * self.size
        walk = low + np.abs((walk - low) % (2 * (high - low)) - (high - low))  # turned back at the sides
        aimed = random.random(steps) < 0.05
        walk[aimed] = self.vertices[random.integers(0, len(self.vertices), np.count_nonzero(aimed))]
        return np.column_stack([np.cumsum(random.uniform(0.0005, 0.002, steps)), walk])

    def settings(self, **others):
        return hl.Settings(radius=self.radius, spring=self.spring, **others)


class Judged:
    """A path as it was felt, and what the judge says of each row."""

    def __init__(self, case, felt):
        self.case, self.felt, self.finger = case, felt, case.path[:, 1:]
        self.nearest = judge.nearest_points(felt.proxy, case.triangles)
        self.far = np.linalg.norm(felt.proxy[:, None] - self.nearest, axis=2)
        self.lowest = np.min(self.far, axis=1)
        free = np.all(felt.proxy == self.finger, axis=1) & np.all(felt.force == 0, axis=1)
        #: rows before the first that has a clear place: the proxy is the finger, and nothing pulls
        self.without_place = np.logical_and.accumulate(free & (self.lowest < case.radius * (1 - CLEARANCE)))

    def nearer_than_allowed(self):
        return np.flatnonzero((self.lowest < self.case.radius * (1 - CLEARANCE)) & ~self.without_place)

    def wrong_forces(self):
        """Rows whose force is not that of the spring."""
        expected = self.case.spring * (self.felt.proxy - self.finger)
        rounding = 4e-15 * self.case.spring * np.max(np.abs(self.finger))
        wrong = np.max(np.abs(self.felt.force - expected), axis=1)
        return np.flatnonzero(wrong > 1e-9 * np.linalg.norm(expected, axis=1) + rounding)

    def not_at_the_minimum(self):
        rows = []
        for i in np.flatnonzero(~self.without_place):
            pull = self.finger[i] - self.felt.proxy[i]
            length = np.linalg.norm(pull)
            touching = self.far[i] < self.case.radius * (1 + TOUCHING)
            normals = (self.felt.proxy[i] - self.nearest[i][touching]) / self.far[i][touching][:, None]
            # The spring's pull is told to the skin and to the rounding of coordinates only.
            least = 1e-9 * self.case.radius + 1e-14 * np.max(np.abs(self.felt.proxy[i]))
            if judge.unresisted(pull, normals) > UNRESISTED * length + least:
                rows.append(i)
        return np.array(rows, dtype=int)

    def passed_through(self):
        """Rows that are on the other side of the closed box than the first."""
        if len(self.case.closed) == 0 or np.all(self.without_place):
            return np.array([], dtype=int)
        corners = self.case.vertices[self.case.indices[self.case.closed]]
        inside = np.abs(judge.winding(self.felt.proxy, corners)) > 0.5
        rows = np.flatnonzero(~self.without_place)
        return rows[inside[rows] != inside[rows[0]]]

    def stopped_in_the_open(self):
        """Rows whose way to the finger was clear, and which are not there."""
        rows = []
        rounding = 1e-12 * self.case.radius + 1e-15 * np.max(np.abs(self.finger))
        away = np.linalg.norm(self.felt.proxy - self.finger, axis=1) > rounding
        for i in 1 + np.flatnonzero(away[1:] & ~self.without_place[1:] & ~self.without_place[:-1]):
            if judge.way_is_clear(self.felt.proxy[i - 1], self.finger[i], self.case.triangles, self.case.radius):
                rows.append(i)
        return np.array(rows, dtype=int)


def cut_short(case):
    """How many ticks of the case `hl trace` says were cut short; a Felt does not tell."""
    with tempfile.TemporaryDirectory() as folder:
        path, model, out = Path(folder) / "p.csv", Path(folder) / "m.hl.json", Path(folder) / "o.csv"
        lines = [",".join(map(repr, row)) + "\n" for row in case.path.tolist()]
        path.write_text("t,x,y,z\n" + "".join(lines), encoding="ascii")
        write_scene(model, case)
        said = subprocess.run([HL, "trace", model, "--path", path, "--out", out, "--radius", repr(case.radius), "--kp",
                               repr(case.spring)], check=True, stderr=subprocess.PIPE, text=True).stderr
    return sum(int(count) for count in re.findall(r"(?:capped|crowded|out_of_work) (\d+)", said))


def write_scene(file, case):
    primitives = {"vertices": case.vertices.ravel().tolist(), "triangles": case.indices.ravel().tolist()}
    file.write_text(json.dumps({"objects": [{"primitives": primitives}]}), encoding="ascii")


class RandomCases(unittest.TestCase):
    """One case after the other; a failure names its number, which HL_JUDGE_FIRST draws again."""

    def each_case(self, check):
        for number in range(FIRST, FIRST + CASES):
            with self.subTest(case=number):
                check(Case(number))

    def test_proxies_are_clear_of_the_scene_at_a_minimum_and_on_their_side(self):
        self.each_case(self.check_proxies_are_clear_of_the_scene_at_a_minimum_and_on_their_side)

    def check_proxies_are_clear_of_the_scene_at_a_minimum_and_on_their_side(self, case):
        judged = Judged(case, hl.trace(case.scene, case.path, case.settings(), threads=1))
        self.assertEqual(judged.nearer_than_allowed().tolist(), [])
        self.assertEqual(judged.wrong_forces().tolist(), [])
        self.assertEqual(judged.passed_through().tolist(), [])
        early = np.union1d(judged.not_at_the_minimum(), judged.stopped_in_the_open())
        if len(early) > 0:
            self.assertLessEqual(len(early), cut_short(case), f"rows {early.tolist()}")

    def test_rules_of_surfaces_keep_proxies_clear_and_add_no_energy(self):
        self.each_case(self.check_rules_of_surfaces_keep_proxies_clear_and_add_no_energy)

    def check_rules_of_surfaces_keep_proxies_clear_and_add_no_energy(self, case):
        friction, softness = case.random.uniform(0, 1.5), case.random.uniform(0, 1)
        settings = case.settings(static_friction=friction, dynamic_friction=friction * case.random.uniform(0, 1),
                                 viscosity=case.random.uniform(0, 2), stiffness=softness)
        felt = hl.trace(case.scene, case.path, settings, threads=1)
        judged = Judged(case, felt)
        self.assertEqual(judged.nearer_than_allowed().tolist(), [])
        self.assertEqual(judged.passed_through().tolist(), [])
        finger = case.path[:, 1:]
        pull = case.spring * np.linalg.norm(felt.proxy - finger, axis=1)
        rounding = 1e-14 * case.spring * np.max(np.abs(finger))
        self.assertTrue(np.all(np.linalg.norm(felt.force, axis=1) <= pull * (1 + 1e-9) + rounding))
        energy = np.max(pull**2) / case.spring
        self.assertLessEqual(np.max(felt.injected), 1e-9 * energy + 1e-12)

    def test_shading_by_any_normals_keeps_proxies_clear_and_adds_what_the_tank_held(self):
        self.each_case(self.check_shading_by_any_normals_keeps_proxies_clear_and_adds_what_the_tank_held)

    def check_shading_by_any_normals_keeps_proxies_clear_and_adds_what_the_tank_held(self, case):
        normals = case.random.normal(size=case.vertices.shape)
        normals[case.random.random(len(normals)) < 0.1] = 0  # no normal
        scene = hl.Scene(case.vertices, case.indices, normals)
        felt = hl.trace(scene, case.path, case.settings(), threads=1)
        judged = Judged(case, felt)
        self.assertEqual(judged.nearer_than_allowed().tolist(), [])
        self.assertEqual(judged.passed_through().tolist(), [])
        rounding = 1e-9 * np.sum(np.abs(felt.injected))
        self.assertLessEqual(np.max(np.cumsum(felt.injected)), TANK_J + rounding)

    def test_friction_on_one_plane_is_within_its_cone(self):
        self.each_case(self.check_friction_on_one_plane_is_within_its_cone)

    def check_friction_on_one_plane_is_within_its_cone(self, case):
        friction = case.random.uniform(0, 1.5)
        settings = case.settings(static_friction=friction, dynamic_friction=friction)
        felt = hl.trace(case.scene, case.path, settings, threads=1)
        judged = Judged(case, felt)
        touching = judged.far < case.radius * (1 + 1e-4)
        for i in 1 + np.flatnonzero((felt.contacts[1:] == 1) & (touching.sum(axis=1)[1:] == 1)):
            face = int(np.argmin(judged.far[i]))
            normal = (felt.proxy[i] - judged.nearest[i, face]) / judged.far[i, face]
            last = (felt.proxy[i - 1] - judged.nearest[i - 1, face]) / judged.far[i - 1, face]
            # An edge is round to a proxy, and the normal turns within a tick; so does that of another face.
            if not (touching[i - 1].sum() == 1 and touching[i - 1, face] and np.allclose(normal, last, atol=1e-9)):
                continue
            others = np.delete(case.triangles, face, axis=0)
            if len(others) > 0 and not judge.way_is_clear(felt.proxy[i - 1], felt.proxy[i], others, case.radius):
                continue
            across = felt.force[i] @ normal
            along = np.linalg.norm(felt.force[i] - across * normal)
            self.assertLessEqual(along, friction * across * (1 + 1e-6) + 1e-6 * case.spring * case.radius)

    def test_closest_points_are_those_of_the_judge(self):
        self.each_case(self.check_closest_points_are_those_of_the_judge)

    def check_closest_points_are_those_of_the_judge(self, case):
        points = case.path[:, 1:]
        found = hl.closest(case.scene, points)
        far = judge.distances(points, case.triangles)
        rounding = 1e-14 * (np.max(np.abs(points)) + np.max(np.abs(case.vertices)))
        np.testing.assert_allclose(found.distance, np.min(far, axis=1), rtol=1e-11, atol=rounding)
        to_found = np.linalg.norm(points - found.point, axis=1)
        np.testing.assert_allclose(to_found, found.distance, rtol=1e-9, atol=rounding)
        own = np.array([np.flatnonzero(case.kept == number)[0] for number in found.primitive.astype(int)])
        rows = np.arange(len(points))
        np.testing.assert_allclose(far[rows, own], found.distance, rtol=1e-11, atol=rounding)
        apart = found.distance > 1e6 * rounding
        expected = (points - found.point)[apart] / found.distance[apart, None]
        np.testing.assert_allclose(found.normal[apart], expected, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1, rtol=1e-9)

    def test_bits_are_the_same_in_every_form(self):
        self.each_case(self.check_bits_are_the_same_in_every_form)

    def check_bits_are_the_same_in_every_form(self, case):
        paths = np.repeat(case.path[None], 3, axis=0)
        paths[1, :, 1:] = case.path[::-1, 1:]
        paths[2, :, 1:] += case.size * case.random.normal(0, 0.1, 3)
        paths[:, :, 0] = np.arange(paths.shape[1]) / 1024  # s, whose differences are exact
        settings = case.settings(static_friction=0.4, dynamic_friction=0.3, viscosity=0.1, period=1 / 1024)
        together = hl.trace(case.scene, paths, settings, threads=2)
        alone = [hl.trace(case.scene, path, settings, threads=1) for path in paths]
        fingers = hl.Fingers(case.scene, 3, settings)
        steps = [fingers.step(paths[:, i, 1:], threads=i % 3) for i in range(paths.shape[1])]
        for part in range(4):
            self.assertEqual(np.stack([felt[part] for felt in alone]).tobytes(), together[part].tobytes())
            stepped = np.stack([felt[part] for felt in steps], axis=1)
            self.assertEqual(stepped.tobytes(), together[part].tobytes())
        half = paths.shape[1] // 2
        fingers.reset([False, True, False])
        again = [fingers.step(paths[:, i, 1:]).proxy[1] for i in range(half, paths.shape[1])]
        anew = hl.trace(case.scene, paths[1, half:], settings).proxy
        self.assertEqual(np.stack(again).tobytes(), anew.tobytes())


class TheJudge(unittest.TestCase):
    """It sees what is wrong, or its silence would mean nothing."""

    def setUp(self):
        self.case = Case(1)
        self.felt = hl.trace(self.case.scene, self.case.path, self.case.settings())
        self.rows = np.flatnonzero(self.felt.contacts > 0)
        self.assertGreater(len(self.rows), 3)

    def moved(self, rows, way):
        proxy = self.felt.proxy.copy()
        proxy[rows] += way
        return Judged(self.case, self.felt._replace(proxy=proxy))

    def test_sees_a_proxy_that_is_too_near_or_not_at_the_minimum(self):
        judged = Judged(self.case, self.felt)
        row = self.rows[-1]
        normal = self.felt.proxy[row] - judged.nearest[row, np.argmin(judged.far[row])]
        self.assertIn(row, self.moved(row, -1e-5 * normal).nearer_than_allowed())
        self.assertIn(row, self.moved(row, 1e-3 * normal).not_at_the_minimum())
        self.assertIn(row, self.moved(row, 1e-5 * normal).wrong_forces())

    def test_sees_a_proxy_in_the_open_that_is_not_at_its_finger(self):
        row = 1 + np.flatnonzero((self.felt.contacts[1:] == 0) & (self.felt.contacts[:-1] == 0))[0]
        self.assertIn(row, self.moved(row, 0.1 * self.case.radius).stopped_in_the_open())

    def test_sees_a_proxy_that_went_through_a_closed_box(self):
        case = next(case for case in map(Case, range(1, 50)) if len(case.closed) > 0)
        felt = hl.trace(case.scene, case.path, case.settings())
        middle = case.vertices[np.unique(case.indices[case.closed])].mean(axis=0)
        outside = middle + 10 * case.size
        proxy = np.where(np.arange(len(felt.proxy))[:, None] < 50, middle, outside)
        judged = Judged(case, felt._replace(proxy=proxy))
        judged.without_place[:] = False
        self.assertEqual(judged.passed_through().tolist(), list(range(50, len(proxy))))


if __name__ == "__main__":
    unittest.main()
