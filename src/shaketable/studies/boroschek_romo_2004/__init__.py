"""Boroschek R., Romo D. (2004) Overturning criteria for non-anchored non-symmetric rigid bodies,
13th WCEE, paper 295: the whole study, with the motions at hand in place of its 288 records.
"""

from shaketable.studies.boroschek_romo_2004.whole import NAME, run

__all__ = ["NAME", "run"]
