"""What 65536 fingers feel at once: the force over a teapot when all are pressed down by 1 mm."""
# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import hl

scene = hl.Scene("teapot", size=0.1)
print(scene)

# %% A finger for each pixel begins above the scene.
low, high = scene.bounds
side = 256
x, z = np.meshgrid(np.linspace(low[0], high[0], side), np.linspace(low[2], high[2], side), indexing="ij")
above = np.column_stack([x.ravel(), np.full(x.size, high[1] + 0.01), z.ravel()])
fingers = hl.Fingers(scene, len(above), hl.Settings(radius=0.0005, spring=500.0, smooth=True))
fingers.step(above)

# %% All go down, one tick for each 0.5 mm; a finger stops where its proxy has stayed behind by 1 mm.
positions = above.copy()
for _ in range(int((high[1] - low[1] + 0.02) / 0.0005)):
    felt = fingers.step(positions)
    moving = felt.proxy[:, 1] - positions[:, 1] < 0.001
    positions[moving, 1] -= 0.0005
touching = np.linalg.norm(felt.force, axis=1) > 0
print(f"{np.count_nonzero(touching)} of {len(above)} fingers touch")

# %% The height of each proxy, and the direction of its force as a colour.
height = np.where(touching, felt.proxy[:, 1], np.nan).reshape(side, side)
size = np.linalg.norm(felt.force, axis=1, keepdims=True)
direction = np.divide(felt.force, size, out=np.zeros_like(felt.force), where=size > 0)
colour = np.where(touching[:, None], 0.5 + 0.5 * direction[:, [0, 2, 1]], 1.0).reshape(side, side, 3)
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2))
extent = 1000 * np.array([low[0], high[0], low[2], high[2]])
image = left.imshow(1000 * height.T, extent=extent, origin="lower", cmap="viridis")
figure.colorbar(image, ax=left, label="height of the proxy (mm)", shrink=0.8)
right.imshow(colour.transpose(1, 0, 2), extent=extent, origin="lower")
right.set_title("direction of the force")
for axes in (left, right):
    axes.set_xlabel("x (mm)"), axes.set_ylabel("z (mm)")
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "02_many_fingers.png", dpi=110)
