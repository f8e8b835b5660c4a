"""What recordings depart by from a function."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import norm

from shaketable import Body, InputError, Motion, fragility, suite
from shaketable.fragility import efficiency, residuals
from shaketable.fragility.residuals import recording_residuals
from shaketable.plot import plot_residuals

BOOKCASE = Body.rectangle(0.32, 1.8, name="bookcase")


@pytest.fixture(scope="module")
def far_field() -> list[Motion]:
    return suite("fema-p695-far-field")


def test_residuals_of_recordings(far_field: list[Motion]) -> None:
    """Each recording's own median gives as many falls as it had; names and sources beside it."""
    curve = fragility(BOOKCASE, far_field, draws=0).curve
    found = recording_residuals(curve)
    data = curve.data
    for number in (0, 7, 21):
        own = data.recording == number
        share = type(curve).probability(curve, data.intensity[own] / np.exp(found[number]))
        assert (data.trials[own] * share).sum() == pytest.approx(data.reached[own].sum(), abs=1e-6)
    table = residuals(curve, far_field)
    assert len(table) == 22
    row = table.set_index("recording").loc["NORTHR MUL"]
    assert (row["magnitude"], row["distance"]) == pytest.approx((6.7, 17.2))  # FEMA P-695, A-4
    # their spread is that between recordings, less than β, which holds what is within, too
    assert 0.5 * curve.beta < table["residual"].std() < curve.beta
    # what is not known of an object is none of the recordings'
    assert recording_residuals(replace(curve, more_beta=0.5)) == pytest.approx(found)


def test_residuals_follow_what_efficiency_tells(far_field: list[Motion]) -> None:
    """PGD is not sufficient: strong earthquakes move farther without overturning more."""
    curve = fragility(BOOKCASE, far_field, measure="PGD", draws=0).curve
    table = residuals(curve, far_field).dropna()
    slope = np.polyfit(table["magnitude"], table["residual"], 1)[0]
    told = efficiency(BOOKCASE, far_field, ("PGD",), draws=0).iloc[0]
    assert slope > 0.0
    assert told["magnitude_effect"] > 0.0
    assert told["magnitude_p"] < 0.01
    labels = [ax.get_xlabel() for ax in plot_residuals(table).axes]
    assert labels == [
        "significant duration D5-95 [s]", "magnitude", "distance to the rupture [km]",
    ]  # fmt: skip


def test_a_recording_that_always_falls_has_none(far_field: list[Motion]) -> None:
    some = [far_field[0].scaled(50.0), *far_field[2:20]]
    curve = fragility(BOOKCASE, some, scales=(0.5, 1.0, 2.0), draws=0).curve
    found = recording_residuals(curve)
    assert np.isnan(found[0])
    assert np.isfinite(found[1:]).any()
    ida = fragility(BOOKCASE, far_field[:6], method="ida", draws=0).curve
    own = np.log(ida.data.level / ida.median)
    means = [own[k : k + 4].mean() for k in (0, 4, 8)]
    assert recording_residuals(ida) == pytest.approx(means)


def test_levels_that_were_not_reached_are_higher(far_field: list[Motion]) -> None:
    """A truncated IDA's residuals are those of censored levels: none is dropped but what has none.

    With β fixed the score of a recording is the sum of z where a level is known, and of the mean
    of a normal above z where only a limit is.
    """
    curve = fragility(BOOKCASE, far_field, method="truncated ida", highest=0.35, draws=0).curve
    found, data = recording_residuals(curve), curve.data
    for number in range(22):
        own = data.recording == number
        if not data.reached[own].any():
            assert np.isnan(found[number])
            continue
        z = (np.log(data.level[own] / curve.median) - found[number]) / curve.beta
        score = np.where(data.reached[own], z, norm.pdf(z) / norm.sf(z)).sum()
        assert score == pytest.approx(0.0, abs=1e-9)


def test_other_motions_are_refused(far_field: list[Motion]) -> None:
    curve = fragility(BOOKCASE, far_field, draws=0).curve
    for others in (far_field[::-1], far_field[:4]):
        with pytest.raises(InputError, match="must be those that the curve was fitted to"):
            residuals(curve, others)


def test_without_a_source_only_the_duration_is_known() -> None:
    rng = np.random.default_rng(3)
    motions = [Motion(3.0 * rng.standard_normal(800), 0.02, name=str(k)) for k in range(4)]
    curve = fragility(BOOKCASE, motions, scales=(0.5, 1.0, 2.0, 4.0), draws=0).curve
    assert list(residuals(curve, motions)) == [
        "body", "limit_state", "measure", "recording", "residual", "D5-95",
    ]  # fmt: skip
