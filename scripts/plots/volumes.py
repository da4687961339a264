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

SPACING, BALL = 0.5, 20.0  # mm: between samples; radius of the ball that is scanned


class VoxelBalls:
    """What CHAI3D 3.3 touches of a volume (cVoxelObject): the proxy, a ball of radius r, rests on balls of 0.7 h around
    the samples at or above the threshold. No value lies between samples. Without its 8 bits and its steps of one voxel."""

    def __init__(self, values, spacing, radius):
        """`values` (z, y, x): matter is above 0. Lengths in mm."""
        solid = values >= 0
        inner = solid.copy()
        for axis in range(3):
            inner &= np.roll(solid, 1, axis) & np.roll(solid, -1, axis)
        z, y, x = np.nonzero(solid & ~inner)
        half = 0.5 * (np.array(values.shape[::-1]) - 1)
        self.centres = spacing * (np.stack([x, y, z], 1) - half)
        self.reach = radius + 0.7 * spacing

    def first(self, begin, way):
        """How far a ball goes from `begin` along the unit vector `way`, mm."""
        ahead = (self.centres - begin) @ way
        off2 = ((self.centres - begin) ** 2).sum(1) - ahead**2
        near = off2 < self.reach**2
        return (ahead[near] - np.sqrt(self.reach**2 - off2[near])).min()


def grid(side, spacing):
    steps = spacing * (np.arange(side) - 0.5 * (side - 1))
    z, y, x = np.meshgrid(steps, steps, steps, indexing="ij")
    return x, y, z


def scan(bench, name, values, spacing):
    """A scene of float samples, in mm, whose surface is at 0."""
    header = (f"NRRD0004\ntype: float\ndimension: 3\nsizes: {' '.join(map(str, values.shape[::-1]))}\n"
              f"spacings: {spacing} {spacing} {spacing}\nencoding: raw\nendian: little\n\n")
    (bench.folder / f"{name}.nrrd").write_bytes(header.encode() + values.astype("<f4").tobytes())
    return bench.scene([{"volume": {"file": f"{name}.nrrd", "iso": 0}}])


def touched(bench, scene, fingers):
    """Places of the proxy, mm, one for each finger, which is given in m."""
    rows = bench.trace(scene, fingers, "--radius", "0.001")
    return MM * np.array([[row["proxy_x"], row["proxy_y"], row["proxy_z"]] for row in rows])


def over_a_wall(bench, axes):
    """Of matter below a flat face between two samples; how far above the face a proxy of 1 mm is, less its radius."""
    _, _, z = grid(41, SPACING)
    face = 0.1
    scene, balls = scan(bench, "wall", face - z, SPACING), VoxelBalls(face - z, SPACING, 1.0)
    along, facts = np.arange(-3, 3, 0.005), []
    for name, way, color in [("along a row", (1, 0), BLUE), ("across", (math.sqrt(0.5), math.sqrt(0.5)), GREEN)]:
        places = np.stack([along * way[0], along * way[1], np.full_like(along, 6)], 1)
        theirs = 1000 * (5 - face - np.array([balls.first(place, np.array([0.0, 0.0, -1.0])) for place in places]))
        depth = np.maximum(3 - 0.02 * np.arange(len(along)), -1)
        own = 1000 * (touched(bench, scene, np.column_stack([places[:, :2], depth]) / MM)[400:, 2] - 1 - face)
        axes.plot(along, theirs, color=color, lw=1.5, label=f"CHAI3D's method, {name}")
        axes.plot(along[400:], own, color=RED, lw=1.5, label="HL, both" if color == GREEN else None)
        facts.append(f"wall {name}: dips of {np.ptp(theirs):.1f} um, {theirs.mean():.0f} um too high; HL {np.abs(own).max():.1e} um")
    return facts


def around_a_ball(bench, axes):
    """The same around a ball of 20 mm."""
    x, y, z = grid(89, SPACING)
    values = BALL - np.sqrt(x**2 + y**2 + z**2)
    scene, balls = scan(bench, "ball", values, SPACING), VoxelBalls(values, SPACING, 1.0)
    degrees = np.arange(0, 180, 0.1)
    ways = np.stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0 * degrees], 1)
    theirs = 1000 * (23 - BALL - np.array([balls.first(24 * way, -way) for way in ways]))
    down = np.linspace(24, BALL - 1, 300)[:, None] * ways[0]
    own = touched(bench, scene, np.concatenate([down, (BALL - 1) * ways]) / MM)[300:]
    own = 1000 * (np.linalg.norm(own, axis=1) - 1 - BALL)
    axes.plot(degrees, theirs, color=BLUE, lw=1.2, label="CHAI3D's method")
    axes.plot(degrees, own, color=RED, lw=1.5, label="HL")
    return [f"ball: {theirs.min():.0f} to {theirs.max():.0f} um; HL {own.min():.1f} to {own.max():.1f} um"]


def beside_balls(bench):
    """A flat wall and a ball in a scan: the way of a proxy, and that over the balls of another library."""
    figure, (wall, ball) = canvas(1, 2, 4.2)
    facts = over_a_wall(bench, wall) + around_a_ball(bench, ball)
    for axes in (wall, ball):
        axes.legend()
    style(wall, "along the wall (mm)", "too high (µm)", "A flat wall, samples 0.5 mm apart")
    style(ball, "around the ball (degrees)", "too far out (µm)", "A ball of 20 mm, the same")
    save(figure, "volumes_voxels.png", *facts)
