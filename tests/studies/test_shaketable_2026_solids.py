"""What the third dimension changes, on a few of FEMA P-695's pairs."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from shaketable import InputError, Motion, Outcome, Solid, simulate_many
from shaketable.study import NO, OPEN, YES, Study, StudyInput, installed_studies
from shaketable_studies.shaketable_2026_solids import losses, shares
from shaketable_studies.shaketable_2026_solids.claims import _best, _control, _more
from shaketable_studies.shaketable_2026_solids.direction import TILTS
from shaketable_studies.shaketable_2026_solids.losses import CHANGES
from shaketable_studies.shaketable_2026_solids.measures import _area, measures_of
from shaketable_studies.shaketable_2026_solids.setting import MODEL, SIZES, components, pairs_of

FEW = 3  # recordings


@pytest.fixture(scope="module")
def some(p695: list[Motion]) -> list[Motion]:
    return p695[: 2 * FEW]


# all that ask for it are slow: it takes 12 s
@pytest.fixture(scope="module", params=[pytest.param("", marks=pytest.mark.slow)])
def study(some: list[Motion]) -> Study:
    given = StudyInput(motions=some, description="FEMA P-695", progress=False)
    return installed_studies()["shaketable-2026-solids"].do(given)


def test_shares_are_those_of_the_simulations(study: Study, some: list[Motion]) -> None:
    pairs = pairs_of(some, 0)
    assert len(pairs.motions) == FEW
    table = study.tables["shares"].set_index(["case", "scale", "size"])["fall_share"]
    size = SIZES[1]
    turns = np.radians([0.0, 22.5, 45.0, 67.5])
    square = simulate_many(
        [Solid.box(size.base, size.base, size.height)], pairs.motions, scales=[0.5],
        orientations=turns, model=MODEL, progress=False,
    )  # fmt: skip
    known = float((square.outcome != Outcome.STANDING).mean())
    assert table["square", 0.5, size.body.name] == pytest.approx(known)
    plane = simulate_many(
        [size.body], [*components(pairs)[0], *components(pairs)[1]], model=MODEL, progress=False
    )
    fell = (plane.outcome != Outcome.STANDING).values[0, :, :, 0, 0].reshape(2, FEW, 2)
    assert table["one component", 1.0, size.body.name] == pytest.approx(fell.mean())
    either = fell.any(axis=0).mean()
    assert table["either component", 1.0, size.body.name] == pytest.approx(either)
    peak = np.array([[np.abs(m.horizontal).max() for m in each] for each in components(pairs)])
    stronger = np.mean([fell[k, n] for n, k in enumerate(peak.argmax(axis=0))])
    assert table["the stronger component", 1.0, size.body.name] == pytest.approx(stronger)


def test_directions_are_those_of_the_body(study: Study, some: list[Motion]) -> None:
    """Tilted by 90° from its width an oblong box leans along its length."""
    table = study.tables["direction"].set_index(["base", "direction_deg"])
    here = table.loc[("oblong", 90.0)]
    pairs = pairs_of(some, 0)
    sizes = [SIZES[k] for k in (1, 4, 8, 11)]
    turned = simulate_many(  # the same with its length along x
        [Solid.box(2 * size.base, size.base, size.height) for size in sizes], pairs.motions,
        tilts=TILTS, model=MODEL, progress=False,
    )  # fmt: skip
    falls = (turned.outcome != Outcome.STANDING).sum(["body", "motion", "polarity", "scale"])
    # the inertia is that of the turned box; round-off decides a few falls otherwise
    assert here["falls"].to_numpy() == pytest.approx(falls.values.ravel(), abs=4)
    assert here["straight"].iloc[-1] < 0.1  # it falls over its long side


def test_pictures_and_claims(study: Study) -> None:
    claims = study.tables["claims"]
    assert len(claims) == 10 + 8 + 2
    assert set(claims["holds"]) <= {YES, NO, OPEN}
    drawn = dict(installed_studies()["shaketable-2026-solids"].figures(study))
    assert set(drawn) == {"direction", "shares", "losses", "measures"}
    assert f"{FEW} motions of {FEW} recordings" in study.records


def test_losses_are_those_of_the_simulations(study: Study, some: list[Motion]) -> None:
    """One row of the table, from the public functions; each change changes something."""
    table = study.tables["losses"].set_index(["changed", "case", "over", "scale"])["ratio"]
    pairs = pairs_of(some, 0)
    boxes = [Solid.box(size.base, size.base, size.height) for size in SIZES]
    drums = [Solid.cylinder(size.base, size.height, rolling_friction=0.003) for size in SIZES]
    shares = [
        (simulate_many(solids, pairs.motions, model=MODEL, progress=False, **ways).outcome
         != Outcome.STANDING).values.mean()
        for solids, ways in (
            (boxes, {"orientations": np.radians([0.0, 45.0])}), (drums, {"polarities": [1]})
        )
    ]  # fmt: skip
    known = shares[1] / shares[0]
    assert table["rims roll with 3 mm", "round", "square", 1.0] == pytest.approx(known)
    assert len(table) == len(CHANGES) * 3 * 2
    by_change = {tuple(rows.round(9)) for _, rows in table.groupby("changed")}
    assert len(by_change) == len(CHANGES)


@pytest.mark.slow  # 6 s; meters of assessments and campaigns are quick
def test_the_meter_ends_where_it_should(some: list[Motion]) -> None:
    """As many simulations are told as were announced."""
    pairs = pairs_of(some[:2], 0)
    for part in (shares, losses):
        told: list[int] = []
        (shares.all_falls if part is shares else losses.losses)(pairs, told.append)  # type: ignore[operator]
        assert sum(told) == part.simulations(len(pairs.motions))


def test_verdicts_come_out_either_way() -> None:
    def control(low: float, high: float) -> str:
        row = {
            "base": "square", "direction_deg": 0.0, "tilt_deg": (low + high) / 2,
            "tilt_low_deg": low, "tilt_high_deg": high, "straight_at_5_deg": 0.6,
        }  # fmt: skip
        return _control(row).holds

    assert [control(3, 5), control(5, 6), control(6, math.inf)] == [YES, OPEN, NO]

    def more(low: float, high: float) -> str:
        row = {"case": "round", "over": "square", "scale": 1.0, "ratio": 1.0}
        return _more({**row, "low": low, "high": high}).holds

    assert [more(1.1, 2), more(0.9, 1.1), more(0.5, 0.9)] == [YES, OPEN, NO]

    def best(low: float, high: float) -> str:
        rows = [("geometric mean", low, high), ("RotD100", 0.0, 0.0)]
        names = ["of_the_pair", "more_low", "more_high"]
        table = pd.DataFrame(rows, columns=names).assign(of_the_ground="PGA", area=0.9)
        return _best(table, "PGA").holds

    assert [best(-0.2, -0.1), best(-0.1, 0.1), best(0.1, 0.2)] == [YES, OPEN, NO]


def test_the_area_is_that_of_the_roc_curve() -> None:
    """Against scikit-learn, with outcomes that are whole."""
    from sklearn.metrics import roc_auc_score

    rng = np.random.default_rng(0)
    values, fell = rng.normal(size=(30, 2)), rng.random((30, 2)) < 0.4
    weights = np.vstack([np.ones(30), rng.integers(0, 3, 30)])
    found = _area(values, fell.astype(float), weights)
    each = np.repeat(weights[1], 2)
    assert found[0] == pytest.approx(roc_auc_score(fell.ravel(), values.ravel()))
    known = roc_auc_score(fell.ravel(), values.ravel(), sample_weight=each)
    assert found[1] == pytest.approx(known)


def test_measures_of_a_pair() -> None:
    """A component alone: its mean with nothing is nothing, and in all directions |cos|."""
    x = np.sin(np.linspace(0, 2 * math.pi, 200))
    found = measures_of(Motion(x, 0.01, transverse=0 * x))
    assert found["PGA", "stronger component"] == found["PGA", "RotD100"]
    assert found["PGA", "geometric mean"] == pytest.approx(0.0, abs=1e-7)
    assert found["PGA", "RotD50"] == pytest.approx(found["PGA", "RotD100"] / math.sqrt(2), rel=0.01)
    assert found["PGV", "RotD100"] > 0.0


def test_without_a_pair_there_is_no_study(some: list[Motion]) -> None:
    with pytest.raises(InputError, match="needs both horizontal components"):
        pairs_of(some[:1], 0)
