"""What would help: measures that are tried on an object in three dimensions.

Each is one function of `trials`, which gives the object as it stands after the measure, or nothing
where the measure makes no sense of it; a base is searched for by `larger_base`. `premises` says
which are tried first where, `run` tries them.
"""

from shaketable.assess.leading import LEADING
from shaketable.assess.mitigation.premises import PREMISES, Premises, kinds_of, premises_of
from shaketable.assess.mitigation.run import (
    MOST_TRIED,
    Shaken,
    kinds_for,
    with_mitigation,
    work_of,
)

__all__ = [
    "LEADING",
    "MOST_TRIED",
    "PREMISES",
    "Premises",
    "Shaken",
    "kinds_for",
    "kinds_of",
    "premises_of",
    "with_mitigation",
    "work_of",
]
