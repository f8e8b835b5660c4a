"""What one simulation found, as numbers and as a sentence."""

from __future__ import annotations

import math
from typing import Any

from shaketable.outcome import Outcome, outcome_name
from shaketable.response import PlanarResponse, Response
from shaketable.solid_response import SolidResponse
from shaketable.units import STANDARD_GRAVITY

NOTHING = 1e-6  # m: a smaller slip or lift counts as none
NOTICED = 1e-3  # degrees: a smaller turn counts as none


def summary_of(response: Response) -> dict[str, Any]:
    """Numbers in SI units, for JSON."""
    if isinstance(response, SolidResponse):
        return _of_solid(response)
    assert isinstance(response, PlanarResponse)
    return _of_plane(response)


def sentence_of(response: Response) -> str:
    """What happened, in words."""
    if isinstance(response, SolidResponse):
        return _said_of_solid(response)
    assert isinstance(response, PlanarResponse)
    return _said_of_plane(response)


def _of_plane(response: PlanarResponse) -> dict[str, Any]:
    fell = not math.isnan(response.overturning_time)
    summary: dict[str, Any] = {
        "outcome": response.outcome.name.lower(),
        "overturning_time_s": response.overturning_time if fell else None,
        "peak_rotation_rad": response.peak_rotation,
        "impacts": response.impacts,
    }
    if response.model.slides:
        summary |= {
            "displacement_x_m": response.displacement_x,
            "slip_downhill_m": response.slip_downhill,
            "slip_uphill_m": response.slip_uphill,
            "max_lift_m": response.max_lift,
            "phases": [
                {"start_s": float(start), "phase": phase.name.lower()}
                for start, phase in zip(response.phase_times, response.phases, strict=True)
            ],
        }
        summary |= _held(response)
    return summary


def _held(response: Response) -> dict[str, Any]:
    """What surroundings did, if there are any."""
    held: dict[str, Any] = {"held_up": response.held_up} if response.surroundings else {}
    if response.strap_force:
        broke = [None if math.isnan(each) else each for each in response.strap_broke_at]
        held |= {"strap_force_n": list(response.strap_force), "strap_broke_at_s": broke}
    if response.surroundings and response.surroundings.edge:
        off = response.off_edge
        told = {
            "left_support_at_s": response.left_support_at,
            "landing_time_s": response.landing_time,
            "landing_x_m": response.landing_x,
            "landing_y_m": response.landing_y,
            "landing_speed_m_s": response.landing_speed,
            "landing_rotation_rad": response.landing_rotation,
        }
        held["off_edge"] = off
        held |= {name: None if math.isnan(value) else value for name, value in told.items()}
    return held


def _said_of_plane(response: PlanarResponse) -> str:
    """What happened, in words."""
    peak = math.degrees(response.peak_rotation)
    if not math.isnan(response.overturning_time):
        way = outcome_name(response.outcome, response.support.tilt)
        when = response.overturning_time
        said = f"overturns {way} at {when:.3f} s, after {response.impacts} impacts"
        if response.off_edge:
            said = _fell_off(response, way)
    elif response.held_up:
        said = (
            f"does not fall, but {_held_by(response)} alone keeps it from falling; it rocks by at "
            f"most {peak:.3g}°, with {response.impacts} impacts"
        )
    else:
        rocks = f"rocks by at most {peak:.3g}°, with {response.impacts} impacts"
        said = f"stands; it {rocks if peak > NOTICED else 'does not rock'}"
    if response.peak_slip > NOTHING:
        end = response.displacement_x
        said += f"; it slides by up to {1e3 * response.peak_slip:.3g} mm"
        if math.isnan(response.overturning_time):
            side = "+x" if end > 0 else "-x"
            where = f"{1e3 * abs(end):.3g} mm toward {side}" if abs(end) > NOTHING else "in place"
            said += f" and ends {where}"
    if response.max_lift > NOTHING:
        said += f"; it jumps by up to {1e3 * response.max_lift:.3g} mm"
    return said + _said_of_straps(response)


def _fell_off(response: Response, way: str) -> str:
    """How a body fell off its support."""
    said = f"falls off its support {way}: leaves it at {response.left_support_at:.3f} s"
    if math.isnan(response.landing_time):
        around = response.surroundings
        held = around is not None and bool(around.straps)
        return said + (" and hangs in its straps" if held else "; it was not followed to the floor")
    away = response.landing_x
    if not math.isnan(response.landing_y):
        away = math.hypot(response.landing_x, response.landing_y)
    return (
        f"{said} and comes down at {response.landing_time:.3f} s, {abs(away):.3g} m from where it "
        f"stood, with {response.landing_speed:.3g} m/s"
    )


def _of_solid(response: SolidResponse) -> dict[str, Any]:
    fell = response.outcome is not Outcome.STANDING
    return {
        "outcome": response.outcome.name.lower(),
        "overturning_time_s": response.overturning_time if fell else None,
        "fall_azimuth_rad": response.fall_azimuth if fell else None,
        "pivot_contacts_m": response.body.contacts[list(response.pivot_contacts)].tolist(),
        "peak_rotation_rad": response.peak_rotation,
        "displacement_x_m": response.displacement_x,
        "displacement_y_m": response.displacement_y,
        "yaw_rad": response.yaw,
        "max_lift_m": response.max_lift,
        "impacts": response.impacts,
        "fallbacks": response.fallbacks,
        **_held(response),
    }


def _said_of_solid(response: SolidResponse) -> str:
    """What happened, in words."""
    if response.off_edge:
        way = f"toward {math.degrees(response.fall_azimuth):.0f}°"
        return _fell_off(response, way) + _said_of_straps(response)
    if response.outcome is not Outcome.STANDING:
        said = (
            f"overturns toward {math.degrees(response.fall_azimuth):.0f}° (from +x toward +y) at "
            f"{response.overturning_time:.3f} s, after {response.impacts} impacts"
        )
        over = {0: "", 1: " over a corner", 2: " over a side"}[len(response.pivot_contacts)]
        return said + over + _said_of_straps(response)
    peak = math.degrees(response.peak_rotation)
    leans = f"its axis leans by at most {peak:.3g}°, with {response.impacts} impacts"
    said = f"stands; {leans if peak > 0.0 else 'it does not lean'}"
    if response.held_up:
        said = f"does not fall, but {_held_by(response)} alone keeps it from falling; {leans}"
    x, y = response.displacement_x, response.displacement_y
    far = math.hypot(x, y)
    if far > NOTHING:
        said += f"; it ends {1e3 * far:.3g} mm toward {math.degrees(math.atan2(y, x)):.0f}°"
    turned = math.degrees(response.yaw)
    if abs(turned) > NOTICED:
        said += f", turned by {turned:.3g}°"
    if response.max_lift > NOTHING:
        said += f"; all of its base is off the support by up to {1e3 * response.max_lift:.3g} mm"
    return said + _said_of_straps(response)


def _held_by(response: Response) -> str:
    """What may hold up a body."""
    around = response.surroundings
    wall = "its wall" if around and around.walls else ""
    strap = "its strap" if around and around.straps else ""
    return " or ".join(part for part in (wall, strap) if part)


def _said_of_straps(response: Response) -> str:
    """What each strap bore, in newtons and by the weight, and which broke."""
    said = ""
    weight = (response.body.mass or math.nan) * STANDARD_GRAVITY
    several = len(response.strap_force) > 1
    pulled = zip(response.strap_force, response.strap_broke_at, strict=True)
    for k, (force, broke) in enumerate(pulled, 1):
        which = f"strap {k}" if several else "its strap"
        if math.isnan(broke):
            said += f"; {which} bears up to {force:,.0f} N, {force / weight:.2f} of the weight"
        else:
            said += f"; {which} breaks at {broke:.3f} s, under {force:,.0f} N"
    return said
