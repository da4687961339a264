"""Clouds: the proxy over points, and over surfels of the same points."""
import math

from plots.look import BLUE, GREEN, MM, RED, canvas, save, style

RADIUS, SPACING = 0.001, 0.0005


def over_points(bench):
    """A finger 1 mm beneath a square grid of points, along its diagonal; heights, and how far the force is tilted."""
    figure, (heights, tilts) = canvas(1, 2, 4.2)
    grid = [(SPACING * i, 0.0, SPACING * j) for i in range(-14, 15) for j in range(-14, 15)]
    down = [(0.0, y / MM, 0.0) for y in [3 - 0.02 * i for i in range(200)]]
    path = down + [(d, -0.001, d) for d in [2e-6 * i for i in range(1000)]]
    numbers = []
    for name, surfels, shade, color in [("points", False, "flat", BLUE), ("points, smooth", False, "smooth", GREEN),
                                        ("surfels", True, "smooth", RED)]:
        cloud = {"positions": [x for point in grid for x in point], "surfels": surfels}
        rows = bench.trace(bench.scene([{"name": name, "cloud": cloud}]), path, "--radius", str(RADIUS),
                           "--shade", shade)[len(down):]
        along = [MM * math.hypot(row["finger_x"], row["finger_z"]) for row in rows]
        high = [1000 * (MM * row["proxy_y"] - 1) for row in rows]
        tilt = [math.degrees(math.atan2(math.hypot(row["force_x"], row["force_z"]), row["force_y"])) for row in rows]
        heights.plot(along, high, color=color, lw=1.8, label=name)
        tilts.plot(along, tilt, color=color, lw=1.8, label=name)
        numbers.append(f"{name}: {min(high):.2f} to {max(high):.2f} um, tilt to {max(tilt):.3f} degrees")
    heights.legend()
    tilts.legend()
    style(heights, "along the diagonal (mm)", "height of the proxy - r (µm)", "Points 0.5 mm apart, r = 1 mm")
    style(tilts, "along the diagonal (mm)", "tilt of the force (degrees)", "Force on a plane of points")
    save(figure, "clouds.png", "; ".join(numbers))
