"""
Does it slide or rock first?
============================

How a body at rest begins to move is decided by the acceleration of the support and by friction
(Shenton 1996; Boroschek and Romo 2004). Areas are the published criteria, points are simulated.
"""

from shaketable import Body
from shaketable.modes import map_modes
from shaketable.plot import plot_modes

cart = Body.rectangle(0.38, 0.90, name="cart")
plot_modes(map_modes(cart, 1, friction=0.45, kinetic_ratio=0.9), 0.45)
