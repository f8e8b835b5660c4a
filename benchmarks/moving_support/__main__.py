"""Prints what each software makes of the cases: `python -m benchmarks.moving_support`.

MuJoCo and Drake are packages of the extra `bench`, MuJoCo Warp is mujoco-warp on PyPI; what is not
installed is left out, and said.
`--only NAME` runs one of them.
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import time
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from benchmarks.moving_support import ours, with_drake, with_mujoco, with_warp
from benchmarks.moving_support.cases import Answers, Case, read_cases

ABSOLUTE = 0.01  # rad: peaks that are nought are off by parts of it
NEAR_SLIP, NEAR_PEAK = 1e-3, 0.01  # m; of the peak


class Software(NamedTuple):
    """How one software runs a case, and the package that it needs."""

    name: str
    run: Callable[[Case], Answers]
    package: str = ""


SOFTWARE = (
    Software("shaketable", ours.run),
    *(
        Software(
            f"MuJoCo, {way}, {1e6 * step:g} μs",
            partial(with_mujoco.run, step=step, way=way),
            "mujoco",
        )
        for step, way in (
            (2e-4, "apparent gravity"),
            (2e-5, "apparent gravity"),
            (2e-4, "driven joints"),
            (2e-4, "mocap"),
        )
    ),
    Software(
        "MuJoCo Warp, apparent gravity, 1 ms", partial(with_warp.run, step=1e-3), "mujoco_warp"
    ),
    Software("Drake, apparent gravity, 200 μs", partial(with_drake.run, step=2e-4), "pydrake"),
)


class Row(NamedTuple):
    """A case in one software: how far off it is, and how long it took."""

    outcome: bool
    slip: float
    peak: float
    took: float

    @property
    def close(self) -> bool:
        """Whether the outcome is right, the slip within 1 mm, the peak within 1 %."""
        off = (self.slip / NEAR_SLIP, self.peak / NEAR_PEAK)
        return self.outcome and all(each <= 1.0 for each in off if not math.isnan(each))


def held_against(case: Case, software: Software) -> Row:
    begun = time.perf_counter()
    found = software.run(case)
    took = time.perf_counter() - begun
    known = case.answers
    slip = peak = math.nan
    if known.slip is not None and found.slip is not None:
        slip = math.inf if found.falls else abs(found.slip - known.slip)
    if known.peak is not None and found.peak is not None:
        peak = abs(found.peak - known.peak) / (known.peak or ABSOLUTE)
    return Row(found.falls == known.falls, slip, peak, took)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", metavar="NAME", help="part of a software's name")
    only = parser.parse_args().only
    cases = read_cases()
    chosen = [each for each in SOFTWARE if only is None or only.lower() in each.name.lower()]
    rows: dict[str, list[Row]] = {}
    for each in chosen:
        if each.package and importlib.util.find_spec(each.package) is None:
            print(f"{each.name}: left out, {each.package} is not installed")
            continue
        each.run(cases[0])  # compiles, loads
        rows[each.name] = [held_against(case, each) for case in cases]
    print("| case | known | " + " | ".join(rows) + " |")
    print("|---|---|" + "---:|" * len(rows))
    for k, case in enumerate(cases):
        print(f"| {case.name} | {_known(case)} | ", end="")
        print(" | ".join(_told(case, told[k]) for told in rows.values()) + " |")
    heads = ("software", "ms a case", "close", "slip off, largest [m]", "peak off, median")
    print(f"\n| {' | '.join(heads)} | largest |\n|---|---:|---:|---:|---:|---:|")
    for name, told in rows.items():
        slips = np.array([row.slip for row in told])
        peaks = np.array(
            [row.peak for row, case in zip(told, cases, strict=True) if case.answers.peak]
        )
        right = sum(row.close for row in told)
        print(
            f"| {name} | {1e3 * np.mean([row.took for row in told]):,.1f} | {right}/{len(told)} | "
            f"{np.nanmax(slips):.1e} | {np.nanmedian(peaks):.1e} | {np.nanmax(peaks):.1e} |"
        )


def _known(case: Case) -> str:
    slip, peak, falls = case.answers
    if falls:
        return "falls"
    return f"slips {1e3 * slip:.3f} mm" if slip is not None else f"{peak:.6f} rad"


def _told(case: Case, row: Row) -> str:
    if not row.outcome:
        return "stands" if case.answers.falls else "falls"
    if case.answers.slip is not None:
        return f"{1e3 * row.slip:.2g} mm"
    if case.answers.peak is None:
        return "falls"
    if not case.answers.peak:
        return f"{row.peak * ABSOLUTE:.1g} rad"
    return f"{100.0 * row.peak:.2g} %"


if __name__ == "__main__":
    main()
