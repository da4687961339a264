"""A simulated hand presses a button that clicks; its way and its force are read while it is pressed. Needs no device.

With a server elsewhere: python3 07_a_button.py PICTURE.png hl://127.0.0.1
"""
# %%
import asyncio
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

CORNERS = [[x, y, z] for x in (-0.01, 0.01) for y in (-0.005, 0.005) for z in (-0.01, 0.01)]
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
# Of the way down, m, and of the force up, N: at 1.8 mm it gives way, and it ends at 4 mm.
WAY, FORCE = [-0.004, -0.0022, -0.0018, 0], [1.6, 0.5, 1.2, 0.3]


# %% A slider leaves the button its way along y; the table is what it feels like.
def show(touch: hl.Touch) -> None:
    with touch.frame():
        with touch.define() as button:
            touch.body("box", mass=0.01)
            touch.draw(CORNERS, SIDES, mode=hl.calls.HL_QUADS)
        touch.place(button)
        touch.join(1, button, kind="slider", axis=[0, 1, 0], low=-0.004, high=0, damping=0.5, table=(WAY, FORCE))


async def press(touch: hl.Touch, seconds: float) -> "list[tuple[float, float]]":
    felt, begin = [], None
    async for state in touch.states(rate=100):
        begin = state.time if begin is None else begin
        part = (state.time - begin) / seconds
        if part > 1:
            break
        touch.hand_goal([0, 0.01 - 0.025 * (1 - math.cos(2 * math.pi * part)), 0])
        for joint in touch.joints():
            felt.append((joint["coordinate"], state.force[1]))
    return felt


# %%
with hl.connect(sys.argv[2] if len(sys.argv) > 2 else "inproc:", name="button") as touch:
    touch.hand_goal([0, 0.02, 0])
    show(touch)
    way, force = np.array(asyncio.run(press(touch, 6.0))).T
figure, axes = plt.subplots(figsize=(6, 4))
axes.plot([-1000 * y for y in WAY], FORCE, "k--", label="its table")
axes.plot(-1000 * way, force, ".", label="the hand")
axes.set_xlabel("way of the button (mm)"), axes.set_ylabel("force (N)"), axes.legend()
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "07_a_button.png", dpi=110)
print(f"pressed by {-1000 * way.min():.2f} mm, largest force {force.max():.2f} N")
