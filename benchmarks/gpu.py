"""`python -m benchmarks.gpu`: both planar models on a GPU beside the CPU, transfers included.

Outcomes of all of W1 are compared, and the peaks where a simulation is well conditioned. Where they
differ the CPU runs them again with bases that differ by some 1e-15 or 1e-12: a member whose
outcome changes then was at the edge of falling, on either device. The first time, kernels compile
for seconds (rocking) to minutes (general): `--of` takes one at a time, for both side by side.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import version
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.cases import BODIES, TILTS, motions
from shaketable import Body, General, Rocking, simulate, simulate_many
from shaketable.engine.cuda import require_gpu
from shaketable.engine.pool import available_cores
from shaketable.errors import InputError
from shaketable.simulate import plane_on_gpu
from shaketable.support import Support

MODELS = {"rocking": Rocking(), "general": General(static_friction=0.5)}
NUDGES = (2e-16, 1e-12)  # of the base, ten of each to either side
SAME = 1e-9  # rad
SHOWN = ("outcome", "peak_rotation", "overturning_time", "impacts")


def told(what: str) -> None:
    print(what, flush=True)


@contextmanager
def in_kernels(module: Any, name: str) -> Iterator[list[float]]:
    """The seconds of each launch of the kernels that a module launches, transfers included."""
    launch, seconds = getattr(module, name), []

    def timing(*arguments: Any) -> Any:
        start = time.perf_counter()
        found = launch(*arguments)
        seconds.append(time.perf_counter() - start)
        return found

    setattr(module, name, timing)
    try:
        yield seconds
    finally:
        setattr(module, name, launch)


def timed(
    device: str, bodies: list[Body], model: Rocking | General, rounds: int
) -> tuple[float, xr.Dataset]:
    """Simulations a second, the best of some rounds, and the results."""
    best, found = 0.0, None
    for _ in range(rounds):
        start = time.perf_counter()
        found = simulate_many(
            bodies, motions(), tilts=TILTS, model=model, device=device, progress=False
        )
        best = max(best, found["outcome"].size / (time.perf_counter() - start))
    assert found is not None
    return best, found


def at_the_edge(member: dict[str, Any], model: Rocking | General) -> bool:
    """Whether bases that differ by NUDGES change a member's outcome on the CPU."""
    body, motion = BODIES[member["body"]], motions()[member["motion"]]
    motion = motion if member["polarity"] == 0 else motion.reversed()
    near = [
        Body.rectangle(body.base * (1.0 + k * nudge), 2.0 * body.cg_height)
        for nudge in NUDGES
        for k in range(-10, 11)
    ]
    tilt = Support(tilt=float(TILTS[member["tilt"]]))
    return len({simulate(one, motion, tilt, model=model).outcome for one in near}) > 1


def compare(model: Rocking | General) -> None:
    """All outcomes of W1 on both devices."""
    _, there = timed("cuda", BODIES, model, 1)
    _, here = timed("cpu", BODIES, model, 1)
    differ = there["outcome"] != here["outcome"]
    names = ("body", "motion", "polarity", "tilt", "scale")
    members = [dict(zip(names, at, strict=True)) for at in np.argwhere(differ.values)]
    edge = sum(at_the_edge(member, model) for member in members)
    told(f"W1: {len(members)} of {differ.size:,} outcomes differ, {edge} of them at an edge")
    for member in members:
        told("    " + ", ".join(f"{name} {place}" for name, place in member.items()))
        for device, found in (("cuda", there), ("cpu", here)):
            one = found.isel(member)
            told(f"        {device}: " + ", ".join(f"{each} {one[each].item()}" for each in SHOWN))
    stands = (~differ) & (here["outcome"] == 0) & (here["impacts"] < 20)
    off = np.abs(there["peak_rotation"] - here["peak_rotation"]).values[stands.values]
    told(f"peaks of {off.size:,} that stand and hit less than 20 times: within {SAME:g} rad in "
         f"{100 * (off < SAME).mean():.3f} %, largest {off.max():.1e} rad")  # fmt: skip


def where(device: str) -> str:
    return device if device == "cuda" else f"{device}, {available_cores()} cores"


def compare_planar(model: Rocking | General, times: int, rounds: int) -> None:
    """W1 on both devices, and so many times over on the GPU."""
    start = time.perf_counter()
    timed("cuda", BODIES[:1], model, 1)
    told(f"the first simulation, which compiles: {time.perf_counter() - start:.0f} s")
    compare(model)
    for device, often in (("cpu", 1), ("cuda", 1), ("cuda", times)):
        with in_kernels(plane_on_gpu, "run_on_gpu") as seconds:
            rate, _ = timed(device, BODIES * often, model, rounds)
        told(f"W1 × {often} on {where(device)}: {rate:,.0f} simulations/s"
             + (f", {sum(seconds) / rounds:.2f} s in the kernel" if seconds else ""))  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=100, help="W1 so many times over")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--of", nargs="+", choices=[*MODELS], default=[*MODELS])
    given = parser.parse_args()
    try:
        cuda = require_gpu()
    except InputError as error:
        raise SystemExit(f"nothing is measured: {error}") from None
    packages = ", ".join(f"{name} {version(name)}" for name in ("numba", "numba-cuda", "numpy"))
    told(f"{cuda.get_current_device().name}; {packages}")
    for name in given.of:
        told(f"\n{name}")
        compare_planar(MODELS[name], given.times, given.rounds)


if __name__ == "__main__":
    main()
