"""
Plane or space?
===============

The same footprint under one component in a plane, and under both in space: boxes and cylinders
overturn more often in space.
"""

import matplotlib.pyplot as plt

from shaketable import Body, General, Outcome, Solid, simulate_many, suite

pairs = suite("fema-p695-both-directions", pairs=True)[:24]
model = General(static_friction=0.5)


def share(body):
    runs = simulate_many([body], pairs, model=model, progress=False)
    return 100 * float((runs.outcome != Outcome.STANDING).mean())


base, height = 0.3, 1.2
shares = {
    "plane, one component": share(Body.rectangle(base, height)),
    "box, both components": share(Solid.box(base, base, height)),
    "cylinder, both components": share(Solid.cylinder(base, height)),
}
for name, value in shares.items():
    print(f"{name}: {value:.0f} % of 48 simulations of 24 recordings")

figure, ax = plt.subplots(layout="constrained")
ax.barh(list(shares), list(shares.values()))
ax.set(xlabel="overturns [%]", xlim=(0, 100))
