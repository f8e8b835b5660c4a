"""
Off the edge of a shelf
=======================

A small object 50 mm from the edge of a shelf slides off it, or trips over the lip that should
hold it.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Edge, General, Outcome, Surroundings, simulate_many, suite

slender = Body.rectangle(0.12, 0.30, name="slender object")
squat = Body.rectangle(0.25, 0.30, name="squat object")
model = General(static_friction=0.2)
motions = suite("near-field-pulse")[:20]
lips = [0.0, 0.002, 0.005, 0.010, 0.020]
figure, ax = plt.subplots()
for body in (slender, squat):
    off, fell = [], []
    for lip in lips:
        edge = Surroundings(edge=Edge(at=body.base / 2 + 0.05, lip=lip))
        runs = simulate_many(
            [body], motions, scales=[2.0], model=model, surroundings=edge, progress=False
        )
        off.append(100 * float(runs.off_edge.mean()))
        fell.append(100 * float((runs.outcome != Outcome.STANDING).mean()))
    print(body.name, "goes off the edge in", np.round(off), "% of the simulations")
    [line] = ax.plot(1000 * np.array(lips), fell, "o-", label=f"{body.name}: falls in any way")
    ax.plot(1000 * np.array(lips), off, "s--", color=line.get_color(), label="goes off the edge")
ax.set(xlabel="lip [mm]", ylabel="simulations [%]", ylim=(0, None))
ax.legend()
