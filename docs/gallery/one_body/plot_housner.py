"""
Housner's rocking period
========================

Housner (1963) found the quarter period of a slender block that rocks freely. The block is released
here at a part of its slenderness angle; the simulated time to the first impact is compared with his
formula.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Motion, simulate

block = Body.rectangle(0.2, 2.0, name="slender block")
alpha = block.slenderness_left
half_diagonal = np.hypot(0.1, 1.0)
p = np.sqrt(3 * 9.80665 / (4 * half_diagonal))  # the frequency parameter [1/s]
still = Motion(np.zeros(2000), 0.01)

ratios = np.linspace(0.05, 0.98, 25)
quarter = []
for ratio in ratios:
    run = simulate(block, still, initial_rotation=ratio * alpha)
    quarter.append(run.impact_times[0])  # from the release to the first impact

# %%
# Housner's quarter period is arccosh(1 / (1 − θ₀/α)) / p. It grows without bound as the release
# angle approaches the slenderness. His equation takes sin α as α, which is the difference in the
# last digits.
formula = np.arccosh(1 / (1 - ratios)) / p
for ratio, simulated, closed in zip(ratios[::6], quarter[::6], formula[::6], strict=True):
    print(f"θ₀/α = {ratio:.2f}: {simulated:.4f} s, Housner {closed:.4f} s")

figure, ax = plt.subplots()
ax.plot(ratios, formula, label="Housner (1963)")
ax.plot(ratios, quarter, "o", ms=4, label="simulated")
ax.set(xlabel="release angle over slenderness θ₀/α", ylabel="time to the first impact [s]")
ax.legend()
