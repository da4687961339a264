# The force on a finger that goes into a teapot, in six lines.
import hl, matplotlib.pyplot as plt, numpy as np, sys

teapot = hl.Scene("teapot", size=0.1)  # its largest side is 0.1 m
y = np.linspace(0.03, 0.012, 1000)  # m: from above the lid down into the pot, beside the knob
felt = hl.trace(teapot, np.column_stack([np.arange(1000) * 1e-3, 0 * y + 0.01, y, 0 * y]))
plt.plot(1000 * y, felt.force), plt.legend("xyz"), plt.xlabel("height (mm)"), plt.ylabel("force (N)")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "01_a_force.png")
