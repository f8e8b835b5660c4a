"""
A sliding block against Newmark
===============================

A low box on a slippery floor slides under a pulse of constant acceleration. Newmark's sliding
block has a closed form for it: while the floor's acceleration A exceeds μg the box slides, and it
comes to rest after a slip of A/(2μg) · (A − μg) · T².
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, General, Motion, simulate

g, friction, duration, step = 9.80665, 0.2, 0.4, 0.001
accelerations = np.linspace(2.5, 8.0, 12)
slips = []
for acceleration in accelerations:
    history = np.zeros(4000)
    history[1 : 1 + round(duration / step)] = acceleration
    run = simulate(
        Body.rectangle(1.0, 0.5), Motion(history, step), model=General(static_friction=friction)
    )
    slips.append(run.peak_slip)

closed = (accelerations / (2 * friction * g)) * (accelerations - friction * g) * duration**2
print(f"largest difference {100 * np.max(np.abs(np.array(slips) / closed - 1)):.2f} %")

figure, ax = plt.subplots()
ax.plot(accelerations, closed, label="Newmark (1965)")
ax.plot(accelerations, slips, "o", ms=4, label="simulated")
ax.set(xlabel="acceleration of the floor [m/s²]", ylabel="slip [m]")
ax.legend()
