"""Fragility functions of objects that are not known exactly: how much of β is the object's.

Sizes, losses and friction are drawn from distributions by a Latin hypercube (McKay, Beckman and
Conover 1979), and every drawn object meets every motion. By the law of total variance the variance
of the logarithm of the capacity is the mean of the β² of each object, which is that of the motions,
plus the variance of their ln θ, which is that of the objects.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_number, require_whole
from shaketable.fragility.cloud import TRIED
from shaketable.fragility.curve import Curve
from shaketable.fragility.fragility import Fragility, fragility
from shaketable.fragility.limit_states import OVERTURNS
from shaketable.fragility.lognormal import Points, fit_many
from shaketable.models import General, Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.resampling import DRAWS, events_of, nested_resamples

MEMBERS = 64


@dataclass(frozen=True)
class Uncertain:
    """A quantity by its distribution; make one with `normal`, `lognormal` or `uniform`."""

    kind: str
    first: float
    second: float

    @classmethod
    def normal(cls, mean: float, deviation: float) -> Uncertain:
        """Normal, by its mean and its standard deviation."""
        return cls._of("normal", mean, deviation)

    @classmethod
    def lognormal(cls, median: float, beta: float) -> Uncertain:
        """Lognormal, by its median and the standard deviation of its logarithm."""
        if not median > 0.0:
            raise InputError(f"Uncertain.lognormal: the median must be above 0, got {median!r}")
        return cls._of("lognormal", median, beta)

    @classmethod
    def uniform(cls, low: float, high: float) -> Uncertain:
        """Anything between two ends."""
        if not low <= high:
            raise InputError(f"Uncertain.uniform: {low!r} must not be above {high!r}")
        return cls("uniform", low, high)

    @classmethod
    def _of(cls, kind: str, first: float, second: float) -> Uncertain:
        for value in (first, second):
            require_number(f"Uncertain.{kind}", value)
        if not (math.isfinite(first) and math.isfinite(second) and second >= 0.0):
            raise InputError(
                f"Uncertain.{kind}: finite numbers, the second not below 0, got {first!r} and "
                f"{second!r}"
            )
        return cls(kind, first, second)

    def at(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        """Its quantiles."""
        from scipy.special import ndtri

        if self.kind == "uniform":
            return np.asarray(self.first + (self.second - self.first) * share)
        z = np.asarray(ndtri(share))
        if self.kind == "normal":
            return np.asarray(self.first + self.second * z)
        return np.asarray(self.first * np.exp(self.second * z))


Quantity = float | Uncertain


@dataclass(frozen=True, kw_only=True)
class UncertainBody:
    """A rectangle with uncertain sizes, eccentricity or restitution.

    Attributes:
        base, height: full sizes [m].
        cg_height: of the centre of gravity [m]; half the height by default. The radius of
            gyration stays that of the homogeneous rectangle.
        eccentricity: of its foot from the left corner, over the base.
        restitution_factor: as for `Body`; the model's by default.
        static_friction: of the general model; that of the model by default.
        name: what to call it.
    """

    base: Quantity
    height: Quantity
    cg_height: Quantity | None = None
    eccentricity: Quantity = 0.5
    restitution_factor: Quantity | None = None
    static_friction: Quantity | None = None
    name: str = ""

    def drawn(self, members: int, seed: int = 0) -> list[tuple[Body, float | None]]:
        """Bodies by a Latin hypercube, each with its friction where that is given.

        Raises:
            InputError: a drawn body that cannot be, or no member.
        """
        from scipy.stats import qmc

        require_whole("members", members)
        if seed < 0:
            raise InputError(f"a seed must not be negative, got {seed}")
        given = {
            field.name: getattr(self, field.name) for field in fields(self) if field.name != "name"
        }
        doubtful = [name for name, value in given.items() if isinstance(value, Uncertain)]
        shares = np.full((members, 0), 0.5)
        if doubtful:
            shares = qmc.LatinHypercube(len(doubtful), rng=np.random.default_rng(seed)).random(
                members
            )
        values: dict[str, list[Any]] = {
            name: given[name].at(shares[:, doubtful.index(name)]).tolist()
            if name in doubtful
            else [given[name]] * members
            for name in given
        }
        rows = (dict(zip(values, row, strict=True)) for row in zip(*values.values(), strict=True))
        return [self._body(row) for row in rows]

    def _body(self, row: dict[str, Any]) -> tuple[Body, float | None]:
        try:
            body = Body.rectangle(
                row["base"],
                row["height"],
                eccentricity=row["eccentricity"],
                restitution_factor=row["restitution_factor"],
                name=self.name,
            )
            if row["cg_height"] is not None:
                body = replace(body, cg_height=row["cg_height"])
        except InputError as error:
            raise InputError(f"{self.name or 'an uncertain body'}: drawn as {error}") from None
        return body, row["static_friction"]


@dataclass(frozen=True, kw_only=True, eq=False)
class UncertainFragility:
    """A fragility function of an uncertain object, with β of motions and of the object apart.

    Attributes:
        fragility: of all drawn objects together: what is to be used, drawn and exported.
        medians, betas: θ [SI] and β of each drawn object; NaN where it has none.
    """

    fragility: Fragility
    medians: NDArray[np.float64]
    betas: NDArray[np.float64]

    @property
    def curve(self) -> Curve:
        """The function of all drawn objects together."""
        return self.fragility.curve

    @property
    def beta_motions(self) -> float:
        """The part of β that is the motions': the root mean square of β of each object."""
        return float(np.sqrt(np.nanmean(self.betas**2)))

    @property
    def beta_body(self) -> float:
        """The part of β that is the object's: the standard deviation of ln θ."""
        return float(np.nanstd(np.log(self.medians)))


def uncertain_fragility(
    body: UncertainBody,
    motions: Sequence[Motion],
    *,
    measure: str = "PGV",
    limit_state: str = OVERTURNS,
    scales: ArrayLike = TRIED,
    tilt: float = 0.0,
    model: Model | str | None = None,
    members: int = MEMBERS,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> UncertainFragility:
    """The fragility function of an object of which something is uncertain, by a cloud.

    Args:
        body: the object.
        motions, measure, limit_state, scales, tilt, model, draws, seed, threads: as for
            `fragility`, for one state; scales are the same for all drawn objects.
        members: drawn objects.
        progress: whether to draw a bar.

    Raises:
        InputError: what `fragility` says, drawn bodies that cannot be, or friction for the rocking
            model.
    """
    contact = model_of(model)
    sample = body.drawn(members, seed)
    if body.static_friction is not None and not isinstance(contact, General):
        raise InputError("static_friction= is for the general model: give model=General(...)")
    given: dict[str, Any] = {
        "measure": measure, "limit_states": limit_state, "scales": scales, "tilt": tilt,
        "threads": threads, "draws": 0,
    }  # fmt: skip
    found: list[Fragility] = []
    if body.static_friction is None:
        found = [fragility([one for one, _ in sample], motions, model=contact, **given)]
    else:
        with meter("objects", members, progress) as done:
            for one, friction in sample:
                assert isinstance(contact, General) and friction is not None  # noqa: PT018
                slippery = replace(contact, static_friction=friction, kinetic_friction=None)
                found.append(fragility(one, motions, model=slippery, **given))
                done(1)
    curves = [curve for each in found for curve in each.curves]
    first = curves[0]
    each = [curve.data for curve in curves if isinstance(curve.data, Points)]
    # all of them met the same motions at the same scales
    pooled = each[0]._replace(
        reached=np.sum([points.reached for points in each], axis=0),
        trials=np.sum([points.trials for points in each], axis=0),
    )
    fits = fit_many(pooled, nested_resamples(events_of(motions), draws, seed))
    falls = np.sum([curve.falls for curve in curves if curve.falls], axis=0).tolist()
    pooled_curve = replace(first, fits=fits, data=pooled, falls=(falls[0], falls[1]))
    name = body.name or "uncertain body"
    return UncertainFragility(
        fragility=replace(found[0], curves=(pooled_curve,), bodies=(name,), model=contact),
        medians=np.array([curve.median for curve in curves]),
        betas=np.array([curve.beta for curve in curves]),
    )
