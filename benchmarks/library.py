"""`python -m benchmarks.library STORE`: how far a library's rows can be trusted, and what it costs.

STORE is that of `shaketable campaign run library/fema-p58.toml` or of another library. Printed are:
rows drawn at random beside new simulations under the same motions with other draws of their things;
whether medians from one half of the earthquakes agree with those from the other half as their
intervals say; medians of one shape in several sizes; how far what straps alone hold up had
turned; and what edition 1.0 and the whole library cost, from the seconds of a case of each kind.
"""

from __future__ import annotations

import argparse
import logging
import time
from collections import defaultdict
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.campaign.description import read_campaign
from shaketable.campaign.kinds import work_of
from shaketable.campaign.libraries import Libraries, runs_of
from shaketable.campaign.objects import Objects
from shaketable.fragility.limit_states import OVERTURNS, LimitState
from shaketable.fragility.lognormal import Points, fit_many, reflected
from shaketable.library.case import Case
from shaketable.library.fitted import Shaking, functions_of_case
from shaketable.library.measures import levels_of, measure_of
from shaketable.library.shaken import CaseRuns, motions_under, simulated
from shaketable.progress import duration
from shaketable.resampling import nested_resamples

LIBRARY = Path(__file__).parents[1] / "library"
EDITION, WHOLE = LIBRARY / "edition-1.0.toml", LIBRARY / "whole.toml"
FRICTION = (0.4, 0.6)
STATE, MEASURE = LimitState(OVERTURNS), "PGV"
#: How it is held, whether it stands on a floor, and whether it is round.
Slope = tuple[str, bool, bool]
OTHER_SEED = 1000
HALVES = 40  # ways to part the earthquakes
CLUSTER = 256  # cores


def direct(work: Libraries, runs: list[CaseRuns], rows: int, seed: int) -> None:
    """Rows at random beside new simulations: other things of the kind, other directions."""
    random = np.random.default_rng(seed)
    shaking = Shaking(work.ground, seed=0)
    given = {"states": [STATE], "measures": [MEASURE]}
    inside, departs, shares = [], [], []
    order = random.permutation(work.blocks).tolist()
    for number in order:
        case = work.cases[number]
        (one,) = functions_of_case(case, runs[number], shaking, seed=work.library.seed, **given)
        if one.problem:
            continue
        scales = np.unique(runs[number].scale)
        again = simulated(
            case, motions_under(case, work.ground), seed=OTHER_SEED, scales=scales.tolist()
        )
        once = shaking.levels(case, measure_of(MEASURE))
        (new,) = functions_of_case(case, again, shaking, seed=OTHER_SEED, **given)
        low, high = one.curve.median_interval
        inside.append(low <= new.curve.median <= high)
        departs.append(new.curve.median / one.curve.median - 1.0)
        # how many fall at each scale, and how many the row says
        level = once[again.draw % len(once)] * again.scale
        told = replace(one.curve, more_beta=0.0).probability(level)
        shares += [
            again.fell[again.scale == scale].mean() - told[again.scale == scale].mean()
            for scale in scales
        ]
        if len(inside) == rows:
            break
    print(f"{len(inside)} rows at random, simulated again under the same motions with other draws: "
          f"medians depart by {100 * _root_mean_square(departs):.1f} % (root mean square), "
          f"{100 * np.abs(departs).max():.0f} % at most, {sum(inside)} of them within the row's "
          f"interval; shares of falls at a factor depart from the row's function by "
          f"{100 * _root_mean_square(shares):.1f} % (root mean square)")  # fmt: skip


def _root_mean_square(values: list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def held_out(work: Libraries, runs: list[CaseRuns], seed: int) -> None:
    """Medians from half of the earthquakes beside those from the others."""
    random = np.random.default_rng(seed)
    shaking = Shaking(work.ground, draws=0)
    measure, events = measure_of(MEASURE), int(shaking.event.max()) + 1
    z: list[float] = []
    for case, found in zip(work.cases, runs, strict=True):
        level = shaking.levels(case, measure)[found.draw % len(shaking.ground)] * found.scale
        if not 0.1 < found.fell.mean() < 0.9:
            continue
        recording = shaking.recording[found.draw % len(shaking.ground)]
        for k in range(max(1, HALVES // 20)):
            first = random.permutation(events)[: events // 2]
            parts = []
            for here in (np.isin(shaking.event, first), ~np.isin(shaking.event, first)):
                parts.append(_half(level, found.fell, recording, shaking.event, here, k))
            (a, sa), (b, sb) = parts
            if np.isfinite([a, b, sa, sb]).all():
                z.append((a - b) / np.hypot(sa, sb))
    share = np.mean(np.abs(z) < 1.96)
    print(f"{len(z)} medians from {events // 2} earthquakes beside those from the others: "
          f"{100 * share:.1f} % agree within 1.96 standard errors of the difference; z has a "
          f"standard deviation of {np.std(z):.2f}")  # fmt: skip


def _half(
    level: NDArray[np.float64],
    fell: NDArray[np.bool_],
    recording: NDArray[np.intp],
    event: NDArray[np.intp],
    here: NDArray[np.bool_],
    seed: int,
) -> tuple[float, float]:
    """ln θ of the recordings of some earthquakes, and its standard error."""
    some = here[recording]
    _, mine = np.unique(recording[some], return_inverse=True)
    _, of_event = np.unique(event[here], return_inverse=True)
    points = Points(level[some], fell[some].astype(np.int64), np.ones(some.sum(), np.int64), mine)
    fits = fit_many(points, nested_resamples(of_event, 60, seed))
    draws = np.log(reflected(fits.median))
    return float(np.log(fits.median[0])), float(np.nanstd(draws))


def monotone(work: Libraries, runs: list[CaseRuns]) -> None:
    """Medians of one shape in several sizes: the larger, the stronger the shaking that it takes."""
    shaking = Shaking(work.ground, draws=0)
    found: dict[tuple[str, str, str], dict[float, float]] = defaultdict(dict)
    for case, runs_of_case in zip(work.cases, runs, strict=True):
        if case.thing.size == "middle" and case.tilt == 0.0:
            (one,) = functions_of_case(
                case, runs_of_case, shaking, states=[STATE], measures=[MEASURE],
                seed=work.library.seed,
            )  # fmt: skip
            key = case.thing.kind, case.stand.name, case.held.name
            found[key][case.thing.scale] = one.curve.median
    if all(len(sizes) < 2 for sizes in found.values()):
        return
    print("\n| thing, place, held | θ at 0.7, 1 and 1.4 times its size: PGV [cm/s] | rises |\n"
          "|---|---|---|")  # fmt: skip
    for key, sizes in found.items():
        if len(sizes) > 1:
            medians = [sizes[scale] for scale in sorted(sizes)]
            rises = all(a < b for a, b in pairwise(medians))
            told = ", ".join(f"{100 * each:.0f}" for each in medians)
            print(f"| {', '.join(key)} | {told} | {'yes' if rises else 'no'} |")


def held_up(work: Libraries, runs: list[CaseRuns]) -> None:
    """How far what its wall and strap alone hold up had turned, and its foot had come."""
    straps = [found for case, found in zip(work.cases, runs, strict=True) if case.held.strength]
    if not straps:
        return
    turned = np.degrees(np.concatenate([run.rotation[run.held_up] for run in straps]))
    came = 100.0 * np.concatenate([run.farthest[run.held_up] for run in straps])
    every = sum(run.fell.size for run in straps)
    print(f"\n{turned.size:,} of {every:,} simulations in a strap end held up by it alone: half of "
          f"them never turned by more than {np.median(turned):.1f}°, 95 % by "
          f"{np.quantile(turned, 0.95):.1f}°; their foot came {np.median(came):.0f} cm far in the "
          "median")  # fmt: skip


def cost() -> None:
    """What libraries cost, by a case of each slope of the whole one, timed here."""
    libraries = {}
    for path in (EDITION, WHOLE):
        found = read_campaign(path)
        assert isinstance(found, Libraries)
        libraries[path.stem] = found
    whole = libraries[WHOLE.stem]
    alike: dict[Slope, list[Case]] = defaultdict(list)
    for case in whole.cases:
        if case.tilt == 0.0 and case.friction == FRICTION:
            alike[_slope(case)].append(case)
    seconds = {}
    for key, cases in alike.items():
        case = cases[len(cases) // 2]
        motions = motions_under(case, whole.ground)
        start = time.perf_counter()
        simulated(case, motions, seed=whole.library.seed)
        seconds[key] = time.perf_counter() - start
    print("")
    for name, found in libraries.items():
        total = sum(seconds[_slope(case)] for case in found.cases)
        things = len({case.thing.name for case in found.cases})
        of = f"{found.blocks:,} cases of {things} things"
        on_paper = f"{duration(2 * total / CLUSTER)} on {CLUSTER} such cores on paper"
        print(f"{name}: {of}; {duration(total)} on two cores like these, {on_paper}")
    for (held, on_floor, is_round), each in sorted(seconds.items()):
        print(f"  {held:6} {'floor ' if on_floor else 'ground'} "
              f"{'round' if is_round else 'box  '} {each:.1f} s a case")  # fmt: skip


def _slope(case: Case) -> Slope:
    """What decides how long a case takes."""
    held = "strap" if case.held.strength else "wall" if case.held.wall_gap is not None else "free"
    held = "table" if case.held.edge is not None else held
    return held, case.stand.building is not None, case.thing.round


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("store")
    parser.add_argument("--rows", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    logging.getLogger("shaketable").setLevel(logging.ERROR)  # of so few earthquakes it warns each
    objects = Objects(given.store)
    work = work_of(objects)
    assert isinstance(work, Libraries)
    runs = runs_of(work, objects)
    strongest = max(levels_of(measure_of(MEASURE).measure, work.ground))
    print(f"the strongest motion as recorded: {MEASURE} {100 * strongest:.0f} cm/s")
    direct(work, runs, given.rows, given.seed)
    held_out(work, runs, given.seed)
    monotone(work, runs)
    held_up(work, runs)
    cost()


if __name__ == "__main__":
    main()
