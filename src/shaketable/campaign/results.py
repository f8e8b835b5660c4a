"""The results of a campaign, to be read: lazy where they are large."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.campaign import arrays, sketch
from shaketable.campaign.assessments import Assessments
from shaketable.campaign.kinds import work_of
from shaketable.campaign.notes import whole_notes
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import ALL, Plan
from shaketable.campaign.simulations import Simulations
from shaketable.campaign.summary import LEVELS, MOMENTS
from shaketable.errors import InputError, SimulationError
from shaketable.lazy_motions import heads_of
from shaketable.simulate.result_fields import FIELDS
from shaketable.surroundings import told_surroundings

if TYPE_CHECKING:
    import xarray as xr

MEANING = "sums over recordings or events of products of downhill falls d, uphill u, simulations n"


def open_campaign(store: str | Path, *, partial: bool = False, check: bool = True) -> xr.Dataset:
    """Open the results of a campaign as an xarray.Dataset.

    Args:
        store: folder or URL.
        partial: whether a campaign that is not done is opened, too. Its variable `done` says over
            (body, motion) what has been simulated; elsewhere other variables say nothing. Only
            where every simulation is kept.
        check: whether all chunks are read once and held against their checksums; otherwise their
            sizes are.

    Returns:
        Where every simulation is kept, what `simulate_many` returns, read when it is used. Of a
        summary over (body, tilt, scale): falls `downhill` and `uphill` of `simulations`; the sums
        of their squares and products over recordings and events, `moments` (level, moment, ...);
        `peaks`, counts by bin of the peak rotation, whose values [rad] are the coordinate `bin`,
        a fall in the last one; in surroundings how many are `held_up`; and
        `by_recording` (direction, recording, ...) if it was kept.

    Raises:
        InputError: no campaign is there, or it is not done.
        SimulationError: something of it is missing or damaged.
    """
    objects = Objects(store)
    return results_of(simulations_of(objects), objects, partial, check)


def simulations_of(objects: Objects) -> Simulations:
    """The simulations of a store.

    Raises:
        InputError: it holds none.
        SimulationError: the plan is damaged.
    """
    work = work_of(objects)
    if not isinstance(work, Simulations):
        writes = "campaign collect"
        if not isinstance(work, Assessments):
            writes = "room survey, with the same store,"
        raise InputError(
            f"{objects.place}: holds {work.counted} that were assessed, not simulations; "
            f"shaketable {writes} writes their page and tables"
        )
    return work


def results_of(
    work: Simulations, objects: Objects, partial: bool = False, check: bool = True
) -> xr.Dataset:
    """What `open_campaign` returns for work that is known."""
    plan = work.plan
    hint = f"partial=True is for keep={ALL!r}: a summary is whole or nothing" if partial else ""
    notes = whole_notes(work, objects, partial=partial and plan.keep == ALL, check=check, hint=hint)
    if not arrays.is_there(plan, objects):
        raise SimulationError(f"{objects.place}: arrays are missing; run the campaign again")
    if plan.keep == ALL:
        return _of_all(plan, objects, list(notes) if partial else None)
    return _of_summary(plan, objects)


def _of_all(plan: Plan, objects: Objects, some: list[int] | None) -> xr.Dataset:
    import xarray as xr

    found: xr.Dataset = xr.open_zarr(
        arrays.zarr_store(objects), consolidated=False, chunks=None
    ).assign_coords(plan.ensemble.coordinates())
    told = told_surroundings(plan.ensemble.surroundings)
    if told:
        found = found.assign_attrs(surroundings=told)
    if some is None:
        return found
    done = np.zeros((len(plan.ensemble.bodies), len(plan.ensemble.motions)), np.bool_)
    for number in some:
        block = plan.block(number)
        done[block.first_body : block.end_body, block.first_motion : block.end_motion] = True
    return found.assign(done=(("body", "motion"), done))


def _of_summary(plan: Plan, objects: Objects) -> xr.Dataset:
    import xarray as xr

    stored = arrays.opened(plan, objects)
    ensemble = plan.ensemble
    coordinates = ensemble.coordinates()
    names = ("body", "tilt", "scale")
    each = len(ensemble.motions) * ensemble.repeats
    sums = {name: _sum(stored[name]) for name in ("downhill", "uphill", "moments", "peaks")}
    variables: dict[str, Any] = {
        "downhill": (names, sums["downhill"], {"long_name": "falls downhill"}),
        "uphill": (names, sums["uphill"], {"long_name": "falls uphill"}),
        "moments": (("level", "moment", *names), sums["moments"], {"long_name": MEANING}),
        "peaks": ((*names, "bin"), sums["peaks"], {"long_name": "simulations by peak rotation"}),
    }
    if name := ensemble.held_field:
        told = {"long_name": FIELDS[name].meaning}
        variables[name] = (names, _sum(stored[name]), told)
    coordinates |= {
        "level": list(LEVELS),
        "moment": list(MOMENTS),
        "bin": ("bin", sketch.VALUES, {"units": "rad", "long_name": "peak rotation"}),
    }
    if plan.recordings:
        padded = stored["by_recording"]
        counts = [
            padded[part, :, :number] for part, number in enumerate(arrays.recordings_in(plan))
        ]
        along = ("direction", "recording", *names)
        told = {"long_name": "falls of each recording, both polarities together"}
        variables["by_recording"] = (along, np.concatenate(counts, axis=1), told)
        coordinates["direction"] = ["downhill", "uphill"]
        coordinates["recording"] = _names_of_recordings(plan)
    used = {name for variable in variables.values() for name in variable[0]}
    kept = {
        name: value
        for name, value in coordinates.items()
        if name in used or name == "restitution_factor"
    }
    recording, event = plan.sources
    around = told_surroundings(ensemble.surroundings)
    attributes = {
        "model": repr(ensemble.model),
        **({"surroundings": around} if around else {}),
        "simulations": each,
        "recordings": int(np.unique(recording).size),
        "events": int(np.unique(event).size),
    }
    return xr.Dataset(variables, coords=kept, attrs=attributes)


def _sum(array: Any) -> NDArray[np.int64]:
    """Over the parts, one at a time: all of them together may be too many for the memory."""
    total = array[0].astype(np.int64)
    for part in range(1, array.shape[0]):
        total += array[part]
    return np.asarray(total)


def _names_of_recordings(plan: Plan) -> list[str]:
    """Event and station of each recording, or the name of its first motion."""
    found: dict[int, str] = {}
    heads = heads_of(plan.ensemble.motions)
    for number, head in zip(plan.sources.recording.tolist(), heads, strict=True):
        origin = head.origin
        known = origin is not None and origin.event and origin.station
        found.setdefault(
            number, f"{origin.event} {origin.station}" if origin and known else head.name
        )
    return list(found.values())
