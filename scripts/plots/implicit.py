"""Implicit surfaces: a cut through blended bodies, and the proxy around it."""
import math

import numpy as np

from plots.look import BLUE, RED, canvas, draw_way, save, style

RADIUS = 0.001
REACH = 0.012  # m: smooth
SOLID = {"union": {"smooth": REACH, "of": [
    {"sphere": {"radius": 0.016}},
    {"capsule": {"radius": 0.007, "length": 0.05}, "axis": {"y": 1}, "degrees": 90},
    {"box": {"size": {"x": 0.012, "y": 0.06, "z": 0.012}, "radius": 0.004}, "translate": {"y": 0.012}},
]}}


def blend(a, b):
    return np.minimum(a, b) - np.maximum(REACH - np.abs(a - b), 0) ** 2 / (4 * REACH)


def values(x, y):
    """Of the solid, at z = 0, m."""
    sphere = np.hypot(x, y) - 0.016
    capsule = np.hypot(np.maximum(np.abs(x) - 0.025, 0), y) - 0.007
    box = np.hypot(np.maximum(np.abs(x) - 0.002, 0), np.maximum(np.abs(y - 0.012) - 0.026, 0)) - 0.004
    return blend(blend(sphere, capsule), box)


def around(line, step=5e-5):
    """A finger that goes along a closed line (n, 2), m, and comes to it from 10 mm outside."""
    line = line[np.argmax(line[:, 0]):].tolist() + line[: np.argmax(line[:, 0])].tolist()
    way = [(line[0][0] + d, line[0][1]) for d in np.linspace(0.01, 0, 200)]
    for begin, end in zip(line, line[1:]):
        parts = max(1, round(math.dist(begin, end) / step))
        way += [(begin[0] + (end[0] - begin[0]) * i / parts, begin[1] + (end[1] - begin[1]) * i / parts)
                for i in range(parts)]
    return [(x, y, 0.0) for x, y in way]


def blended(bench):
    """Three bodies that flow into each other, and a finger where the value is -2 mm."""
    figure, (picture, force) = canvas(1, 2, 4.6)
    x, y = np.meshgrid(np.linspace(-0.045, 0.045, 451), np.linspace(-0.035, 0.06, 476))
    picture.contourf(1e3 * x, 1e3 * y, values(x, y), levels=[-1, 0], colors=["#d8d8d8"])
    picture.contour(1e3 * x, 1e3 * y, values(x, y), levels=[0], colors=["#555555"], linewidths=1)
    scene = bench.scene([{"name": "blend", "implicit": {"expression": SOLID}}])
    inside = picture.contour(1e3 * x, 1e3 * y, values(x, y), levels=[-0.002], alpha=0).allsegs[0][0] / 1e3
    rows = bench.trace(scene, around(inside), "--radius", str(RADIUS), "--shade", "smooth")
    draw_way(picture, rows, "proxy", color=BLUE, lw=1.8, label="proxy")
    draw_way(picture, rows, "finger", color=RED, lw=1.2, label="finger")
    size = [math.sqrt(row["force_x"] ** 2 + row["force_y"] ** 2 + row["force_z"] ** 2) for row in rows]
    force.plot(np.linspace(0, 1, len(size)), size, color=BLUE, lw=1.8)
    gap = [abs(values(row["proxy_x"], row["proxy_y"]) - RADIUS) for row in rows[300:]]
    picture.set_aspect("equal")
    picture.legend(loc="upper right")
    style(picture, "x (mm)", "y (mm)", "A cut through three blended bodies")
    style(force, "part of the way", "force (N)", "Force at K = 1000 N/m")
    save(figure, "implicit.png", f"greatest force {max(size):.4f} N; value at the proxy's middle beside its radius "
                                 f"at most {1e3 * max(gap):.4f} mm")
