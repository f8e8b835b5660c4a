"""
Incremental dynamic analysis
============================

Each motion is scaled up until the bookcase falls. The lowest such level is the capacity under
that motion; a stronger shaking may be survived again, which is why a cloud of simulations, and
not an IDA, gives the probability of a fall.
"""

from shaketable import Body, ida, suite
from shaketable.plot import plot_capacities

runs = ida(Body.rectangle(0.32, 1.80), suite("fema-p695-far-field"), "PGV")
print(f"median capacity {100 * float(runs.capacity.median()):.0f} cm/s")

plot_capacities(runs, 100.0, "cm/s")
