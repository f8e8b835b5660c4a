"""Where objects stand: which measures are tried first there, and what counts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from shaketable.assess.ranking import Weights
from shaketable.assess.results import MitigationKind
from shaketable.errors import InputError

STRAP, TETHER, LOCK, BASE, PAD, LOWER, WALL, TURN, MOVE, TILT = MitigationKind


@dataclass(frozen=True, kw_only=True)
class Premises:
    """A kind of building by its use.

    Attributes:
        name: what the command line calls it.
        standing: measures for what stands, in the order in which they are tried.
        rolling: for what stands on castors.
        weights: what counts in the order of objects.
        itself: whether the object is what must survive, so that no fall is accepted anywhere.
    """

    name: str
    standing: Sequence[MitigationKind] = (STRAP, WALL, BASE, LOWER, PAD, MOVE, TURN, TILT)
    rolling: Sequence[MitigationKind] = (LOCK, TETHER, MOVE)
    weights: Weights = field(default_factory=Weights)
    itself: bool = False


#: What may be chosen. None of the orders is measured: they are what is done there.
PREMISES = {
    each.name: each
    for each in (
        Premises(name="hospital"),
        Premises(name="laboratory", standing=(STRAP, PAD, BASE, WALL, LOWER, MOVE, TURN, TILT)),
        Premises(
            name="museum",
            standing=(PAD, LOWER, BASE, STRAP, MOVE, TURN),
            weights=Weights(blocks_exit=1.0, people_nearby=1.0),
            itself=True,
        ),
        Premises(name="office", standing=(STRAP, WALL, LOWER, BASE, MOVE, TURN, TILT, PAD)),
        Premises(name="home", standing=(STRAP, WALL, PAD, LOWER, BASE, TURN, TILT, MOVE)),
    )
}


def kinds_of(names: Sequence[MitigationKind | str]) -> list[MitigationKind]:
    """Kinds of measures by their names; "all" stands for all of them.

    Raises:
        InputError: an unknown name.
    """
    if "all" in names:
        return list(MitigationKind)
    strange = [each for each in names if each not in list(MitigationKind)]
    if strange:
        accepted = ", ".join([*MitigationKind, "all"])
        raise InputError(f"what can be tried is {accepted}; found {str(strange[0])!r:.40}")
    return [kind for kind in MitigationKind if kind in names]


def premises_of(given: Premises | str | None) -> Premises:
    """The premises of a name; those of a hospital if none is given.

    Raises:
        InputError: an unknown name.
    """
    if isinstance(given, Premises):
        return given
    name = given or "hospital"
    if name not in PREMISES:
        raise InputError(f"premises are {', '.join(PREMISES)}; found {given!r:.40}")
    return PREMISES[name]
