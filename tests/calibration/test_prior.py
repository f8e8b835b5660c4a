"""Ranges of parameters, the bodies spread over them, and tables of them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError
from shaketable.calibration import PARAMETERS, Prior, Range, read_prior


def test_an_ensemble_is_spread_evenly() -> None:
    """Sobol's first 256 points put 128 into each half of every range, for log-uniform in ln."""
    prior = Prior(tilt=Range(-0.01, 0.01))
    found = prior.sample(256, seed=3)
    for name in PARAMETERS:
        ends: Range = getattr(prior, name)
        middle = float(ends.at(np.array([0.5]))[0])
        assert (found.of(name) < middle).sum() == 128
    assert float(prior.slenderness.at(np.array([0.5]))[0]) == pytest.approx(math.sqrt(0.05 * 0.6))


def test_bodies_are_what_the_parameters_say() -> None:
    ensemble = Prior().sample(16)
    for row, body in zip(ensemble.values, ensemble.bodies, strict=True):
        assert math.atan2(body.base / 2, body.cg_height) == pytest.approx(row[0])
        assert math.hypot(body.base / 2, body.cg_height) == pytest.approx(row[1])
        assert body.left / body.base - 0.5 == pytest.approx(row[2])
        assert body.restitution_factor == row[3]


def test_the_seed_decides() -> None:
    first, again, other = (Prior().sample(32, seed).values for seed in (0, 0, 1))
    assert (first == again).all()
    assert (first != other).any()


def test_a_measured_body_lies_in_the_prior_about_it() -> None:
    prior = Prior.around(0.12, 0.6)
    assert prior.slenderness.low < math.atan2(0.12, 0.6) < prior.slenderness.high
    assert prior.half_diagonal.low < math.hypot(0.06, 0.3) < prior.half_diagonal.high


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"slenderness": Range(0.0, 0.3)}, "slenderness must lie"),
        ({"half_diagonal": Range(-1.0, 0.3)}, "half_diagonal must be above 0"),
        ({"cg_offset": Range(0.0, 0.5)}, "cg_offset must lie"),
        ({"restitution_factor": Range(0.5, 1.1)}, "restitution_factor must lie"),
        ({"tilt": Range(0.0, 0.04)}, "overturns the most slender body"),
    ],
)
def test_a_prior_that_holds_no_body(given: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Prior(**given)


@pytest.mark.parametrize("ends", [(2.0, 1.0), (0.0, math.inf), (math.nan, 1.0)])
def test_a_range_has_ends_in_order(ends: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="finite ends in order"):
        Range(*ends)


def test_a_logarithm_needs_a_positive_range() -> None:
    with pytest.raises(InputError, match="must begin above 0"):
        Range(0.0, 1.0, "log-uniform")


def test_a_table_of_ranges(tmp_path: Path) -> None:
    path = tmp_path / "prior.csv"
    path.write_text(
        "parameter,low,high,distribution\nslenderness,0.1,0.2,log-uniform\ntilt,-0.01,0.01,\n"
    )
    found = read_prior(path)
    assert found.slenderness == Range(0.1, 0.2, "log-uniform")
    assert found.tilt == Range(-0.01, 0.01)
    assert found.half_diagonal == Prior().half_diagonal
    about = Prior.around(0.3, 1.2)
    found = read_prior(path, about)
    assert (found.slenderness.low, found.half_diagonal) == (0.1, about.half_diagonal)


def test_every_fault_of_a_table_is_told(tmp_path: Path) -> None:
    path = tmp_path / "prior.csv"
    path.write_text(
        "parameter,low,high\nweight,1,2\nslenderness,0.2,0.1\ntilt,a,0\nhalf_diagonal,1,2\n"
        "half_diagonal,1,2\n"
    )
    with pytest.raises(InputError) as caught:
        read_prior(path)
    lines = str(caught.value).splitlines()
    assert [line.split(": ")[0].split(", ")[1] for line in lines] == [
        "line 2",
        "line 3",
        "line 4",
        "line 6",
    ]


def test_a_table_of_something_else(tmp_path: Path) -> None:
    path = tmp_path / "prior.csv"
    path.write_text("name,height\nshelf,1.8\n")
    with pytest.raises(InputError, match="accepted columns: parameter, low, high, distribution"):
        read_prior(path)
