"""What a worker does in three dimensions: a box or a cylinder under both horizontal components."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal, get_args

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from shaketable.assess import Share
from shaketable.assess.stood import turns_of
from shaketable.body import Body
from shaketable.engine.endings import not_settled
from shaketable.errors import InputError
from shaketable.inventory import BaseShape, Item, solid_of
from shaketable.models import General
from shaketable.outcome import Outcome
from shaketable.simulate import fell, simulate, simulate_many
from shaketable.simulate.standing import standing_limit
from shaketable.solid import Solid
from shaketable.solid_response import SolidResponse
from shaketable.support import Support
from shaketable.units import degrees, radians
from shaketable.web.answers import FramesInSpace, ShakenInSpace, SharesInSpace
from shaketable.web.beside import (
    MASS,
    WEIGHT,
    around,
    count_of,
    require_mild,
    strap_at,
    strap_share_of,
)
from shaketable.web.budget import check
from shaketable.web.questions import ManyInSpace, ShakeInSpace, Upright
from shaketable.web.shaking import (
    ground_of,
    median_pga,
    moved_ground,
    pair_of,
    pairs_of,
    recordings,
)
from shaketable.web.work import (
    in_hundreds,
    pictures,
    points,
    require_proportions,
    require_upright,
    scales_of,
    worst_of,
)

MILLI = 1e-3
Side = Literal["back", "left", "front", "right"]  # quarters, from +x toward +y
#: Of the base: what resists rolling by more is no friction, but another shape.
MOST_LENGTH = 0.2


def shake(asked: ShakeInSpace) -> ShakenInSpace:
    """One solid under one motion, with its film."""
    motion = pair_of(asked.shaking).scaled(asked.scale)
    if asked.reverse:
        motion = motion.reversed()
    solid, thing = _solid(asked.thing), asked.thing
    require_mild(thing.beside, [motion])
    found = simulate(
        solid,
        motion,
        Support(tilt=radians(thing.tilt_deg)),
        model=_model(thing),
        orientation=radians(thing.facing_deg),
        surroundings=around(thing.beside, solid, radians(thing.facing_deg)),
    )
    standing = found.outcome is Outcome.STANDING
    return ShakenInSpace(
        outcome="standing" if standing else _side(found.fall_azimuth),
        moving=not found.settled,
        time_s=None if standing else found.overturning_time,
        fall_azimuth_deg=None if standing else degrees(found.fall_azimuth),
        peak_deg=degrees(found.peak_rotation),
        tips_at_deg=degrees(solid.least_slenderness) - thing.tilt_deg,
        moved_m=float(math.hypot(found.displacement_x, found.displacement_y)),
        turned_deg=degrees(found.yaw),
        lift_m=found.max_lift,
        impacts=found.impacts,
        held_up=found.held_up,
        off_edge=found.off_edge,
        strap_peak=max(found.strap_force) / WEIGHT if found.strap_force else None,
        components=1 if motion.transverse is None else 2,
        ground=ground_of(motion),
        frames=_frames(found),
    )


def many(asked: ManyInSpace) -> SharesInSpace:
    """One solid under the pairs of a suite, and how its falls grow with their strength.

    It is turned to the motions with its support, as an assessment turns what it does not know the
    direction of: the share is the same.
    """
    motions, solid, thing = pairs_of(asked.suite), _solid(asked.thing), asked.thing
    require_mild(thing.beside, motions, asked.scale)
    alone = thing.tilt_deg == 0.0 and thing.beside is None
    # of what stands alone it is the solid of an assessment, to the digit
    own, facing = (_as_listed(thing), 0.0) if alone else (solid, radians(thing.facing_deg))
    # what is held takes several times as long: in half of the ways, as the first measure of an item
    turns = turns_of(own, alone)[:: 2 if thing.beside else 1]
    scales = scales_of(asked.scale, asked.curve, thing.beside, in_space=True)
    each = [
        simulate_many(
            [own],
            motions,
            tilts=[radians(thing.tilt_deg)],
            scales=np.unique(scales),
            polarities=(1, -1),
            azimuth=math.pi + turn,
            orientations=[facing + turn],
            model=_model(thing),
            surroundings=around(thing.beside, own, facing + turn),
            progress=check,
            threads=1,
        ).isel(body=0, tilt=0, orientation=0, drop=True)
        for turn in turns.tolist()
    ]
    runs = xr.concat(each, dim=xr.DataArray(turns, dims="turn", name="turn")).sel(scale=scales)
    found = points(runs, recordings(motions))
    now = runs.isel(scale=0)
    # turned on the floor, it falls to other sides of the room
    turned = radians(thing.facing_deg) if alone else 0.0
    toward = (now.fall_azimuth - now.turn + turned).values[fell(now).values]
    sides = [_side(azimuth) for azimuth in toward.tolist()]
    return SharesInSpace(
        simulations=now.outcome.size,
        recordings=recordings(motions),
        falls=len(sides),
        sides={side: sides.count(side) for side in get_args(Side)},
        moving=int(not_settled(now.ending.values).sum()),
        held_up=count_of(now, "held_up"),
        strap_90=strap_share_of(now),
        share=found[0].share,
        low=found[0].low,
        high=found[0].high,
        in_100=in_hundreds(Share(found[0].share, found[0].low, found[0].high)),
        median_pga_g=asked.scale * median_pga(motions),
        worst=worst_of(runs.isel(turn=_as_drawn(thing, turns) if alone else 0)),
        curve=found[1:],
    )


def _as_listed(thing: Upright) -> Solid:
    """The thing as the solid that stands for a row of a list."""
    front, across = (
        replace(Body.rectangle(base, thing.height_m), cg_height=thing.cg_share * thing.height_m)
        for base in thing.bases
    )
    box = thing.shape == "box"
    item = Item(
        body=front,
        sideways=across,
        height=thing.height_m,
        shape=BaseShape.BOX if box else BaseShape.CYLINDER,
        rolling_friction=MILLI * thing.rolling_friction_mm,
        contour_friction=0.0 if box else MILLI * thing.contour_friction_mm,
    )
    solid = solid_of(item, 0.0)
    assert solid is not None
    return solid


def _as_drawn(thing: Upright, turns: NDArray[np.float64]) -> int:
    """Which of its turns is nearest to how the page draws it, its depth along the motion."""
    off = turns - radians(thing.facing_deg)
    return int(np.abs(np.sin(off)).argmin())


def _side(azimuth: float) -> Side:
    """The side of the room within 45° of an azimuth."""
    found: Side = get_args(Side)[round(azimuth / (math.pi / 2)) % 4]
    return found


def _solid(thing: Upright) -> Solid:
    cg_height = thing.cg_share * thing.height_m
    require_proportions(thing.height_m, *thing.bases)
    for name in ("rolling_friction_mm", "contour_friction_mm"):
        most = 1000 * MOST_LENGTH * min(thing.bases)
        if getattr(thing, name) > most:
            raise InputError(f"{name} is at most {MOST_LENGTH:g} of the base, {most:.3g} mm here")
    if thing.shape == "box":
        if thing.contour_friction_mm:
            raise InputError("contour_friction_mm is of the rim of a cylinder")
        box = Solid.box(
            *thing.bases,
            thing.height_m,
            cg_height=cg_height,
            rolling_friction=MILLI * thing.rolling_friction_mm,
            mass=MASS,
        )
        return _upright(thing, box)
    drum = Solid.cylinder(
        thing.bases[0],
        thing.height_m,
        cg_height=cg_height,
        rolling_friction=MILLI * thing.rolling_friction_mm,
        contour_friction=MILLI * thing.contour_friction_mm,
        mass=MASS,
    )
    return _upright(thing, drum)


def _upright(thing: Upright, solid: Solid) -> Solid:
    downhill = math.pi - radians(thing.facing_deg)  # in the solid's own frame
    require_upright(thing.tilt_deg, degrees(standing_limit(solid, downhill)))
    return solid


def _model(thing: Upright) -> General:
    return General(static_friction=math.inf if thing.friction is None else thing.friction)


def _frames(found: SolidResponse) -> FramesInSpace:
    """The histories, at the times of the pictures."""
    from scipy.spatial.transform import Rotation, Slerp

    at = pictures(float(found.time[-1]), found.motion.duration)
    turned = Slerp(found.time, Rotation.from_quat(found.quaternions))(at).as_quat()
    position = np.column_stack([np.interp(at, found.time, each) for each in found.position.T])
    forces = found.strap_forces
    ground = [moved_ground(found.motion, at, transverse) for transverse in (False, True)]
    return FramesInSpace(
        quaternion=_rows(turned),
        position_m=_rows(position),
        ground_m=list(zip(*ground, strict=True)),
        strap=strap_at(found.time, forces, at),
    )


def _rows(values: NDArray[np.float64]) -> list[tuple[float, ...]]:
    return [tuple(row) for row in np.round(values, 6).tolist()]
