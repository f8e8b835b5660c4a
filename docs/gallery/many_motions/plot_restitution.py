"""
What impacts lose
=================

An ideal impact leaves the angular velocity that the conservation of angular momentum gives. Tests
on granite find 0.60 to 0.98 of it. What impacts lose more changes how often a bookcase falls.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Outcome, Rocking, simulate_many, suite

shelf = Body.rectangle(0.32, 1.80, name="bookcase")
motions = suite("fema-p695-far-field")
factors = np.linspace(0.6, 1.0, 9)
shares = []
for factor in factors:
    runs = simulate_many([shelf], motions, model=Rocking(restitution_factor=factor), progress=False)
    shares.append(100 * float((runs.outcome != Outcome.STANDING).mean()))

figure, ax = plt.subplots()
ax.plot(factors, shares, "o-")
ax.set(
    xlabel="velocity after an impact over the ideal one",
    ylabel="overturns [% of 88 simulations]",
    ylim=(0, 100),
)
print(f"{shares[0]:.0f} % at 0.6, {shares[-1]:.0f} % at 1.0")
