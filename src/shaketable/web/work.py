"""What a worker does in a plane: a rectangle seen from the side, under one component."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from shaketable.assess import Share
from shaketable.body import Body
from shaketable.engine.endings import not_settled
from shaketable.errors import InputError
from shaketable.models import General, Model, Rocking
from shaketable.models.engine_input import substeps
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.report.words.numbers import in_hundred_short, limits_in_hundred
from shaketable.resampling import wilson_interval
from shaketable.simulate import fell, simulate, simulate_many
from shaketable.support import Support
from shaketable.units import degrees, radians
from shaketable.web.answers import Frames, InHundred, Point, ShakenThing, Shares, Worst
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
from shaketable.web.limits import MOST_SLENDER, MOST_STEPS
from shaketable.web.questions import Beside, Many, Shake, Thing
from shaketable.web.shaking import (
    ground_of,
    median_pga,
    motion_of,
    moved_ground,
    recordings,
    rounded,
    suite_of,
)

RATE = 60.0  # pictures a second
MOST_AFTER = 60.0  # s: the film shows no more of what still moves after the motion
CURVE = np.geomspace(0.25, 4.0, 9)  # scales of the fragility curve
SIDES: dict[Outcome, Literal["standing", "left", "right"]] = {
    Outcome.STANDING: "standing",
    Outcome.DOWNHILL: "left",
    Outcome.UPHILL: "right",
}


def shake(asked: Shake) -> ShakenThing:
    """One thing under one motion, with its film."""
    motion = motion_of(asked.shaking).scaled(asked.scale)
    if asked.reverse:
        motion = motion.reversed()
    body, model, support = _body(asked.thing), _model(asked.thing), _support(asked.thing)
    require_few_steps(body, model, support, motion)
    require_mild(asked.thing.beside, [motion])
    held = around(asked.thing.beside, body)
    found = simulate(body, motion, support, model=model, surroundings=held)
    standing = found.outcome is Outcome.STANDING
    moved = found.slip[np.isfinite(found.slip)]
    tilt, farthest = asked.thing.tilt_deg, found.rotation[np.argmax(np.abs(found.rotation))]
    left, right = degrees(body.slenderness_left) - tilt, degrees(body.slenderness_right) + tilt
    at = pictures(float(found.time[-1]), motion.duration)
    return ShakenThing(
        outcome=SIDES[found.outcome],
        moving=not found.settled,
        time_s=None if standing else found.overturning_time,
        peak_deg=degrees(found.peak_rotation),
        tips_at_deg=right if farthest > 0.0 else left,
        slip_m=float(np.abs(moved).max(initial=0.0)),
        lift_m=found.max_lift,
        impacts=found.impacts,
        held_up=found.held_up,
        off_edge=found.off_edge,
        strap_peak=max(found.strap_force) / WEIGHT if found.strap_force else None,
        ground=ground_of(motion),
        frames=Frames(
            rotation_deg=rounded(np.degrees(np.interp(at, found.time, found.rotation))),
            x_m=rounded(np.interp(at, found.time, found.position[:, 0])),
            y_m=rounded(np.interp(at, found.time, found.position[:, 1])),
            ground_m=moved_ground(motion, at),
            strap=strap_at(found.time, found.strap_forces, at),
        ),
    )


def pictures(end: float, duration: float) -> NDArray[np.float64]:
    """The times of the pictures of a film [s].

    Args:
        end: when the simulation ends [s].
        duration: of the motion [s].
    """
    last = min(end, duration + MOST_AFTER)
    return np.minimum(np.arange(math.floor(last * RATE) + 1) / RATE, last)


def many(asked: Many) -> Shares:
    """One thing under a suite, and how its falls grow with the strength of the motions."""
    motions, tilt = suite_of(asked.suite), radians(asked.thing.tilt_deg)
    body = _body(asked.thing)
    require_mild(asked.thing.beside, motions, asked.scale)
    scales = scales_of(asked.scale, asked.curve, asked.thing.beside)
    runs = (
        simulate_many(
            [body],
            motions,
            tilts=[tilt],
            scales=np.unique(scales),
            polarities=(1, -1),
            model=_model(asked.thing),
            surroundings=around(asked.thing.beside, body),
            progress=check,
            threads=1,
        )
        .isel(body=0, tilt=0)
        .sel(scale=scales)
    )
    found = points(runs, recordings(motions))
    now = runs.isel(scale=0)
    return Shares(
        simulations=now.outcome.size,
        recordings=recordings(motions),
        falls=int(fell(now).sum()),
        moving=int(not_settled(now.ending.values).sum()),
        held_up=count_of(now, "held_up"),
        strap_90=strap_share_of(now),
        left=int((now.outcome == Outcome.DOWNHILL).sum()),
        share=found[0].share,
        low=found[0].low,
        high=found[0].high,
        in_100=in_hundreds(Share(found[0].share, found[0].low, found[0].high)),
        median_pga_g=asked.scale * median_pga(motions),
        worst=worst_of(runs),
        curve=found[1:],
    )


def scales_of(
    scale: float, curve: bool, beside: Beside | None, in_space: bool = False
) -> NDArray[np.float64]:
    """The strength that was asked for, and those of the curve: fewer where each takes longer."""
    others = CURVE[::2] if in_space else CURVE
    if beside:  # what is held bangs for long under the strongest
        others = CURVE[:-1:2] if beside.strap_slack_mm is None else CURVE[:5:2]
    return np.array([scale, *others.tolist()] if curve else [scale])


def points(runs: xr.Dataset, independent: int) -> list[Point]:
    """The share of falls at each scale, with its interval of so many independent recordings.

    What its wall or strap alone holds up counts as fallen.
    """
    fallen = fell(runs) | runs["held_up"] if "held_up" in runs else fell(runs)
    shares = fallen.mean([each for each in fallen.dims if each != "scale"])
    return [
        Point(scale=scale, share=share, low=float(low), high=float(high))
        for scale, share in zip(runs.scale.values.tolist(), shares.values.tolist(), strict=True)
        for low, high in [wilson_interval(share, independent)]
    ]


def in_hundreds(share: Share) -> InHundred:
    """A share as every view of it writes it."""
    low, high = limits_in_hundred(share)
    return InHundred(share=in_hundred_short(share.value), low=low, high=high)


def worst_of(runs: xr.Dataset) -> Worst:
    """The shaking that overturns at the most scales; of several, the one that turns it farthest.

    Turned is what counts at the first scale, and where it falls at that, how soon it falls.
    """
    falls = fell(runs)
    first = runs.isel(scale=0)
    sooner = -first.overturning_time.where(falls.isel(scale=0), 1e9)
    order = np.lexsort(
        [each.values.ravel() for each in (sooner, first.peak_rotation, falls.sum("scale"))]
    )
    motion, polarity = np.unravel_index(order[-1], first.outcome.shape)
    return Worst(
        name=str(runs.motion.values[motion]), reverse=bool(runs.polarity.values[polarity] < 0)
    )


def _body(thing: Thing) -> Body:
    """The thing, with the radius of gyration of a homogeneous rectangle.

    Raises:
        InputError: it falls by itself.
    """
    require_proportions(thing.height_m, thing.base_m)
    body = Body(
        base=thing.base_m,
        cg_height=thing.cg_share * thing.height_m,
        left=thing.eccentricity * thing.base_m,
        gyration_radius=math.hypot(thing.base_m, thing.height_m) / math.sqrt(12.0),
        height=thing.height_m if thing.beside else None,
        mass=MASS if thing.beside else None,
    )
    require_upright(thing.tilt_deg, degrees(body.slenderness_left))
    return body


def require_proportions(height: float, *widths: float) -> None:
    """InputError for a needle or a sheet, which takes minutes and tells nothing of objects."""
    for width in widths:
        if max(height / width, width / height) > MOST_SLENDER:
            raise InputError(
                f"{width:g} m wide and {height:g} m high is no object that stands free; one side "
                f"is at most {MOST_SLENDER:g} times the other"
            )


def require_few_steps(body: Body, model: Model, support: Support, motion: Motion) -> None:
    """InputError for so small a thing under so strong a motion that one run takes long."""
    blocks = model.tabulate([body], np.array([support.tilt])).blocks
    steps = int(substeps(blocks, motion)[0]) * motion.horizontal.size
    if steps > MOST_STEPS:
        raise InputError(
            f"so small a thing takes {steps:,} steps through this motion; at most {MOST_STEPS:,} "
            "are taken here. Ask for a larger thing, a weaker or a shorter motion, or simulate it "
            "with the package"
        )


def require_upright(tilt_deg: float, limit_deg: float) -> None:
    """InputError in a visitor's words if a thing falls without any earthquake."""
    if tilt_deg >= limit_deg:
        raise InputError(
            f"on a floor tilted by {tilt_deg:g}° it falls without any earthquake; it stands below "
            f"{limit_deg:.3g}°"
        )


def _support(thing: Thing) -> Support:
    return Support(tilt=radians(thing.tilt_deg))


def _model(thing: Thing) -> Model:
    if thing.friction is None:
        return General(static_friction=math.inf) if thing.beside else Rocking()
    return General(static_friction=thing.friction)
