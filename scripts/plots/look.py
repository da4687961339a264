"""How every picture looks, and how it is written."""
import io
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from PIL import Image  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent.parent
folder = ROOT / "docs" / "figures"  # where pictures go; scripts/figures --out sets another

BLUE, RED, GREY, GREEN, ORANGE = "#2f6fb2", "#c0392b", "#5b6675", "#2e7d3a", "#b06a00"
PURPLE, BROWN, PINK = "#7d4aa8", "#6d3b1f", "#c2478c"
SOLID = "#dfe5ec"    # inside of objects
MM = 1000.0          # metres are drawn as millimetres
WIDTH_IN = 10.0
DPI = 120            # 1200 pixels wide
COLOURS = 256        # of the written palette: a third of the bytes

plt.rcParams.update({"font.size": 10.5, "axes.titlesize": 11.5, "legend.fontsize": 9.5, "legend.framealpha": 0.9,
                     "legend.edgecolor": "white", "figure.constrained_layout.w_pad": 0.08, "figure.constrained_layout.h_pad": 0.06})


def canvas(rows=1, columns=1, height=4.2, **options):
    return plt.subplots(rows, columns, figsize=(WIDTH_IN, height), layout="constrained", **options)


def style(axes, x, y, title=None):
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.25)
    if title:
        axes.set_title(title)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def column(rows, name, scale=1.0):
    return [scale * row[name] for row in rows]


def draw_way(axes, rows, who, **options):
    """The way of the finger or the proxy in the plane z = 0, in millimetres."""
    axes.plot(column(rows, who + "_x", MM), column(rows, who + "_y", MM), **options)


def draw_springs(axes, rows, **options):
    """A thin line from finger to proxy for each row: where the force pulls."""
    for row in rows:
        axes.plot([MM * row["finger_x"], MM * row["proxy_x"]], [MM * row["finger_y"], MM * row["proxy_y"]],
                  **{"color": GREY, "lw": 0.5, **options})


def draw_arrow(axes, start, end, colour, **options):
    axes.annotate("", end, start, arrowprops={"color": colour, "lw": 1.8, "shrinkA": 0, "shrinkB": 0, **options}, zorder=4)


def save(figure, name, *facts):
    """Writes the picture, and prints the numbers that the documents quote."""
    pixels = io.BytesIO()
    figure.savefig(pixels, dpi=DPI)
    plt.close(figure)
    picture = Image.open(pixels).convert("RGB")
    picture.quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(folder / name, optimize=True)
    print(folder.relative_to(ROOT) / name if folder.is_relative_to(ROOT) else folder / name)
    for fact in facts:
        print(f"    {fact}")
