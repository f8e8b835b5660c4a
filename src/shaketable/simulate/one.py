"""One body under one motion, with its history."""

from __future__ import annotations

import logging
import math
from typing import overload

import numpy as np

from shaketable.body import Body
from shaketable.engine.endings import SENTENCES, Ending
from shaketable.errors import InputError, SimulationError, require_number
from shaketable.language import translated
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.outcome import Outcome, downhill_sign
from shaketable.response import PlanarResponse, Response
from shaketable.simulate.around import held_by, listed_surroundings, warn_of
from shaketable.simulate.checks import require_kind, require_stable, warn
from shaketable.simulate.kinds import kind_of
from shaketable.simulate.one_solid import simulate_solid
from shaketable.simulate.standing import model_for_solids
from shaketable.solid import Solid
from shaketable.solid_response import SolidResponse
from shaketable.support import Support
from shaketable.surroundings import Surroundings

log = logging.getLogger(__name__)


@overload
def simulate(
    body: Body,
    motion: Motion,
    support: Support | None = None,
    *,
    model: Model | str | None = None,
    orientation: float = 0.0,
    initial_rotation: float = 0.0,
    surroundings: Surroundings | None = None,
) -> PlanarResponse: ...


@overload
def simulate(
    body: Solid,
    motion: Motion,
    support: Support | None = None,
    *,
    model: Model | str | None = None,
    orientation: float = 0.0,
    initial_rotation: float = 0.0,
    surroundings: Surroundings | None = None,
) -> SolidResponse: ...


def simulate(
    body: Body | Solid,
    motion: Motion,
    support: Support | None = None,
    *,
    model: Model | str | None = None,
    orientation: float = 0.0,
    initial_rotation: float = 0.0,
    surroundings: Surroundings | None = None,
) -> Response:
    """Shake one body and keep its history.

    Args:
        body: what stands on the support: a Body in the vertical plane of the motion's horizontal
            component, or a Solid in three dimensions under all components.
        motion: ground acceleration, linear between its samples.
        support: its tilt; a level one by default.
        model: `Rocking(...)` (theory, section 2: no sliding, no jump) or `General(...)` (sections
            3 to 6: rest, slide, rock, slide-rock, flight and impacts with friction and
            restitution), or "rocking" or "general" for their defaults; rocking by default, and for
            a Solid, which needs it, general.
        orientation: ψ0 of a Solid on its support at the start, from x toward y [rad].
        initial_rotation: θ [rad] in (-π/2, π/2) at which the body is let go at t = 0.
        surroundings: what stands beside the body and holds it; in the rocking model one wall
            without a gap; nothing by default.

    Raises:
        InputError: anything other than a body and a motion, an unknown model, an
            initial_rotation out of range, or a tilt at which the body falls by itself; a planar
            body on a support that falls toward an azimuth outside its plane; the rocking model or
            a restitution factor with a Solid.
        SimulationError: the general model met a million events in one sample.
    """
    require_kind("motion", motion, Motion)
    support = Support() if support is None else support
    if not isinstance(support, Support):
        raise InputError(f"support must be a Support, such as Support(tilt=0.05); got {support!r}")
    if isinstance(body, Solid):
        around = listed_surroundings([surroundings])
        warn_of(around, model_for_solids(model))
        if initial_rotation != 0.0:
            raise InputError("initial_rotation is of a planar Body; a Solid begins on its base")
        return simulate_solid(
            body, motion, support, model=model, orientation=orientation, surroundings=surroundings
        )
    require_kind("body", body, Body)
    around = listed_surroundings([surroundings])
    if orientation != 0.0:
        raise InputError("orientation is of a Solid; a planar Body has one plane")
    support, model = support.in_plane(), model_of(model)
    require_stable([body], support.tilt)
    require_number("initial_rotation [rad]", initial_rotation)
    if not -math.pi / 2 < initial_rotation < math.pi / 2:
        raise InputError(
            f"initial_rotation [rad] must lie between -π/2 and π/2, got {initial_rotation!r}"
        )
    kind_of(body).require_surroundings([body], around, model, np.array([support.tilt]))
    warn(model, [support.tilt], [motion])
    warn_of(around, model)
    run = model.run_one(body, support.tilt, motion, float(initial_rotation), around[0])
    if run.ending is Ending.UNRESOLVED:
        raise SimulationError(f"{body.name or 'the body'} {SENTENCES[run.ending]}")
    if run.ending in SENTENCES:
        log.warning("%s %s", body.name or "the body", translated(SENTENCES[run.ending]))
    downhill = downhill_sign(support.tilt)
    slips = (abs(run.farthest_left), run.farthest_right)[::downhill]
    return PlanarResponse(
        outcome=Outcome(run.direction * downhill),
        overturning_time=run.overturning_time,
        peak_rotation=run.peak_rotation,
        impacts=run.impact_times.size,
        impact_times=run.impact_times,
        time=run.time,
        rotation=run.rotation,
        angular_velocity=run.angular_velocity,
        position=run.position,
        velocity=run.velocity,
        slip=run.slip,
        displacement_x=run.end_slip,
        slip_downhill=slips[0],
        slip_uphill=slips[1],
        max_lift=run.max_lift,
        ending=run.ending,
        phase_times=run.phase_times,
        phases=run.phases,
        **held_by(run.held),
        fallbacks=run.fallbacks,
        model=model,
        body=body,
        motion=motion,
        support=support,
        surroundings=surroundings,
    )
