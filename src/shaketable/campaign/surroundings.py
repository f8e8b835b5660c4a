"""What surrounds the solids of a campaign's file: walls, straps, and the mass that these need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from shaketable.campaign.bodies import MOST_NAMED, Bodies
from shaketable.errors import InputError, named
from shaketable.simulate.kinds import are_solids
from shaketable.simulate.space_input import require_surrounded
from shaketable.spelled_surroundings import surroundings_of
from shaketable.surroundings import Surroundings
from shaketable.toml_file import TomlFile

SECTION = "surroundings"
KEYS = ("straps", "mass_kg", "wall_gap_mm", "wall_friction", "wall_restitution")


def surrounded(
    told: TomlFile, bodies: Bodies, orientations: Sequence[float]
) -> tuple[Bodies, list[Surroundings] | None]:
    """The bodies with their masses, and what surrounds each; the bodies as they are without.

    Args:
        told: the file, in which faults are noted.
        bodies: those that stand.
        orientations: in which they stand [rad].
    """
    straps = told.get(SECTION, "straps", list, [])
    mass = told.get(SECTION, "mass_kg", (int, float), None)
    gap, friction, restitution = (
        told.get(SECTION, key, (int, float), None)
        for key in ("wall_gap_mm", "wall_friction", "wall_restitution")
    )
    if not straps and gap is None:
        if told.has(SECTION):
            told.fault(SECTION, "give straps, of which there is at least one, or wall_gap_mm")
        return bodies, None
    if not are_solids(bodies):
        if bodies:
            told.fault(SECTION, "is for solids: give depth_m, a shape, or solids = true")
        return bodies, None
    if len(orientations) != 1:
        told.fault("shaking.orientations_deg", "in surroundings one: these do not turn")
        return bodies, None
    if not all(isinstance(text, str) for text in straps):
        told.fault(f"{SECTION}.straps", f"expected texts, found {straps!r}")
        return bodies, None
    heavy: Bodies = []
    around: list[Surroundings] = []
    try:
        for solid in bodies:
            heavy.append(solid if solid.mass else replace(solid, mass=mass))
            own = surroundings_of(
                solid,
                *orientations,
                straps=straps,
                wall_gap=None if gap is None else 1e-3 * gap,
                wall_friction=friction,
                wall_restitution=restitution,
            )
            around.append(own or Surroundings())
            if heavy[-1].mass is not None or not straps:
                require_surrounded(heavy[-1], around[-1], *orientations)
    except InputError as error:
        told.fault(SECTION, str(error))
        return bodies, None
    unknown = [solid.name for solid in heavy if solid.mass is None]
    if unknown and straps:
        told.fault(SECTION, f"give mass_kg: no mass is known of {named(unknown, MOST_NAMED)}")
    return heavy, around
