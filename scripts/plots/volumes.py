"""Volumes: a slice of the phantom, and the proxy on two of its surfaces."""
import math

import numpy as np

from plots.look import BLUE, GREEN, MM, RED, canvas, draw_way, save, style

RADIUS = 0.002
SLICE = 12.0  # mm: z of the slice


def phantom(x, y, z):
    """Values of ct:phantom, HU, at places in mm; for samples 1 mm apart."""
    def inside(distance):
        return np.clip(0.5 - distance / 2, 0, 1)

    def rod(cy, half, radius):
        along = np.clip(y - cy, -half, half)
        return np.sqrt(x**2 + (y - cy - along) ** 2 + z**2) - radius

    tilt = math.pi / 9
    cut = math.sin(tilt) * x + math.cos(tilt) * (y - 48)
    tissue = np.minimum(np.maximum(np.sqrt(x**2 + (y - 10) ** 2 + z**2) - 60, cut), rod(-60, 30, 28))
    ball = np.sqrt((x + 22) ** 2 + (y - 18) ** 2 + (z - 12) ** 2) - 14
    px, py, pz = x - 24, y - 12, z - 8
    plate = np.maximum(np.abs(px + py + 2 * pz) / math.sqrt(6) - 3, np.sqrt(px**2 + py**2 + pz**2) - 22)
    bone = np.minimum(np.minimum(ball, rod(-40, 40, 9)), plate)
    return -1000 + 1040 * inside(tissue) + 660 * inside(bone)


def arc(middle, radius, begin, end, speed=0.05, rate_Hz=1000.0):
    """A finger that comes from 15 mm outside to a circle in the slice and goes along it: m and degrees."""
    count = int(abs(math.radians(end - begin)) * radius / speed * rate_Hz)
    ways = [(radius + d, math.radians(begin)) for d in np.linspace(0.015, 0, 300)]
    ways += [(radius, angle) for angle in np.radians(np.linspace(begin, end, count))]
    return [(middle[0] + r * math.cos(a), middle[1] + r * math.sin(a), SLICE / MM) for r, a in ways]


def skin_and_bone(bench):
    """Two surfaces of one volume: a finger some 4 mm beneath the skin, and one 3 mm beneath a bone."""
    figure, (picture, force) = canvas(1, 2, 4.6)
    x, y = np.meshgrid(np.linspace(-80, 80, 481), np.linspace(-60, 80, 421))
    picture.imshow(phantom(x, y, SLICE), extent=(-80, 80, -60, 80), origin="lower", cmap="gray", vmin=-1000, vmax=1500)
    greatest = 0
    for name, iso, path, color in [("skin", -480, arc((0, 0.01), 0.055, 170, 10), BLUE),
                                   ("bone", 370, arc((-0.022, 0.018), 0.011, 200, -20), GREEN)]:
        scene = bench.scene([{"name": name, "volume": {"builtin": "ct:phantom:161", "iso": iso}}])
        rows = bench.trace(scene, path, "--radius", str(RADIUS), "--shade", "smooth")
        draw_way(picture, rows, "proxy", color=color, lw=1.8, label=f"proxy on the {name}, {iso} HU")
        draw_way(picture, rows, "finger", color=RED, lw=1.2, label="finger" if name == "skin" else None)
        size = [math.sqrt(row["force_x"] ** 2 + row["force_y"] ** 2 + row["force_z"] ** 2) for row in rows]
        force.plot(np.linspace(0, 1, len(size)), size, color=color, lw=1.8, label=name)
        greatest = max([greatest, *size])
    picture.set_ylim(-60, 110)
    picture.legend(loc="upper right")
    force.legend()
    style(picture, "x (mm)", "y (mm)", "Two surfaces of one volume")
    style(force, "part of the way", "force (N)", "Force at K = 1000 N/m")
    save(figure, "volumes.png", f"greatest force {greatest:.4f} N")
