"""
A bookcase under one record
===========================

A bookcase of 0.32 m × 1.80 m on a shelf that leans by 3°, under a component of the Beverly Hills
record of the 1994 Northridge earthquake. It rocks, and falls downhill.
"""

import numpy as np

from shaketable import Body, Support, simulate, suite

shelf = Body.rectangle(0.32, 1.80, name="bookcase")
motion = suite("fema-p695-far-field")[0]
run = simulate(shelf, motion, Support(tilt=np.radians(3)))
print(f"{run.outcome.name} at {run.overturning_time:.2f} s, after {run.impacts} impacts")

# %%
# The upper picture shows the rotation over time, the lower one the motion of the support.
run.plot()
