"""Drag over a plate for several coefficients of friction at once, held against Coulomb's law."""
# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

plate = hl.Scene([[-0.1, 0, -0.1], [0.1, 0, -0.1], [0.1, 0, 0.1], [-0.1, 0, 0.1]], [[0, 1, 2], [0, 2, 3]])

# %% A finger presses 2 mm into the plate, waits, and is drawn aside at 20 mm/s.
t = np.arange(0.0, 1.0, 1e-3)
path = np.column_stack([t, 0.02 * np.maximum(0, t - 0.2), np.where(t < 0.05, 0.005, -0.001), 0 * t])

# %% One trace for each coefficient. With mu_s above mu_d the proxy sticks, and then slips.
figure, axes = plt.subplots(figsize=(7, 4))
for mu in (0.1, 0.2, 0.4, 0.8):
    felt = hl.trace(plate, path, hl.Settings(static_friction=1.2 * mu, dynamic_friction=mu))
    normal, drag = felt.force[:, 1], -felt.force[:, 0]
    axes.plot(t, drag, label=f"mu_d = {mu}")
    axes.axhline(mu * normal[-1], color="grey", linewidth=0.6, linestyle=":")
    print(f"mu_d {mu}: drag / normal force = {drag[-1] / normal[-1]:.6f}")
axes.set_xlabel("time (s)"), axes.set_ylabel("drag (N)"), axes.legend()
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "03_friction.png", dpi=110)
