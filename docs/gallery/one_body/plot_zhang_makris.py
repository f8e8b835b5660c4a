"""
Overturning borders of Zhang and Makris
=======================================

Zhang and Makris (2001) showed that a block overturns under a one-cycle sine pulse in two ways:
with an impact or without one. Between both there is a bay of pulses that the block survives,
although a weaker pulse overturns it.
"""

import numpy as np

from shaketable import Body, overturning_spectrum
from shaketable.fragility import borders
from shaketable.plot import plot_overturning_spectrum

block = Body.rectangle(0.5, 2.0, name="block")
axis = np.linspace(0.1, 10.0, 150)  # ωp/p and ap/(α g)
spectrum = overturning_spectrum(block, pulse="sine", frequencies=axis, amplitudes=axis)

# %%
# Each point is a simulation; lines are borders that were found by bisection.
plot_overturning_spectrum(spectrum, borders(block, spectrum))
