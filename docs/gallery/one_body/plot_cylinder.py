"""
A cylinder that wobbles
=======================

A gas cylinder of 0.23 m × 1.50 m under half of both horizontal components of a record. A body on
a round base does not rock to and fro: it rolls around on its rim.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import General, Solid, simulate, suite

gas = Solid.cylinder(0.23, 1.50, rolling_friction=0.003, name="gas cylinder")
shaking = suite("fema-p695-both-directions", pairs=True)[14].scaled(0.5)
run = simulate(gas, shaking, model=General(static_friction=0.5))
print(f"{run.outcome.name}, leaned by up to {np.degrees(run.peak_rotation):.1f}°")

# %%
# The point that its axis draws, seen from above, and how far it leans.
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
left.plot(100 * run.axis[:, 0], 100 * run.axis[:, 1], lw=0.8)
left.set(xlabel="x component of the axis [%]", ylabel="y component of the axis [%]", aspect="equal")
right.plot(run.time, np.degrees(run.nutation))
right.set(xlabel="time [s]", ylabel="lean of the axis [°]")
