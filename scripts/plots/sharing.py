"""A world that three servers share: who owns what, and how old what others see of it is over a line."""
import csv

from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from plots import look
from plots.look import BLUE, GREEN, GREY, ORANGE, PURPLE, canvas, column, save, style

RESULT = look.ROOT / "bench" / "results" / "share_xeon_2_cores.csv"
COLOURS = {"anna": BLUE, "bert": ORANGE, "carl": GREEN}
PLACES = {"anna": (0.0, 5.2), "bert": (5.6, 5.2), "carl": (2.8, 0.2)}
# Of each server: what it owns, and so publishes to the others.
OWNED = {"anna": ["its scene file", "its bodies"], "bert": ["a client's objects"], "carl": []}
SIZE = (4.4, 3.6)


def draw_server(axes, name):
    x, y = PLACES[name]
    axes.add_patch(FancyBboxPatch((x, y), *SIZE, boxstyle="round,pad=0.15", fc="white", ec=COLOURS[name], lw=2))
    axes.text(x + 0.1, y + SIZE[1] - 0.4, name, color=COLOURS[name], weight="bold")
    lines = [(name, "its hands and ticks")] + [(name, "owns: " + what) for what in OWNED[name]]
    lines += [(other, "replica: " + what) for other in PLACES if other != name for what in OWNED[other]]
    for number, (owner, text) in enumerate(lines):
        axes.text(x + 0.1, y + SIZE[1] - 1.0 - 0.6 * number, text, color=COLOURS[owner], fontsize=9.5)


def draw_arrow(axes, start, end, colour, **options):
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=12, color=colour, lw=1.4, **options))


def draw_owners(axes):
    for name in PLACES:
        draw_server(axes, name)
    draw_arrow(axes, (4.6, 7.6), (5.4, 7.6), BLUE)
    draw_arrow(axes, (5.4, 6.8), (4.6, 6.8), ORANGE)
    draw_arrow(axes, (1.8, 5.0), (3.6, 4.05), BLUE)
    draw_arrow(axes, (8.0, 5.0), (6.4, 4.05), ORANGE)
    draw_arrow(axes, (4.4, 4.05), (2.6, 5.0), PURPLE, linestyle="--")
    axes.text(0.0, 9.35, "solid: objects, poses and hands, to all; dashed: pushes of a hand on a body",
              fontsize=9, color=GREY)
    axes.set_xlim(-0.4, 10.4)
    axes.set_ylim(-0.2, 9.7)
    axes.axis("off")


def draw_staleness(axes, rows):
    for loss, colour in ((0, BLUE), (1, PURPLE), (5, ORANGE)):
        of_loss = [row for row in rows if row["loss_percent"] == loss]
        axes.plot(column(of_loss, "delay_ms"), column(of_loss, "staleness_p99_ms"), "o-", color=colour,
                  label=f"p99, {loss} % lost")
    delays = sorted({row["delay_ms"] for row in rows})
    axes.plot(delays, [1.1 * delay + 2 * 1000 / 60 for delay in delays], color=GREY, ls="--",
              label="delay, jitter and two frames")
    axes.set_ylim(0)
    axes.legend(loc="upper left")
    style(axes, "delay each way (ms); a tenth of it is jitter", "age of what is shown (ms)")


def world(_):
    with RESULT.open() as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    figure, (owners, ages) = canvas(1, 2, 4.6, width_ratios=(1.25, 1))
    draw_owners(owners)
    draw_staleness(ages, rows)
    save(figure, "shared_worlds.png", f"age at most {max(column(rows, 'staleness_p99_ms')):.0f} ms (p99)",
         f"at the same place to the bit {max(column(rows, 'apart_ms')):.0f} ms after the motion")
