"""A simulated hand presses on what a depth camera sees: a wall with a hump that wanders over it. Needs no device, and
no camera.

With a server elsewhere: python3 08_a_depth_camera.py PICTURE.png hl://127.0.0.1
"""
# %%
import asyncio
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

COLUMNS, ROWS, RATE = 160, 120, 30
CAMERA = (140.0, 140.0, 79.5, 59.5)  # fx, fy, cx, cy: pixels
u, v = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
rng = np.random.default_rng(1)


# %% What a camera of your own gives: 16-bit depths in millimetres. This one has noise of 0.5 mm.
def picture(t: float) -> np.ndarray:
    hump = 40 * np.exp(-((u - 80 - 60 * math.sin(t)) ** 2 + (v - 60) ** 2) / 400)
    return (500 - hump + rng.normal(0, 0.5, u.shape)).round().astype(np.uint16)


# %% Each picture takes the place of the last one; smoothing takes most of the noise away.
async def show(touch: hl.Touch) -> None:
    t = 0.0
    while True:
        with touch.frame(wait=False):
            with touch.define(1):
                touch.depth_frame(picture(t), CAMERA, smoothing=0.9)
            touch.place(1)
        await asyncio.sleep(1 / RATE)
        t += 1 / RATE


async def feel(touch: hl.Touch, seconds: float) -> "list[hl.State]":
    states = []
    async for state in touch.states(rate=100):
        states.append(state)
        if state.time - states[0].time > seconds:
            return states
    return states


async def run(url: str) -> "list[hl.State]":
    with hl.connect(url, name="depth camera") as touch:
        touch.proxy_radius(0.008)
        touch.workspace([0, 0, -0.45], 1.0)
        touch.hand_goal([0, 0, -0.497])
        showing = asyncio.ensure_future(show(touch))
        states = await feel(touch, 6.0)
        showing.cancel()
        return states


# %%
states = asyncio.run(run(sys.argv[2] if len(sys.argv) > 2 else "inproc:"))
t = np.array([state.time for state in states]) - states[0].time
force = np.array([state.force for state in states])
figure, axes = plt.subplots(figsize=(6, 3.5))
axes.plot(t, force[:, 2])
axes.set_xlabel("t (s)"), axes.set_ylabel("force toward the camera (N)")
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "08_a_depth_camera.png", dpi=110)
print(f"{len(states)} states, largest force {force[:, 2].max():.2f} N")
