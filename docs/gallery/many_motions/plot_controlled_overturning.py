"""
Controlled overturning by a tilt
================================

A support that leans by a few degrees chooses the side to which a body falls (Boroschek and
Iruretagoyena 2006). The tilt also makes the fall more likely.
"""

from shaketable import Body, suite
from shaketable.plot import plot_tilt
from shaketable.tilting import design_tilt

shelf = Body.rectangle(0.32, 1.80, name="bookcase")
design = design_tilt(shelf, suite("fema-p695-far-field"), control=0.95, progress=False)
plot_tilt(design)
