"""
A strap that breaks
===================

A bookcase of 100 kg with a strap from its top to the wall behind it. A strap that bears less than
the bookcase pulls breaks, and then the bookcase falls as without one.
"""

import matplotlib.pyplot as plt

from shaketable import General, Solid, Strap, Surroundings, Wall, simulate, suite

shelf = Solid.box(0.32, 0.80, 1.80, mass=100, name="bookcase")
shaking = suite("fema-p695-both-directions", pairs=True)[3]
figure, ax = plt.subplots()
for strength in (float("inf"), 400.0):
    strap = Strap(
        point=(0.16, 0, 1.8), anchor=(0.21, 0, 1.8), stiffness=50e3, slack=0.005, strength=strength
    )
    held = Surroundings(walls=(Wall(gap=0.05),), straps=(strap,))
    run = simulate(shelf, shaking, model=General(static_friction=0.5), surroundings=held)
    print(f"strength {strength:g} N: {run.outcome.name}, largest force {run.strap_force[0]:.0f} N")
    if strength < run.strap_force[0] + 1.0:
        print(f"the strap breaks at {run.strap_broke_at[0]:.2f} s")
    ax.plot(run.time, run.strap_forces[:, 0], lw=0.8, label=f"strength {strength:g} N")
ax.set(xlabel="time [s]", ylabel="force of the strap [N]", xlim=(0, 20))
ax.legend()
