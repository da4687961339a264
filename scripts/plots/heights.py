"""Height fields: the proxy over the hills of a field, and its force."""
import math

from plots.bench import straight
from plots.look import BLUE, GREY, MM, RED, canvas, column, draw_way, save, style

RADIUS = 0.002
SCENE = "field:terrain:1000000"


def hill(x):
    """Height of field:terrain at z = 0, m; its samples are rounded to 0.5 um."""
    return 0.009 * math.sin(40 * x + 0.4) + 0.004 * math.sin(87 * x) + 0.0015 * math.sin(190 * x - 0.8) * math.sin(0.3)


def over_hills(bench):
    """A finger that goes straight through the hills of a field; the proxy stays on them."""
    rows = bench.trace(SCENE, straight((-0.08, 0.004), (0.08, 0.004), speed=0.1), "--radius", str(RADIUS), "--shade", "smooth")
    figure, (picture, force) = canvas(1, 2, 4.2)
    places = [-0.09 + 1.8e-4 * i for i in range(1001)]
    picture.fill_between([MM * x for x in places], [MM * hill(x) for x in places], -20, color=GREY, alpha=0.3, lw=0)
    draw_way(picture, rows, "proxy", color=BLUE, lw=1.8, label="proxy, radius 2 mm")
    draw_way(picture, rows, "finger", color=RED, lw=1.8, label="finger")
    picture.set_ylim(-16, 22)
    picture.legend(loc="upper right", framealpha=0)
    style(picture, "x (mm)", "y (mm)", "A million triangles, none of which is stored")
    size = [math.sqrt(row["force_x"] ** 2 + row["force_y"] ** 2 + row["force_z"] ** 2) for row in rows]
    force.plot([MM * x for x in column(rows, "finger_x")], size, color=BLUE, lw=1.8)
    style(force, "finger's x (mm)", "force (N)", "Force at K = 1000 N/m")
    save(figure, "heights.png", f"greatest force {max(size):.4f} N")
