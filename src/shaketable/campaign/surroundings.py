"""What surrounds the bodies of a campaign's file, and the mass that straps and pads need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from shaketable.body import Body
from shaketable.campaign.bodies import MOST_NAMED, Bodies, Held
from shaketable.errors import InputError, named
from shaketable.models import Model
from shaketable.simulate.kinds import are_solids
from shaketable.simulate.standing import require_surrounded
from shaketable.spelled_surroundings import metres, read_strap, surroundings_of
from shaketable.surroundings import Surroundings
from shaketable.toml_file import TomlFile

SECTION = "surroundings"
NUMBERS = (
    "wall_gap_mm", "wall_friction", "wall_restitution", "edge_mm", "lip_mm", "pad_n",
)  # fmt: skip
KEYS = ("straps", "mass_kg", *NUMBERS)


def surrounded(
    told: TomlFile,
    bodies: Bodies,
    held: Held,
    orientations: Sequence[float],
    model: Model,
    tilts: Sequence[float],
) -> tuple[Bodies, list[Surroundings | None] | None]:
    """The bodies with their masses, and what surrounds each; the bodies as they are without.

    Args:
        told: the file, in which faults are noted.
        bodies: those that stand.
        held: what surrounds those of an inventory, as it says.
        orientations: in which they stand [rad].
        model: the contact model.
        tilts: of their supports [rad].
    """
    if held:
        return bodies, _of_list(told, bodies, held, orientations, model)
    straps = told.get(SECTION, "straps", list, [])
    mass = told.get(SECTION, "mass_kg", (int, float), None)
    gap, friction, restitution, edge, lip, pad = (
        told.get(SECTION, key, (int, float), None) for key in NUMBERS
    )
    if not straps and gap is None and edge is None and pad is None:
        if told.has(SECTION):
            told.fault(SECTION, "give straps, wall_gap_mm, edge_mm or pad_n")
        return bodies, None
    if told.get("bodies", "inventory", str, None) and not are_solids(bodies):
        if bodies:
            told.fault(SECTION, "an inventory's objects are surrounded as solids: solids = true")
        return bodies, None
    if len(orientations) != 1:
        told.fault("shaking.orientations_deg", "in surroundings one: these do not turn")
        return bodies, None
    if not all(isinstance(text, str) for text in straps):
        told.fault(f"{SECTION}.straps", f"expected texts, found {straps!r}")
        return bodies, None
    heavy: Bodies = []
    around: list[Surroundings | None] = []
    needs = bool(straps) or pad is not None
    try:
        for body in bodies:
            heavy.append(body if body.mass else replace(body, mass=mass))
            own = surroundings_of(
                body,
                *orientations,
                straps=[read_strap(text) for text in straps],
                wall_gap=metres(gap),
                wall_friction=friction,
                wall_restitution=restitution,
                wall_vertical=are_solids(bodies) or model.slides,
                edge=metres(edge),
                lip=metres(lip),
                pull_off=pad,
            )
            around.append(own)
            if own is None or (heavy[-1].mass is None and needs):
                continue
            if isinstance(body, Body):
                for tilt in tilts:
                    model.require_surrounded(heavy[-1], own, tilt)
            else:
                require_surrounded(heavy[-1], own, *orientations)
    except InputError as error:
        told.fault(SECTION, str(error))
        return bodies, None
    unknown = [body.name for body in heavy if body.mass is None]
    if unknown and needs:
        told.fault(SECTION, f"give mass_kg: no mass is known of {named(unknown, MOST_NAMED)}")
    return heavy, around


def _of_list(
    told: TomlFile,
    bodies: Bodies,
    held: Held,
    orientations: Sequence[float],
    model: Model,
) -> list[Surroundings | None] | None:
    """What surrounds each body as its inventory says."""
    if told.has(SECTION):
        told.fault(SECTION, "the inventory has walls, straps or edges of its own: leave this out")
    elif not model.slides:
        told.fault(
            "model.name",
            "the inventory has walls, straps or edges, which are of the general model, or of "
            "solids = true",
        )
    elif len(orientations) != 1:
        told.fault("shaking.orientations_deg", "in surroundings one: these do not turn")
    else:
        found = [held.get(body.name) for body in bodies]
        if not are_solids(bodies):
            return found
        return [around and around.turned(*orientations) for around in found]
    return None
