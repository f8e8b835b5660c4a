"""Shares of falls as probabilities: the motion is uncertain, and so is the object.

A share counts how many motions overturn an object of exactly these sizes. Contents shift its centre
of gravity, feet stand in from its edges, a floor leans. Here each object stands for many like it,
and its share becomes the probability that one of them falls under one of the motions. Which matters
more is told by the variances of a two-way layout, motions by objects (Scheffé 1959, The analysis of
variance, chapter 4).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.profiles import Profile
from shaketable.assess.results import UncertainResult
from shaketable.assess.runs import Done
from shaketable.assess.shares import Share
from shaketable.assess.solid_runs import run_solids
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.stood import Stood
from shaketable.calibration import Uncertainty
from shaketable.calibration.uncertainty import uncertain
from shaketable.inventory import BaseShape, Item
from shaketable.resampling import wilson_interval
from shaketable.simulate import ShakingSet, fell, simulate_each

MEMBERS = 16


class FurnitureKind(NamedTuple):
    """What is assumed of a kind of furniture; none of these numbers is measured.

    Attributes:
        name: of the kind.
        words: that its names have.
        uncertainty: of each object; motions differ among themselves, and are taken as they are,
            and so is the loss at impacts: more of it would only lower the probability.
    """

    name: str
    words: re.Pattern[str]
    uncertainty: Uncertainty


def _kind(name: str, slenderness: float, cg_offset: float, *words: str) -> FurnitureKind:
    return FurnitureKind(
        name,
        re.compile(rf"\b({'|'.join(words)})" if words else "", re.IGNORECASE),
        Uncertainty(slenderness=slenderness, cg_offset=cg_offset, restitution=0.0, motion=0.0),
    )


#: The first whose words a name has, in English, Spanish or German; the last fits all.
#: What is filled and emptied is least known.
KINDS = (
    _kind(
        "filled and emptied",
        0.10,
        0.05,
        "shel(f|ves)|book|rack|cupboard|cabinet|files?\\b|wardrobe|locker|refrigerator|freezer|box",
        "estant|repisa|libr|armario|ropero|gabinete|archivador|casillero|refrigerador|congelador|caja",
        r"\w*(regal|schrank|schränke|kommode|kasten|kästen)|spind|gefrier|kiste",
    ),
    _kind(
        "solid",
        0.03,
        0.02,
        "statue|sculpture|column|block|bust|vase|cylinder|bottle",
        "estatua|escultura|columna|bloque|jarr|florero|cilindro|botella|bal[óo]n",
        r"skulptur|säule|büste|\w*zylinder|\w*flasche",
    ),
    _kind("equipment", 0.05, 0.03),
)


def kind_of(item: Item) -> FurnitureKind:
    """The kind of an item, by its name."""
    return next(kind for kind in KINDS if kind.words.search(item.name))


def uncertain_results(
    profiles: Sequence[Profile], trial: ShakingSet, done: Done
) -> list[UncertainResult]:
    """The probability that each profile falls, with objects like it in its place.

    Args:
        profiles: some; none of them rolls.
        trial: motions, their scale, and the model.
        done: is told how many more simulations were made.
    """
    kinds = [kind_of(profile.item) for profile in profiles]
    bodies, tilts = [], []
    for profile, kind in zip(profiles, kinds, strict=True):
        # a support's own lean is part of it: the same seed gives every object the same members
        members, lean, _ = uncertain(profile.body, profile.tilt, kind.uncertainty, MEMBERS)
        bodies += members
        tilts.append(lean)
    lean = np.concatenate(tilts)
    falls = np.zeros((len(profiles), MEMBERS, len(trial.motions)))
    for k, motion in enumerate(trial.motions):
        for polarity in (1, -1):
            runs = simulate_each(
                bodies,
                motion,
                tilts=lean,
                scales=trial.scale,
                polarities=polarity,
                model=trial.model,
                progress=done,
            )
            falls[:, :, k] += fell(runs).values.reshape(len(profiles), MEMBERS) / 2.0
    recordings = int(trial.recording.max()) + 1
    return [_result(kind, falls[k], recordings) for k, kind in enumerate(kinds)]


def uncertain_in_space(
    items: Sequence[Item], space: ShakingInSpace, done: Done
) -> list[UncertainResult]:
    """The same in three dimensions, each member turned in one of the ways of its item.

    Args:
        items: some; none of them rolls, and the bases of all are known.
        space: how they are shaken.
        done: is told how many more simulations were made.
    """
    kinds = [kind_of(item) for item in items]
    stood = [
        each
        for item, kind in zip(items, kinds, strict=True)
        for each in _members(item, kind, space)
    ]
    motions = space.trial.motions
    ways = []
    for k, each in enumerate(stood):
        every = each.ways(motions)
        turn = k % MEMBERS % every.shape[2]
        ways.append(every[:, :, turn : turn + 1])
    runs = run_solids(stood, ways, space.trial, done)
    found = []
    for k, kind in enumerate(kinds):
        own = runs[k * MEMBERS : (k + 1) * MEMBERS]
        falls = np.array([each.fell.reshape(len(motions), -1).mean(axis=1) for each in own])
        found.append(_result(kind, falls, space.recordings))
    return found


def _members(item: Item, kind: FurnitureKind, space: ShakingInSpace) -> list[Stood]:
    """Objects like an item, on supports that may lean."""
    assert item.sideways is not None
    depths, lean, _ = uncertain(item.body, space.tilt, kind.uncertainty, MEMBERS)
    # a round base is one size, with its centre of gravity in the middle
    round_base = item.shape is BaseShape.CYLINDER
    widths, aside, _ = uncertain(item.sideways, 0.0, kind.uncertainty, MEMBERS, 1)
    members = []
    for depth, width, tilt, sideways in zip(
        depths, widths, lean.tolist(), aside.tolist(), strict=True
    ):
        body = replace(depth, left=depth.base / 2) if round_base else depth
        like = replace(item, body=body, sideways=body if round_base else width)
        stood = space.stood(like)
        assert stood is not None
        members.append(stood._replace(tilt=tilt, aside=sideways))
    return members


def _result(kind: FurnitureKind, falls: NDArray[np.float64], recordings: int) -> UncertainResult:
    value = float(falls.mean())
    low, high = wilson_interval(value, recordings)
    by_object, by_motion = components(falls)
    return UncertainResult(kind.name, Share(value, float(low), float(high)), by_object, by_motion)


def components(falls: NDArray[np.float64]) -> tuple[float, float]:
    """Standard deviations of the share between objects, and between motions; zero at least.

    Motions count one by one. The components of one recording are more alike than others, which
    lowers the variance between N motions by at most 1 part in N − 1.

    Args:
        falls: share of the two directions of a motion that overturn it, (object, motion).
    """
    objects, motions = falls.shape
    mean, of_object, of_motion = falls.mean(), falls.mean(axis=1), falls.mean(axis=0)
    rest = falls - of_object[:, None] - of_motion + mean
    residual = (rest**2).sum() / max(1, (objects - 1) * (motions - 1))
    between_objects = motions * of_object.var(ddof=1) if objects > 1 else 0.0
    between_motions = objects * of_motion.var(ddof=1) if motions > 1 else 0.0
    return (
        float(np.sqrt(max(0.0, between_objects - residual) / motions)),
        float(np.sqrt(max(0.0, between_motions - residual) / objects)),
    )
