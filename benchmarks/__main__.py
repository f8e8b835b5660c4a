"""`make bench`: this package and its peers on the same workload, simulations a second on one core.

The package runs all of W1, its peers a random sample of it. Outcomes and peak rotations are
compared with the tests' reference integrator (SciPy's DOP853 at a relative tolerance of 1e-13).
Times on shared machines vary by tens of percent; the ratios of one run are what counts.
"""

from __future__ import annotations

import argparse
import logging
import math
import time
from collections.abc import Sequence

import xarray as xr
from tests.support.reference import integrate

from benchmarks import contact
from benchmarks.cases import BODIES, TILTS, motions, sample
from benchmarks.peers import PEERS, Case
from shaketable import Body, General, Motion, Rocking, Support, simulate, simulate_many
from shaketable.engine.pool import available_cores

ROUNDS = 6
SLIPPERY = (2.0, 0.5, 0.25, 0.1)
ROLLING = 0.02


def w1(
    threads: int | None,
    friction: float | None = None,
    rounds: int = ROUNDS,
    tilts: Sequence[float] = TILTS,
) -> float:
    """Simulations a second on W1, the best of some rounds; the general model where friction is
    given."""
    shaking = motions()
    model = Rocking() if friction is None else General(static_friction=friction)
    best = math.inf
    for _ in range(rounds):
        start = time.perf_counter()
        runs = simulate_many(
            BODIES,
            shaking,
            tilts=tilts,
            model=model,
            progress=False,
            threads=threads,
        )
        best = min(best, time.perf_counter() - start)
    return float(runs.outcome.size / best)


def outcomes(model: Rocking | General) -> xr.DataArray:
    return simulate_many(BODIES, motions(), tilts=TILTS, model=model, progress=False).outcome


def single(body: Body, motion: Motion, tilt: float) -> Case:
    run = simulate(body, motion, Support(tilt=tilt))
    return int(run.outcome), run.peak_rotation


def accuracy(found: Sequence[Case], truth: Sequence[Case]) -> tuple[str, str]:
    """Outcomes that agree, and the median error of the peak where a body rocks and stands."""
    same = sum(f[0] == t[0] for f, t in zip(found, truth, strict=True))
    off = sorted(
        abs(f[1] - t[1])
        for f, t in zip(found, truth, strict=True)
        if f[0] == t[0] == 0 and t[1] > 0
    )
    return f"{same}/{len(truth)}", f"{off[len(off) // 2]:.0e}" if off else "-"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=60, help="members of W1 that the peers run")
    parser.add_argument("--pulses", type=int, default=12, help="pulses for the general model")
    asked = parser.parse_args()
    cases = sample(asked.cases)

    references = [integrate(body, motion, tilt) for body, motion, tilt in cases]
    truth = [(reference.outcome, reference.peak) for reference in references]
    alone, together = w1(1), w1(None)
    general = w1(None, 2.0)
    print(f"W1, 36,000 simulations: {together:,.0f} /s on {available_cores()} cores")
    print(f"W1, general model, μ = 2: {general:,.0f} /s, {general / together:.2f} of it")
    unlike = int((outcomes(Rocking()) != outcomes(General(static_friction=2.0))).sum())
    print(f"outcomes in which both models differ: {unlike} of 36,000")
    logging.disable()  # on the steepest tilts everything slides by itself with little friction
    rates = ", ".join(f"{w1(1, mu, 1):,.0f} (μ = {mu:g})" for mu in SLIPPERY)
    logging.disable(logging.NOTSET)
    print(f"on one core: {rates}")
    rolling = w1(1, ROLLING, tilts=TILTS[:1])
    print(f"on castors, μ = {ROLLING:g}, level, one core: {rolling:,.0f} /s\n")
    print("| software | simulations/s, one core | times slower | outcomes | peak off [rad] |")
    print("|---|---:|---:|---:|---:|")
    ours = accuracy([single(*case) for case in cases], truth)
    print(f"| shaketable, `simulate_many` | {alone:,.0f} | 1 | {ours[0]} | {ours[1]} |")
    for name, peer in {"shaketable, `simulate` with history": single, **PEERS}.items():
        peer(*cases[0])  # what it compiles or loads is not counted
        start = time.perf_counter()
        found = [peer(*case) for case in cases]
        rate = len(cases) / (time.perf_counter() - start)
        same, off = accuracy(found, truth)
        print(f"| {name} | {rate:,.2f} | {alone / rate:,.0f} | {same} | {off} |", flush=True)
    contact.report(asked.pulses)


if __name__ == "__main__":
    main()
