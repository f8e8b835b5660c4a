"""Published criteria, one per file; all quantities are in SI.

A file is one published model: its reference in the docstring, the range in which it holds as data,
tests with numbers whose source is named. Criteria know nothing of studies.

Functions of one name in several of them are reached through their file:
`criteria.kaneko_hayashi_2004.overturning_ratio`.
"""

from shaketable.criteria import (
    boroschek_iruretagoyena_2006,
    boroschek_romo_2004,
    cimellaro_2020,
    housner_1963,
    ishiyama_1982,
    kaneko_hayashi_2004,
    psycharis_1990,
    shaketable_2026,
    shaketable_2026_floors,
    shenton_1996,
)
from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    gcor,
    scor,
    slide_acceleration,
    tilt_for,
    uplift_acceleration,
)
from shaketable.criteria.boroschek_romo_2004 import energy_kept, friction_needed
from shaketable.criteria.kaneko_hayashi_2004 import risk_class
from shaketable.criteria.overturning import scores, verdicts
from shaketable.criteria.psycharis_1990 import StackMode, stack_borders, stack_mode
from shaketable.criteria.shenton_1996 import Mode, initial_mode, thresholds
from shaketable.criteria.verdict import Verdict

__all__ = [
    "Mode",
    "StackMode",
    "Verdict",
    "boroschek_iruretagoyena_2006",
    "boroschek_romo_2004",
    "cimellaro_2020",
    "energy_kept",
    "friction_needed",
    "gcor",
    "housner_1963",
    "initial_mode",
    "ishiyama_1982",
    "kaneko_hayashi_2004",
    "psycharis_1990",
    "risk_class",
    "scor",
    "scores",
    "shaketable_2026",
    "shaketable_2026_floors",
    "shenton_1996",
    "slide_acceleration",
    "stack_borders",
    "stack_mode",
    "thresholds",
    "tilt_for",
    "uplift_acceleration",
    "verdicts",
]
