"""
One-sided rocking against a wall
================================

A block that stands against a wall can rock away from it only, and strikes the wall with its back
when it returns. Each return leaves the share e of its angular velocity.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Motion, Rocking, Surroundings, Wall, simulate

block = Body.rectangle(0.4, 2.0, name="block")
still = Motion(np.zeros(1200), 0.01)
figure, ax = plt.subplots()
for restitution in (0.9, 0.7, 0.5):
    wall = Surroundings(walls=(Wall(restitution=restitution),))
    run = simulate(
        block,
        still,
        model=Rocking(),
        surroundings=wall,
        initial_rotation=-0.6 * block.slenderness_left,
    )
    times = np.diff(run.impact_times[:4])
    print(f"e = {restitution}: {run.impacts} impacts, the first ones {times.round(3)} s apart")
    ax.plot(run.time, np.degrees(run.rotation), label=f"e = {restitution}")
ax.set(xlabel="time [s]", ylabel="rotation away from the wall [°]", xlim=(0, 8))
ax.legend()
