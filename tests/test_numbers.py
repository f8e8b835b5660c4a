"""Numbers of every kind at the interfaces: taken as what they are, or refused with a word."""

from __future__ import annotations

import math
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Rocking,
    Solid,
    Support,
    read_inventory,
    simulate,
)
from shaketable.calibration.prior_file import read_prior
from shaketable.hazard import read_hazard
from shaketable.hazard.shakemap import read_shakemap
from shaketable.inputs import number_of
from tests.support.command import refused

ONE = np.float32(1.0)


@pytest.mark.parametrize(
    "thing",
    [
        Body(
            base=1, cg_height=ONE, left=np.float16(0.5), gyration_radius=True, restitution_factor=1
        ),
        Solid.cylinder(1, np.int64(2)),
        Solid(np.array([[-1, -1], [1, -1], [0, 1]]), 1, np.eye(3, dtype=int), height=2, rise=0),
        Support(tilt=0, azimuth=3),
        General(static_friction=1, kinetic_friction=np.float32(0.5), normal_restitution=0),
        Rocking(restitution_factor=1),
        Motion(np.array([0, 1, 0]), 1),
    ],
    ids=lambda thing: type(thing).__name__,
)
def test_fields_are_floats(thing: Any) -> None:
    """Each kernel is compiled for floats alone: for an int it took 50 s more."""
    for field in fields(thing):
        value = getattr(thing, field.name)
        if isinstance(value, (np.number, int)) and not isinstance(value, bool):
            raise AssertionError(f"{field.name} is {value!r}")
        if isinstance(value, np.ndarray):
            assert value.dtype == np.float64


def test_whole_numbers_compile_nothing_anew() -> None:
    from shaketable.physics.space.drive import move_solid

    motion = Motion(np.array([0, 3, 0, -3, 0]), 1 / 4, transverse=[0, 1, 0, 0, 0])
    given: list[tuple[Any, Any, Any]] = [
        (Solid.box(0.3, 0.4, 1.0), Support(), 0.0),
        (Solid.box(1, 1, 2, cg_height=1), Support(tilt=0, azimuth=0), 0),
        (Solid.box(1, np.float32(1), 2), Support(), np.float32(0.5)),
    ]
    for solid, support, orientation in given:
        simulate(solid, motion, support, model=General(static_friction=1), orientation=orientation)
    assert len(move_solid.signatures) == 1  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    "values",
    [
        [10**400, 0],
        [1j, 0],
        np.array([1j, 0.0]),
        ["1", "2"],
        np.array(["1", "2"]),
        [None, 1.0],
        [{}, 1],
    ],
    ids=str,
)
def test_what_is_no_series(values: Any) -> None:
    with pytest.raises(InputError, match=r"Motion\.horizontal must be a series of numbers"):
        Motion(values, 0.01)


@pytest.mark.parametrize("value", [10**400, 1j, "1", None, [1, 2], np.zeros(3)], ids=str)
def test_what_is_no_number(value: Any) -> None:
    for make in (
        lambda: Body.rectangle(value, 1.0),
        lambda: Solid.box(value, 1.0, 1.0),
        lambda: Support(tilt=value),
        lambda: General(static_friction=value),
        lambda: Motion([0.0, 1.0], value),
    ):
        with pytest.raises(InputError, match="must be"):
            make()


def test_a_number_in_a_text() -> None:
    """Fortran's exponents are numbers in every table; 1d1 broke two of them."""
    for text, number in (("1d1", 10.0), ("-1.5D-3", -0.0015), ("2e2", 200.0), (".5", 0.5)):
        assert number_of(text) == number
    for text in ("", "1d", "nan", "inf", "0x10", "1_000", "١"):
        assert math.isnan(number_of(text))


def test_exponents_in_tables(tmp_path: Path) -> None:
    (tmp_path / "list.csv").write_text(
        "name,width_m,height_m,latitude,longitude\na,3d-1,18D-1,1d1,2d1\n"
    )
    (item,) = read_inventory(tmp_path / "list.csv")
    assert item.body.base == 0.3
    (tmp_path / "prior.csv").write_text("parameter,low,high\nslenderness,0.9d0,1.1d0\n")
    assert read_prior(tmp_path / "prior.csv").slenderness.high == 1.1


def test_damaged_hazard(tmp_path: Path) -> None:
    path = tmp_path / "usgs.json"
    path.write_text(
        '{"response": {"hazardCurves": [{"imt": {"value": "PGA"}, "data": '
        '[{"component": "Total", "values": {"xs": [0.1, 0.2, 0.3], "ys": [0.1, 0.2]}}]}]}}'
    )
    with pytest.raises(InputError, match="has 3 levels \\(xs\\) and 2 rates"):
        read_hazard(path)
    path = tmp_path / "one.csv"
    path.write_text("#,,,\"kind='mean', investigation_time=50.0, imt='PGA', poe-0.1\"\n")
    with pytest.raises(InputError):
        read_hazard(path)
    path.write_text("#poe-,\"investigation_time=50.0, imt='PGA'\",poe-0.1\n")
    with pytest.raises(InputError, match="expected columns lon, lat"):
        read_hazard(path)
    for encoding in ("UTF-2", "x-unknown", "utf-7"):
        path = tmp_path / "grid.xml"
        path.write_text(f'<?xml version="1.0" encoding="{encoding}"?><shakemap_grid/>')
        with pytest.raises(InputError, match=r"grid\.xml"):
            read_shakemap(path)


def test_peaks_that_no_ground_has() -> None:
    said = refused(
        "criteria", "--base-m", 0.3, "--height-m", 1.8, "--pga-g", 1e300, "--pgv-cm-s", 40
    )
    assert "--pga-g must be between 0 and 100" in said
    said = refused(
        "criteria", "--base-m", 0.3, "--height-m", 1.8, "--pga-g", 0.3, "--pgv-cm-s", 1e300
    )
    assert "--pgv-cm-s must be between 0 and 10000" in said
