"""Implicit surfaces: a cut through blended bodies, and the proxy around it."""
import math

import numpy as np

from plots.look import BLUE, RED, canvas, draw_way, save, style

RADIUS = 0.001
REACH = 0.012  # m: smooth
SOLID = {"union": {"smooth": REACH, "of": [
    {"sphere": {"radius": 0.016}},
    {"capsule": {"radius": 0.007, "length": 0.05}, "axis": {"y": 1}, "degrees": 90},
    {"box": {"size": {"x": 0.012, "y": 0.06, "z": 0.012}, "radius": 0.002}, "translate": {"y": 0.012}},
]}}


def blend(a, b):
    return np.minimum(a, b) - np.maximum(REACH - np.abs(a - b), 0) ** 2 / (4 * REACH)


def values(x, y):
    """Of the solid, at z = 0, m."""
    sphere = np.hypot(x, y) - 0.016
    capsule = np.hypot(np.maximum(np.abs(x) - 0.025, 0), y) - 0.007
    box = np.hypot(np.maximum(np.abs(x) - 0.004, 0), np.maximum(np.abs(y - 0.012) - 0.028, 0)) - 0.002
    return blend(blend(sphere, capsule), box)


def around(speed=0.05, rate_Hz=1000.0):
    """A finger on a ray from the middle, at the place where the solid's value is -2 mm; it comes from 10 mm outside."""
    count = int(0.2 / speed * rate_Hz)
    radii = np.linspace(0, 0.05, 2001)
    ways = []
    for angle in np.radians(np.linspace(-60, 240, count)):
        inside = values(radii * math.cos(angle), radii * math.sin(angle)) < -0.002
        ways.append((radii[np.flatnonzero(inside)[-1]], angle))
    first = [(ways[0][0] + d, ways[0][1]) for d in np.linspace(0.01, 0, 200)]
    return [(r * math.cos(a), r * math.sin(a), 0.0) for r, a in first + ways]


def blended(bench):
    """Three bodies that flow into each other, and a finger some 3 mm beneath the proxy."""
    figure, (picture, force) = canvas(1, 2, 4.6)
    x, y = np.meshgrid(np.linspace(-0.045, 0.045, 451), np.linspace(-0.035, 0.06, 476))
    picture.contourf(1e3 * x, 1e3 * y, values(x, y), levels=[-1, 0], colors=["#d8d8d8"])
    picture.contour(1e3 * x, 1e3 * y, values(x, y), levels=[0], colors=["#555555"], linewidths=1)
    scene = bench.scene([{"name": "blend", "implicit": {"expression": SOLID}}])
    rows = bench.trace(scene, around(), "--radius", str(RADIUS), "--shade", "smooth")
    draw_way(picture, rows, "proxy", color=BLUE, lw=1.8, label="proxy")
    draw_way(picture, rows, "finger", color=RED, lw=1.2, label="finger")
    size = [math.sqrt(row["force_x"] ** 2 + row["force_y"] ** 2 + row["force_z"] ** 2) for row in rows]
    force.plot(np.linspace(0, 1, len(size)), size, color=BLUE, lw=1.8)
    gap = [abs(values(row["proxy_x"], row["proxy_y"]) - RADIUS) for row in rows[len(rows) // 4:]]
    picture.set_aspect("equal")
    picture.legend(loc="upper right")
    style(picture, "x (mm)", "y (mm)", "A cut through three blended bodies")
    style(force, "part of the way", "force (N)", "Force at K = 1000 N/m")
    save(figure, "implicit.png", f"greatest force {max(size):.4f} N; value at the proxy's middle beside its radius "
                                 f"at most {1e3 * max(gap):.4f} mm")
