"""The distance to a surface on a plane through it: 90 000 closest points."""
# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

scene = hl.Scene("teapot", size=0.1)
low, high = scene.bounds

# %%
x, y = np.meshgrid(np.linspace(low[0] - 0.02, high[0] + 0.02, 360), np.linspace(low[1] - 0.02, high[1] + 0.02, 250))
nearest = hl.closest(scene, np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]))

# %%
figure, axes = plt.subplots(figsize=(7, 4))
shown = axes.contourf(1000 * x, 1000 * y, 1000 * nearest.distance.reshape(x.shape), levels=24)
figure.colorbar(shown, label="distance (mm)")
axes.set_aspect("equal"), axes.set_xlabel("x (mm)"), axes.set_ylabel("y (mm)")
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "04_distances.png", dpi=110)
