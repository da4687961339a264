"""A simulated hand presses on a moving plate; states are taken as they come. Needs no device.

With a server elsewhere: python3 05_live.py PICTURE.png hl://127.0.0.1
"""
# %%
import asyncio
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

PLATE = [[-0.05, 0, -0.05], [0.05, 0, -0.05], [0.05, 0, 0.05], [-0.05, 0, 0.05]]


# %% A frame is what is drawn in `with touch.frame()`. Objects that are placed elsewhere move there, and push.
async def show(touch: hl.Touch, plate: int) -> None:
    t = 0.0
    while True:
        pose = np.eye(4)
        pose[1, 3] = 0.01 * math.sin(2 * math.pi * 0.5 * t)
        with touch.frame(wait=False):
            touch.place(plate, pose)
        await asyncio.sleep(1 / 60)
        t += 1 / 60


async def feel(touch: hl.Touch, seconds: float) -> "list[hl.State]":
    states = []
    async for state in touch.states(rate=100):
        states.append(state)
        if state.time - states[0].time > seconds:
            break
    return states


async def run(url: str) -> "list[hl.State]":
    with hl.connect(url, name="live") as touch:
        with touch.frame(), touch.surface(dynamic_friction=0.3), touch.define() as plate:
            touch.draw(PLATE, [[0, 1, 2], [0, 2, 3]])
        touch.hand_goal([0, -0.005, 0])
        moving = asyncio.ensure_future(show(touch, plate))
        states = await feel(touch, 5.0)
        moving.cancel()
        return states


# %%
states = asyncio.run(run(sys.argv[2] if len(sys.argv) > 2 else "inproc:"))
t = np.array([state.time for state in states])
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(7, 4.5))
above.plot(t, [1000 * state.finger[1] for state in states], label="finger")
above.plot(t, [1000 * state.proxy[1] for state in states], label="proxy")
above.set_ylabel("height (mm)"), above.legend()
below.plot(t, [state.force[1] for state in states])
below.set_ylabel("force (N)"), below.set_xlabel("time (s)")
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "05_live.png", dpi=110)
print(f"{len(states)} states, largest force {max(float(np.linalg.norm(state.force)) for state in states):.2f} N")
