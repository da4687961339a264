"""How stiff a simulated device lets a floor be (by rate, delay and damping: the Z-width), and a body that is free."""
import csv
import subprocess

from plots.look import BLUE, GREEN, GREY, ORANGE, RED, canvas, save, style

COLOURS = {"light": BLUE, "firm": ORANGE}
ZWIDTH_COLOURS = {1000: BLUE, 4000: GREEN}
PAPER_N_M = 1800
CEILING_N_M = 40000   # hl stability looks no further
DAMPINGS = "0,1,2,4,8,16,32,64"
BODIES_KG = "0.001,0.002,0.005,0.01,0.02,0.05,0.1,0.2,0.3,0.5,1,2,5,10"
COUPLINGS = {"session": (BLUE, "HL: one solve with the proxy"), "force_before": (ORANGE, "force of the step's begin"),
             "force_late": (RED, "force of the step before")}


def measure(bench, *options):
    file = bench.new_file(".csv")
    done = subprocess.run([bench.hl, "stability", "--csv", str(file), *options], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"figures: hl stability\n{done.stderr}")
    with file.open() as rows:
        return [{key: value if key in ("device", "grip") else float(value or "nan") for key, value in row.items()}
                for row in csv.DictReader(rows)]


def draw_band(axes, rows, x, grip):
    """From what settles after everything together to what settles after one thing at a time."""
    xs = [row[x] for row in rows]
    low, high = ([row[name] for row in rows] for name in ("together_N_m", "one_by_one_N_m"))
    axes.fill_between(xs, low, high, color=COLOURS[grip], alpha=0.25, lw=0)
    axes.plot(xs, low, marker="o", color=COLOURS[grip], label=f"{grip} grip")


def draw_paper(axes):
    axes.axhline(PAPER_N_M, color=RED, lw=1, ls="--", label="the paper: > 1800 N/m")


def z_width(bench):
    rows = measure(bench)
    damped = measure(bench, "--quick", "--grips", "light", "--rates", "1000,4000", "--damping", DAMPINGS)
    figure, (by_rate, by_delay, width) = canvas(1, 3, 4.4)
    for grip in COLOURS:
        of_grip = [row for row in rows if row["grip"] == grip]
        draw_band(by_rate, [row for row in of_grip if row["delay_steps"] == 0], "rate_Hz", grip)
        draw_band(by_delay, sorted((row for row in of_grip if row["rate_Hz"] == 1000), key=lambda row: row["delay_steps"]),
                  "delay_steps", grip)
    rates = sorted({row["rate_Hz"] for row in rows})
    by_rate.plot(rates, [2 * 0.005 * rate for rate in rates], color=GREY, lw=1.2, label="passive: 2 b / T")
    by_rate.set_xscale("log", base=2)
    by_rate.set_xticks(rates, [f"{rate / 1000:g}" for rate in rates])
    by_rate.set_yscale("log")
    by_delay.set_ylim(bottom=0)
    for axes in (by_rate, by_delay):
        draw_paper(axes)
    by_rate.legend(loc="center right")
    style(by_rate, "servo rate (kHz)", "highest K that settles (N/m)", "No delay")
    style(by_delay, "steps of delay", "", "1 kHz")
    for rate, colour in ZWIDTH_COLOURS.items():
        of_rate = [row for row in damped if row["rate_Hz"] == rate]
        width.plot([row["damping_Ns_m"] for row in of_rate], [row["one_by_one_N_m"] for row in of_rate], marker="o", color=colour,
                   label=f"{rate / 1000:g} kHz, light grip")
    width.axhline(CEILING_N_M, color=GREY, lw=1, ls=":", label="not searched beyond")
    width.set_ylim(bottom=0)
    width.legend(loc="center right")
    style(width, "damping B of the servo (N s/m)", "", "Z-width")
    save(figure, "stability.png", *(f"{row['grip']:5} {row['rate_Hz']:5.0f} Hz, {row['delay_steps']:.0f} steps of delay: "
                                    f"{row['together_N_m']:.0f} to {row['one_by_one_N_m']:.0f} N/m" for row in rows))


def on_bodies(bench):
    """Points are found, lines are theory."""
    rows = measure(bench, "--body", BODIES_KG, "--rates", "1000,4000")
    figure, both = canvas(1, 2, 4.4, sharey=True)
    for axes, rate in zip(both, (1000, 4000)):
        of_rate = [row for row in rows if row["rate_Hz"] == rate]
        grams = [1000 * row["body_kg"] for row in of_rate]
        for name, (colour, label) in COUPLINGS.items():
            found = [row[f"{name}_N_m"] for row in of_rate]
            axes.plot(grams, found, marker="o", ms=4, ls="", color=colour, label=label)
            axes.plot(grams, [min(row[f"{name}_theory_N_m"], CEILING_N_M) for row in of_rate], color=colour, lw=1.2)
        axes.axhline(2 * 0.5 * rate, color=GREY, lw=1, ls="--", label="a wall")
        axes.axhline(CEILING_N_M, color=GREY, lw=1, ls=":", label="not searched beyond")
        axes.set_xscale("log")
        axes.set_yscale("log")
        style(axes, "mass of the body (g)", "highest stable K (N/m)" if rate == 1000 else "", f"{rate / 1000:g} kHz")
    both[0].legend(loc="lower right")
    save(figure, "stability_bodies.png", *(
        f"{row['rate_Hz']:5.0f} Hz, {1000 * row['body_kg']:6g} g: " +
        ", ".join(f"{name} {row[name + '_N_m']:.5g} ({row[name + '_theory_N_m']:.5g})" for name in COUPLINGS) for row in rows))
