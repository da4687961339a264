"""Random height fields and volumes, and finger paths: what hl returns against plain judges of the same forms.

HL_JUDGE_CASES=20000 python3 tests/python/test_surface_judge.py draws so many cases, HL_JUDGE_FIRST the number of the
first.
"""
import os
import unittest

import numpy as np

import hl
import surface_judge as judge

CASES = int(os.environ.get("HL_JUDGE_CASES", "60"))
FIRST = int(os.environ.get("HL_JUDGE_FIRST", "1"))
CLEARANCE = 1e-6  # parts of the radius by which a proxy may be nearer than its radius (docs/trace.md)


def random_path(random, low, high, radius):
    """(n, 4): through the box and around it, in 2 to 200 steps, at times in jumps."""
    reach = 0.3 * (high - low) + 2 * radius
    corners = random.uniform(low - reach, high + reach, (4, 3))
    if random.random() < 0.7:
        corners[0, 1] = high[1] + 3 * radius
    count = int(random.integers(20, 200))
    at = np.linspace(0, 3, count)
    points = np.stack([np.interp(at, range(4), corners[:, axis]) for axis in range(3)], 1)
    if random.random() < 0.3:
        points[1:] = corners[random.integers(0, 4, count - 1)]
    return np.column_stack([1e-3 * np.arange(count), points])


def random_heights(random):
    """Samples, spacings and scale of heights (m), and the value that stands for none: of all kinds and roughness."""
    rows, columns = (int(side) for side in random.integers(2, random.choice([3, 4, 10, 21]), 2))
    spacing = 10 ** random.uniform(-6, 2)
    form = random.integers(5)
    scale = spacing
    if form == 0:
        heights, scale = random.normal(size=(rows, columns)).astype(np.float32), spacing * 10 ** random.uniform(-2, 2)
    elif form == 1:
        heights = random.integers(-32768, 32768, (rows, columns)).astype(np.int16)
        scale = spacing / 65536 * 10 ** random.uniform(-1, 2)
    elif form == 2:
        heights, scale = np.full((rows, columns), 65535, np.uint16), 1e-4 * spacing
    elif form == 3:
        heights = (1e6 + random.normal(size=(rows, columns))).astype(np.float32)
    else:
        heights = np.cumsum(random.normal(size=(rows, columns)), 0).astype(np.float32)
    missing = None
    if random.random() < 0.4:
        missing = -9999.0 if heights.dtype == np.float32 else 7.0
        heights = np.where(random.random(heights.shape) < 0.1, np.asarray(missing).astype(heights.dtype), heights)
    return heights, (spacing, spacing * 10 ** random.uniform(-1, 1)), scale, missing


def random_volume(random):
    """Samples (z, y, x) without ties, spacings (m) and an iso value."""
    side = random.integers(2, random.choice([4, 6, 13]), 3)
    spacing = 10 ** random.uniform(-6, -2) * np.exp(random.uniform(-1.5, 1.5, 3))
    z, y, x = np.meshgrid(*[np.arange(n) - (n - 1) / 2 for n in side], indexing="ij")
    form = random.integers(4)
    iso = 0.1 * random.normal()
    if form == 0:
        values = random.normal(size=side)
    elif form == 1:
        values, iso = random.integers(-32768, 32768, side).astype(np.int16), float(random.integers(-30000, 30000)) + 0.5
        return values, spacing, iso
    elif form == 2:
        slope = random.normal(size=3)
        values = slope[0] * x + slope[1] * y + slope[2] * z
    else:
        values = min(side) / 3 - np.sqrt(x * x + y * y + z * z) + 0.2 * random.normal(size=side)
    values = values.astype(np.float32)
    if random.random() < 0.3:
        values[random.random(side) < 0.08] = np.nan
    return values, spacing, iso


class TheJudgeFindsWhatIsWrong(unittest.TestCase):
    def setUp(self):
        self.floor = judge.height_triangles(np.zeros((5, 5)), 1, 1)
        self.path = np.array([[0, 0, 1, 0], [1, 0.2, -1, 0.1], [2, 0.3, -1, 0.1]])
        self.good = np.array([[0, 1, 0], [0.2, 0.1, 0.1], [0.3, 0.1, 0.1]])

    def judged(self, proxy, factor=1.0):
        force = factor * 1000 * (proxy - self.path[:, 1:])
        return " ".join(judge.judge_trace(self.path, proxy, force, 0.1, 1000, self.floor))

    def test_it_takes_what_is_right(self):
        self.assertEqual(self.judged(self.good), "")

    def test_it_refuses_what_is_wrong(self):
        early, passed = self.good.copy(), self.good.copy()
        early[2] = early[1]
        passed[1:] = [[0.2, -0.5, 0.1], [0.3, -1, 0.1]]
        self.assertIn("inside", self.judged(self.good - [0, 0.01, 0]))
        self.assertIn("minimum", self.judged(early))
        self.assertIn("passed", self.judged(passed))
        self.assertIn("force", self.judged(self.good, 1.01))


class RandomSurfaces(unittest.TestCase):
    def test_heights(self):
        felt = 0
        for number in range(FIRST, FIRST + CASES):
            with self.subTest(number):
                felt += self.judge_heights(np.random.default_rng(number))
        self.assertGreater(felt, CASES // 2)

    def judge_heights(self, random):
        heights, spacing, scale, missing = random_heights(random)
        triangles = judge.height_triangles(heights, *spacing, scale, missing)
        made = dict(heights=heights, spacing=spacing, vertical_scale=scale, missing=missing)
        if len(triangles) == 0:
            self.assertRaises(hl.InvalidValueError, lambda: hl.Scene(**made))
            return 0
        scene = hl.Scene(**made)
        low, high = triangles.reshape(-1, 3).min(0), triangles.reshape(-1, 3).max(0)
        side = (high - low).max()
        size = np.abs(triangles).max() + side
        self.assertEqual(scene.primitives, len(triangles))
        points = random.uniform(low - 0.3 * side, high + 0.3 * side, (60, 3))
        distance, _ = judge.point_triangle(points, triangles)
        self.assertLess(np.abs(hl.closest(scene, points).distance - distance).max(), 1e-12 * size)
        radius, spring = min(spacing) * 10 ** random.uniform(-2, 1.5), 10 ** random.uniform(0, 4)
        path = random_path(random, low, high, radius)
        felt = hl.trace(scene, path, hl.Settings(radius=radius, spring=spring))
        wrong = judge.judge_trace(path, felt.proxy, felt.force, radius, spring, triangles)
        if judge.point_triangle(path[:1, 1:], triangles)[0][0] < radius:  # it begins at the nearest place that is clear
            wrong = [text for text in wrong if not text.startswith("inside")]
        self.assertEqual(wrong, [])
        return 1

    def test_volumes(self):
        felt = 0
        for number in range(FIRST, FIRST + CASES):
            with self.subTest(number):
                felt += self.judge_volume(np.random.default_rng(number))
        self.assertGreater(felt, CASES // 2)

    def judge_volume(self, random):
        values, spacing, iso = random_volume(random)
        vertices, _, _ = judge.edge_vertices(values, iso, spacing)
        if len(vertices) == 0:
            return 0
        scene = hl.Scene(volume=values, iso=iso, spacing=tuple(spacing), below=bool(random.random() < 0.5))
        high = (np.array(values.shape[::-1]) - 1) * spacing / 2
        self.assertLess(hl.closest(scene, vertices).distance.max(), 1e-9 * spacing.max(), "a vertex off the surface")
        points = random.uniform(-1.6 * high, 1.6 * high, (60, 3))
        near = hl.closest(scene, points)
        to_vertices = np.linalg.norm(points[:, None] - vertices[None], axis=2).min(1)
        self.assertTrue((near.distance <= to_vertices * (1 + 1e-9)).all(), "closest beyond a vertex")
        self.assertLess(hl.closest(scene, near.point).distance.max(), 1e-12 * high.max())
        radius, spring = spacing.min() * 10 ** random.uniform(-2, 1.3), 10 ** random.uniform(0, 4)
        path = random_path(random, -high, high, radius)
        felt = hl.trace(scene, path, hl.Settings(radius=radius, spring=spring))
        self.assertLess(np.abs(felt.force - spring * (felt.proxy - path[:, 1:])).max(), 1e-9 * (1 + np.abs(felt.force).max()))
        if hl.closest(scene, path[:1, 1:]).distance[0] < radius:
            return 0
        gap = np.linalg.norm(felt.proxy[:, None] - vertices[None], axis=2).min()
        self.assertGreaterEqual(min(gap, hl.closest(scene, felt.proxy).distance.min()), radius * (1 - CLEARANCE))
        return 1


if __name__ == "__main__":
    unittest.main()
