"""A recorded session: where the finger was, and what it felt. Record one: hl record teapot --out session.hlr"""
# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

recording = hl.read_recording(sys.argv[2] if len(sys.argv) > 2 else "session.hlr")
steps = recording.steps
print(f"{recording.device}, HL {recording.version}: {len(steps)} steps, {recording.duration:.1f} s")

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), gridspec_kw={"width_ratios": [2, 1]})
left.plot(steps["t"], np.linalg.norm(steps["force"], axis=1), linewidth=0.8)
left.set_xlabel("time (s)"), left.set_ylabel("force (N)")
size = np.linalg.norm(steps["force"], axis=1)
points = right.scatter(*(1000 * steps["finger"][:, :2].T), c=size, s=1)
figure.colorbar(points, ax=right, label="force (N)")
right.set_aspect("equal"), right.set_xlabel("x (mm)"), right.set_ylabel("y (mm)")
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "06_a_recording.png", dpi=110)
