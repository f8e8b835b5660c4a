"""
How far from the wall?
======================

A bookcase near a wall falls less often than one that stands alone, as long as the gap is small.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, General, Outcome, Surroundings, Wall, simulate_many, suite
from shaketable.resampling import wilson_interval

shelf = Body.rectangle(0.32, 1.80, name="bookcase")
model = General(static_friction=0.5)
motions = suite("near-field-pulse")[:16]
gaps = [0.005, 0.02, 0.05, 0.1, 0.2]


def share(surroundings):
    runs = simulate_many([shelf], motions, model=model, surroundings=surroundings, progress=False)
    return 100 * float((runs.outcome != Outcome.STANDING).mean())


alone = share(None)
beside = [
    share(Surroundings(walls=(Wall(gap=gap, friction=0.3, restitution=0.3),))) for gap in gaps
]
for name, found in (("alone", alone), ("at 5 mm", beside[0]), ("at 200 mm", beside[-1])):
    low, high = wilson_interval(found / 100, 8)  # 16 components of 8 recordings
    print(f"{name}: {found:.0f} % ({100 * low:.0f} to {100 * high:.0f})")

figure, ax = plt.subplots()
ax.semilogx(1000 * np.array(gaps), beside, "o-", label="beside a wall")
ax.axhline(alone, color="0.5", ls="--", label="alone")
ax.set(xlabel="gap [mm]", ylabel="overturns [% of 32 simulations]", ylim=(0, 100))
ax.legend()
