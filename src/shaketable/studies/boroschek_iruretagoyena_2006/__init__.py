"""Boroschek R., Iruretagoyena A. (2006) Controlled overturning of unanchored rigid bodies,
Earthquake Engng Struct. Dyn. 35(6):695-711: the whole study, with the motions at hand in place of
the paper's 314 records.
"""

from shaketable.studies.boroschek_iruretagoyena_2006.whole import FRICTION, counts, run

__all__ = ["FRICTION", "counts", "run"]
