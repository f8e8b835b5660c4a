"""The kinds of work that a store may hold, and how one is read from it again."""

from __future__ import annotations

import platform
from typing import TYPE_CHECKING, Any

from shaketable.campaign.assessments import Assessments
from shaketable.campaign.libraries import Libraries
from shaketable.campaign.motions import StoredMotions, save_motions
from shaketable.campaign.objects import Objects
from shaketable.campaign.simulations import Simulations
from shaketable.campaign.work import PLAN, Work
from shaketable.errors import InputError, SimulationError
from shaketable.extras import require
from shaketable.lazy_motions import heads_of

if TYPE_CHECKING:
    from shaketable.campaign.rooms import Rooms

FORMAT = 6
ROOMS = "rooms"  # whose module needs the extra of that name


def kind_of(
    name: str,
) -> type[Simulations] | type[Assessments] | type[Libraries] | type[Rooms]:
    """The kind of work that a plan names.

    Raises:
        KeyError: there is none of that name.
    """
    if name == ROOMS:
        require("rooms", "a campaign of rooms")
        from shaketable.campaign.rooms import Rooms

        return Rooms
    return {kind.kind: kind for kind in (Simulations, Assessments, Libraries)}[name]


def save(work: Work, made: dict[str, Any], objects: Objects) -> None:
    """Write what is to be done, with the hashes of all that it depends on; the plan comes last."""
    save_motions(work.motions, objects)
    save_plan(work, made, objects)


def save_plan(work: Work, made: dict[str, Any], objects: Objects) -> None:
    """Write what is to be done, of motions that are written."""
    objects.put_json(
        PLAN,
        {
            "format": FORMAT,
            "kind": work.kind,
            "fingerprint": made,
            "motions": [head.as_dict() for head in heads_of(work.motions)],
            **work.told(),
        },
    )


def load(
    objects: Objects, told: dict[str, Any], *, check: bool = True
) -> Simulations | Assessments | Libraries | Rooms:
    """The work that a store holds. Its motions are read, and looked at, as they are needed.

    Args:
        objects: of the store.
        told: the parsed PLAN.
        check: whether to compare the hashes of bodies and items.

    Raises:
        SimulationError: something of it is missing or damaged.
    """
    require_format(told, objects)
    try:
        motions = StoredMotions(objects, told["motions"], told["fingerprint"]["motions"])
        return kind_of(told["kind"]).load(told, motions, check)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise SimulationError(
            f"{objects.place}: the campaign's plan is damaged ({error})"
        ) from None


def work_of(
    objects: Objects, *, check: bool = True
) -> Simulations | Assessments | Libraries | Rooms:
    """The work of a store; `check` as for `load`.

    Raises:
        InputError: there is none.
        SimulationError: it is damaged.
    """
    told = objects.get_json(PLAN)
    if told is None:
        raise InputError(f"{objects.place}: no campaign is there")
    return load(objects, told, check=check)


def require_format(told: dict[str, Any], objects: Objects) -> None:
    """SimulationError if a plan was written by a version whose format is another one."""
    if told.get("format") != FORMAT:
        raise SimulationError(
            f"{objects.place}: the campaign was begun by another version of shaketable (its format "
            f"is {told.get('format', 'none')}, this version reads {FORMAT}); begin it anew, with "
            "--fresh or in another store"
        )


def require_environment(told: dict[str, Any]) -> None:
    """SimulationError if the code or the versions here are not those that a plan was made with."""
    there, mine = told["fingerprint"]["environment"], kind_of(told["kind"]).environment()
    if there != mine:
        other = ", ".join(
            f"{name} {mine.get(name)} in place of {value}"
            for name, value in there.items()
            if mine.get(name) != value
        )
        raise SimulationError(f"the worker on {platform.node()} has {other}")
