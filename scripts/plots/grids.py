"""Distance grids: how far a ball of radius R is felt from where it is, for two sizes of voxels."""
import math

import numpy as np

from plots.look import BLUE, RED, canvas, save, style

RADIUS, BALL = 0.001, 0.02
VOXELS = ((2e-3, RED), (1e-3, BLUE))  # m


def distances(voxel):
    """Of the ball, on a grid around it, with a band of three voxels; x first, then y, then z."""
    steps = np.arange(-13e-3 * 2, 13e-3 * 2 + voxel / 2, voxel)
    z, y, x = np.meshgrid(steps, steps, steps, indexing="ij")
    exact = np.sqrt(x * x + y * y + z * z) - BALL
    return steps.size, np.clip(exact, -3 * voxel, 3 * voxel)


def around():
    """A finger that comes from outside and goes once around the ball, 1 mm within it, across the voxels."""
    turn = np.linspace(0, 2 * math.pi, 1500)
    x, y = np.append(np.linspace(0.03, BALL - 1e-3, 100), (BALL - 1e-3) * np.cos(turn)), np.append(
        np.zeros(100), (BALL - 1e-3) * np.sin(turn))
    return [(a, b, 0.3 * b) for a, b in zip(x, y)]


def ball(bench):
    figure, (picture, error) = canvas(1, 2, 4.6)
    greatest = {}
    for voxel, color in VOXELS:
        side, values = distances(voxel)
        scene = bench.scene([{"name": "ball", "volume": {
            "size": [side] * 3, "values": values.ravel().tolist(), "spacing": [voxel], "iso": 0, "below": True}}])
        rows = bench.trace(scene, around(), "--radius", str(RADIUS))[100:]
        at = np.array([[row["proxy_x"], row["proxy_y"], row["proxy_z"]] for row in rows])
        apart = np.linalg.norm(at, axis=1) - RADIUS - BALL
        greatest[voxel] = np.abs(apart).max()
        angle = np.degrees(np.unwrap(np.arctan2(at[:, 1], at[:, 0])))
        error.plot(angle, 1e6 * apart, color=color, lw=1.2, label=f"voxels of {1e3 * voxel:.0f} mm")
        error.axhline(-1e6 * 0.51 * voxel**2 / BALL, color=color, lw=1, ls=":")
    side, values = distances(VOXELS[0][0])
    steps = 1e3 * np.linspace(-0.026, 0.026, side)
    shown = picture.contourf(steps, steps, 1e3 * values[side // 2], levels=np.arange(-6, 7), cmap="coolwarm")
    picture.contour(steps, steps, values[side // 2], levels=[0], colors=["#222222"], linewidths=1.2)
    x, y = np.meshgrid(steps, steps)
    picture.plot(x.ravel(), y.ravel(), ".", color="#555555", ms=1)
    figure.colorbar(shown, ax=picture, label="distance (mm)")
    picture.set_aspect("equal")
    error.set_ylim(top=25)
    error.legend(loc="upper center", ncols=2)
    style(picture, "x (mm)", "y (mm)", "A band of distances around a ball of 20 mm")
    style(error, "angle (degrees)", "felt beside the ball (µm)", "Dotted: 0.51 h² / R")
    save(figure, "grids.png", ", ".join(f"{1e6 * far:.1f} µm at {1e3 * voxel:.0f} mm" for voxel, far in greatest.items()))
