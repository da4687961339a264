# The force on a finger that goes into a teapot, in six lines.
import hl, matplotlib.pyplot as plt, numpy as np, sys

teapot = hl.Scene("teapot", size=0.1)  # its largest side is 0.1 m
depth = np.linspace(0.06, 0.0, 1000)  # m: from above the lid down into the pot
felt = hl.trace(teapot, np.column_stack([np.arange(1000) * 1e-3, 0 * depth, depth, 0 * depth]))
plt.plot(1000 * depth, felt.force), plt.legend("xyz"), plt.xlabel("height (mm)"), plt.ylabel("force (N)")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "01_a_force.png")
