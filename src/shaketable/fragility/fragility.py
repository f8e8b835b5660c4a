"""Fragility functions of bodies from simulations."""

from __future__ import annotations

import logging
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, named, require_not_negative, require_positive
from shaketable.fragility.capacities import ida
from shaketable.fragility.cloud import cloud_from, cloud_of
from shaketable.fragility.counts import Counts, count_stripes
from shaketable.fragility.curve import GROUND, Curve
from shaketable.fragility.intensities import OWN, intensities
from shaketable.fragility.limit_states import OVERTURNS, LimitState
from shaketable.fragility.limit_states import limit_states as states_of
from shaketable.fragility.lognormal import Capacities, Points, fit_capacities, fit_many
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import (
    DRAWS,
    events_of,
    nested_resamples,
    recording_names,
    recordings_of,
)
from shaketable.signal import Measure, measure_named
from shaketable.simulate import listed
from shaketable.simulate.around import Around, listed_surroundings
from shaketable.simulate.checks import numbers, unique_names
from shaketable.surroundings import Surroundings
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

log = logging.getLogger(__name__)

CLOUD, STRIPES, IDA, TRUNCATED_IDA = "cloud", "stripes", "ida", "truncated ida"
METHODS = (CLOUD, STRIPES, IDA, TRUNCATED_IDA)
TAKEN = {CLOUD: ("scales", "runs"), STRIPES: ("levels",), TRUNCATED_IDA: ("highest",)}
_FLOOR = re.compile(r"\bfloor [1-9]|\b\d+(st|nd|rd|th) floor|\broof\b", re.IGNORECASE)


@dataclass(frozen=True, kw_only=True, eq=False)
class Fragility:
    """Fragility functions, one for each body and limit state.

    Attributes:
        curves: body after body, for each the states in the order of their severity as given.
        bodies, states: their names.
        measure: of the motions.
        method: how it was found.
        scales: factors on the motions, or levels of the measure with stripes; none with an IDA.
        model: how bodies were simulated.
        motions: how many.
        tilt: β of the support [rad].
        components: of which the intensities are, as for `with_intensities`.
        polarities: in which motions were used.
        surroundings: of all bodies, or of each; empty where nothing surrounds them.
        through_building: whether the measure is of the ground while the bodies stand on a floor,
            whose motions were given with those of the ground: the building is then in the
            functions.
    """

    curves: tuple[Curve, ...]
    bodies: tuple[str, ...]
    states: tuple[LimitState, ...]
    measure: Measure
    method: str
    scales: NDArray[np.float64]
    model: Model
    motions: int
    tilt: float = 0.0
    components: str = OWN
    polarities: tuple[float, ...] = (1.0, -1.0)
    surroundings: tuple[Surroundings | None, ...] = ()
    through_building: bool = False

    @property
    def curve(self) -> Curve:
        """The only one.

        Raises:
            InputError: there are several.
        """
        if len(self.curves) != 1:
            raise InputError(
                f"there are {len(self.curves)} curves, of {len(self.bodies)} bodies and "
                f"{len(self.states)} limit states: take one of .curves"
            )
        return self.curves[0]

    @property
    def median(self) -> float | NDArray[np.float64]:
        """θ [SI]; of several an array (body, state)."""
        return self._each([one.median for one in self.curves])

    @property
    def beta(self) -> float | NDArray[np.float64]:
        """β; of several an array (body, state)."""
        return self._each([one.beta for one in self.curves])

    @property
    def median_interval(self) -> tuple[float, float] | NDArray[np.float64]:
        """95 % interval of θ; of several an array (body, state, 2)."""
        return self._pairs([one.median_interval for one in self.curves])

    @property
    def beta_interval(self) -> tuple[float, float] | NDArray[np.float64]:
        """95 % interval of β; of several an array (body, state, 2)."""
        return self._pairs([one.beta_interval for one in self.curves])

    def probability(self, levels: ArrayLike) -> NDArray[np.float64]:
        """That the state is reached at levels [SI], (level,); of several (body, state, level)."""
        found = np.array([one.probability(levels) for one in self.curves])
        if len(self.curves) == 1:
            return np.asarray(found[0])
        return found.reshape(len(self.bodies), len(self.states), *found.shape[1:])

    def with_more_beta(self, more: float) -> Fragility:
        """The same with √(β² + more²) for β: for what is not known of the objects.

        Raises:
            InputError: a negative one.
        """
        require_not_negative("more", more)
        curves = tuple(replace(curve, more_beta=more) for curve in self.curves)
        return replace(self, curves=curves)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the functions with their 95 % bands and what they were fitted to; the axes."""
        from shaketable.fragility.drawn import plot_functions

        return plot_functions(self.curves, ax)

    def to_nrml(self, path: str | Path, *, form: str = "continuous") -> None:
        """Write the functions for OpenQuake; see `nrml.write_nrml`."""
        from shaketable.fragility.exported import export_of
        from shaketable.fragility.nrml import write_nrml

        write_nrml(export_of(self), path, form=form)

    def to_pelicun(
        self, folder: str | Path, *, demand: str | None = None, overwrite: bool = False
    ) -> None:
        """Write the functions for pelicun; see `pelicun.write_pelicun`."""
        from shaketable.fragility.exported import export_of
        from shaketable.fragility.pelicun import write_pelicun

        write_pelicun(export_of(self), folder, demand=demand, overwrite=overwrite)

    def _each(self, values: list[float]) -> float | NDArray[np.float64]:
        if len(values) == 1:
            return values[0]
        return np.array(values).reshape(len(self.bodies), len(self.states))

    def _pairs(
        self, values: list[tuple[float, float]]
    ) -> tuple[float, float] | NDArray[np.float64]:
        if len(values) == 1:
            return values[0]
        return np.array(values).reshape(len(self.bodies), len(self.states), 2)

    def table(self) -> pd.DataFrame:
        """A row for each curve, in SI."""
        import pandas as pd

        return pd.DataFrame(
            {
                "body": np.repeat(self.bodies, len(self.states)),
                "limit_state": [one.state.name for one in self.curves],
                "measure": self.measure.name,
                "unit": self.measure.unit,
                "components": self.components,
                "tilt_deg": degrees(self.tilt),
                "method": self.method,
                "median": [one.median for one in self.curves],
                "median_low": [one.median_interval[0] for one in self.curves],
                "median_high": [one.median_interval[1] for one in self.curves],
                "beta": [one.beta for one in self.curves],
                "beta_low": [one.beta_interval[0] for one in self.curves],
                "beta_high": [one.beta_interval[1] for one in self.curves],
                "falls_downhill": [one.falls and one.falls[0] for one in self.curves],
                "falls_uphill": [one.falls and one.falls[1] for one in self.curves],
                "recordings": [one.recordings for one in self.curves],
                "events": [one.events for one in self.curves],
                "recordings_reaching": [one.reached_by for one in self.curves],
                "problem": [one.problem for one in self.curves],
                "caution": [one.caution for one in self.curves],
            }
        )


def fragility(
    bodies: Body | Sequence[Body],
    motions: Sequence[Motion],
    *,
    measure: str = "PGV",
    limit_states: str | Sequence[str] = (OVERTURNS,),
    method: str = CLOUD,
    scales: ArrayLike | None = None,
    levels: ArrayLike | None = None,
    highest: float | None = None,
    runs: xr.Dataset | None = None,
    tilt: float = 0.0,
    polarities: ArrayLike = (1, -1),
    components: str = OWN,
    ground: Sequence[Motion] | None = None,
    model: Model | str | None = None,
    surroundings: Around = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> Fragility:
    """Fit lognormal fragility functions by maximum likelihood.

    The probability that a body reaches a limit state at an intensity x is Φ(ln(x/θ)/β). Baker J.W.
    (2015), Earthquake Spectra 31(1):579-599. Intervals are those of a bootstrap over events, and
    over the recordings of each.

    Args:
        bodies: one or more.
        motions: of several recordings, better of several earthquakes.
        measure: PGA, PGV, SA(1.0), AvgSA(1.0) or another of `intensity_measures`.
        limit_states: "overturns", "uplift", "rocks 0.5 α", "slides 0.1 m".
        method: "cloud" fits all simulations, whatever their intensities; "stripes" scales every
            motion to levels of the measure; "ida" takes the lowest level of each motion that
            overturns, whatever the body survives above it; "truncated ida" the same up to a level.
        scales: of a cloud, factors on the motions. By default they rise by √2 from where fewer
            than 2 % of the simulations reach any state to where more than 98 % reach all: evenly
            spread logarithms weigh all levels alike, and beyond, levels add nothing.
        levels: of stripes, in SI.
        highest: of a truncated IDA, in SI.
        runs: of a cloud, these simulations in place of new ones: what `simulate_many`,
            `run_campaign` or `open_campaign` gives for these bodies and motions with this model.
        tilt: β of the support [rad]; an IDA is on a level one.
        polarities, model, surroundings, progress, threads: as for `simulate_many`.
        components: of the measure, as for `with_intensities`.
        ground: the ground's motion of each of the motions, where these are of floors: then the
            measure is the ground's, as a hazard curve needs it. The floors of a linear building
            grow with the ground.
        draws, seed: of the bootstrap.

    Raises:
        InputError: what `simulate_many` says, an unknown word, or an argument that the method does
            not take.
    """
    bodies = [bodies] if isinstance(bodies, Body) else listed("bodies", bodies, Body)
    motions = listed("motions", motions, Motion)
    states, found, model = states_of(limit_states), measure_named(measure), model_of(model)
    if runs is not None and sorted(np.ravel(polarities).tolist()) != [-1, 1]:
        raise InputError("runs= have polarities of their own; leave polarities=")
    _require_method(
        method, scales=scales, levels=levels, highest=highest, runs=runs, states=states, tilt=tilt
    )
    if method in (IDA, TRUNCATED_IDA) and components != OWN:
        raise InputError(f"method={method!r} scales each component by itself; leave components=")
    if ground is not None:
        ground = listed("ground", ground, Motion)
        if len(ground) != len(motions) or method in (IDA, TRUNCATED_IDA):
            raise InputError(
                f"ground= is one motion for each of the {len(motions)} motions, by cloud or "
                f"stripes; got {len(ground)}, method={method!r}"
            )
    told = motions if ground is None else ground
    recording = recordings_of(motions)
    event = events_of(motions)
    weights = nested_resamples(event, draws, seed)
    about: dict[str, Any] = {
        "measure": found,
        "recording_names": recording_names(told),
        "event": event,
        "place": _place(told),
    }
    around = tuple(each for each in listed_surroundings(surroundings))
    given: dict[str, Any] = {
        "polarities": polarities,
        "model": model,
        "surroundings": surroundings,
        "threads": threads,
    }

    if method in (IDA, TRUNCATED_IDA):
        lowest = ida(bodies, motions, measure, progress=progress, **given)
        factors = np.empty(0)
        curves = []
        for k, body in enumerate(bodies):
            data = _capacities(lowest.isel(body=k), recording, highest)
            fits = fit_capacities(data, weights)
            curves.append(
                Curve(body=body, state=states[0], fits=fits, data=data, falls=None, **about)
            )
    else:
        if levels is not None:
            factors = np.unique(numbers("levels", levels))
            once = intensities(told, found, components=components)[:, 0]
            counts = count_stripes(
                bodies, motions, states, found, once, factors, tilt, progress, given
            )
            im = np.broadcast_to(factors, (len(motions), factors.size))
        else:
            if runs is None:
                counts, factors = cloud_of(
                    bodies, motions, states, scales=scales, tilt=tilt, progress=progress, **given
                )
            else:
                counts, factors = cloud_from(
                    runs, bodies, motions, states, tilt=tilt, model=model, surroundings=around
                )
            im = intensities(told, found, factors, components=components)
        curves = _fitted(counts, bodies, states, im, recording, weights, about)
    for curve in curves:
        if curve.problem or curve.caution:
            log.warning("%s: %s", curve.body.name or "body", curve.problem or curve.caution)
    return Fragility(
        curves=tuple(curves),
        bodies=tuple(unique_names(bodies)),
        states=tuple(states),
        measure=found,
        method=method,
        scales=factors,
        model=model,
        motions=len(motions),
        tilt=tilt,
        components=components,
        polarities=tuple(np.ravel(polarities).tolist()),
        surroundings=around if any(around) else (),
        through_building=ground is not None,
    )


def _fitted(
    counts: Counts,
    bodies: Sequence[Body],
    states: Sequence[LimitState],
    im: NDArray[np.float64],
    recording: NDArray[np.intp],
    weights: NDArray[np.float64],
    about: dict[str, Any],
) -> list[Curve]:
    of_point = np.repeat(recording, im.shape[1])
    trials = np.full(im.size, counts.trials)
    curves = []
    for b, body in enumerate(bodies):
        falls = int(counts.downhill[b].sum()), int(counts.uphill[b].sum())
        for k, state in enumerate(states):
            data = Points(im.ravel(), counts.reached[b, k].ravel(), trials, of_point)
            fits = fit_many(data, weights)
            curves.append(Curve(body=body, state=state, fits=fits, data=data, falls=falls, **about))
    return curves


def _capacities(runs: xr.Dataset, recording: NDArray[np.intp], highest: float | None) -> Capacities:
    """The capacities of a body, cut off at the highest level tried, or the one asked for."""
    level = runs["capacity"].transpose("motion", "polarity").values
    limit = runs["tried"].transpose("motion", "polarity").values
    if highest is not None:
        limit = np.minimum(limit, highest)
    reached = level <= limit
    of_each = np.repeat(recording, level.shape[1])
    return Capacities(np.where(reached, level, limit).ravel(), reached.ravel(), of_each)


def _place(motions: Sequence[Motion]) -> str:
    """Where the motions were recorded, if any of them says that it was on a floor."""
    places = dict.fromkeys(motion.origin.location if motion.origin else "" for motion in motions)
    floors = [place for place in places if _FLOOR.search(place)]
    return named(floors, 3) if floors else GROUND


def _require_method(method: str, states: Sequence[LimitState], tilt: float, **given: Any) -> None:
    """InputError unless a method is known and has what it takes."""
    if method not in METHODS:
        raise InputError(f"method= must be one of {', '.join(METHODS)}, got {method!r}")
    takes = TAKEN.get(method, ())
    for name, value in given.items():
        if value is not None and name not in takes:
            raise InputError(f"{name}= is not for method={method!r}")
    if given["scales"] is not None and given["runs"] is not None:
        raise InputError("runs= have scales of their own; leave scales=")
    if given["highest"] is not None:
        require_positive("highest", given["highest"])
    for name in set(takes) & {"levels", "highest"}:
        if given[name] is None:
            raise InputError(f"method={method!r} takes {name}=, in the measure's SI unit")
    if method in (IDA, TRUNCATED_IDA):
        if [state.kind for state in states] != [OVERTURNS]:
            raise InputError(f"method={method!r} is for the limit state 'overturns' alone")
        if tilt != 0.0:
            raise InputError(f"method={method!r} is for a level support; leave tilt=")
