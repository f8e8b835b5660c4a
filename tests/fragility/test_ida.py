"""The lowest levels that overturn, and what is survived above them."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, simulate_many
from shaketable.fragility import ida
from shaketable.fragility.capacities import tipping_scales
from shaketable.signal import intensity_measures
from tests.support.builders import TABLE_1


def test_capacities_against_a_plain_scan(p695: list[Motion]) -> None:
    """No fall at any of the levels in steps of 1 % below; a bisected one is as high at most."""
    bodies, some = [Body.rectangle(*size) for size in TABLE_1[:4]], p695[::10]
    found, finer = ida(bodies, some), ida(bodies, some, precision=1e-4)
    assert found.sizes == {"body": 4, "motion": 10, "polarity": 2}
    slender = min(body.slenderness_right for body in bodies)
    for m, motion in enumerate(some):
        least = np.tan(slender) * 9.80665 / np.abs(motion.horizontal).max()
        at = found["scale"][:, m].values
        levels = least * 1.01 ** np.arange(np.ceil(np.log(at.max() / least) / np.log(1.01)) + 1)
        runs = simulate_many(bodies, [motion], scales=levels, progress=False)
        fallen = (runs.outcome != 0).isel(motion=0, tilt=0).transpose("body", "polarity", "scale")
        first = levels[fallen.values.argmax(axis=-1)]
        # the coarse scan may have met a fall between two levels of the fine one
        coarse = np.log(at / least) / np.log(1.05)
        assert (np.isclose(at, first) | (at < first) & np.isclose(coarse, coarse.round())).all()
        better = finer["scale"][:, m].values
        assert (better <= at).all()
        assert (better > at / 1.0101).all()
        pgv = intensity_measures(motion)["PGV"]
        assert found["capacity"][:, m].values == pytest.approx(at * pgv)


def test_a_bisected_capacity_overturns_and_a_little_less_does_not(p695: list[Motion]) -> None:
    body = Body.rectangle(0.32, 1.8)
    found = ida(body, p695[:3], precision=1e-5)
    for m, motion in enumerate(p695[:3]):
        for p, sign in enumerate((1, -1)):
            at = float(found["scale"][0, m, p])
            for scale, falls in ((at, True), (at / (1.0 + 1e-5), False)):
                runs = simulate_many(
                    [body], [motion], scales=[scale], polarities=[sign], progress=False
                )
                assert bool(runs.outcome.values.any()) is falls


def test_a_vertical_component_lets_it_tip_earlier() -> None:
    """Below the least scale no sample asks for more than the friction cone of tipping."""
    time = np.arange(0.0, 4.0, 0.01)
    push, lift = 3.0 * np.sin(4.0 * time), -4.0 * np.sin(4.0 * time)
    motion, body = Motion(push, 0.01, vertical=lift), Body.rectangle(0.32, 1.8)
    least = float(tipping_scales([body], motion)[0])
    for scale, moves in ((0.999 * least, False), (1.01 * least, True)):
        runs = simulate_many([body], [motion], scales=[scale], progress=False)
        assert bool((runs.peak_rotation > 0.0).any()) is moves
    assert np.isfinite(ida(body, [motion])["capacity"]).all()


def test_what_is_survived_above_it(p695: list[Motion]) -> None:
    """Counted against a plain scan of the same levels."""
    body = Body.rectangle(0.32, 1.8)
    found = ida(body, p695[:6], "PGA", multiple=8.0)
    assert int(found["survived"].sum()) > 0
    for m, motion in enumerate(p695[:6]):
        least = np.tan(body.slenderness_right) * 9.80665 / np.abs(motion.horizontal).max()
        levels = least * 1.05 ** np.arange(np.ceil(np.log(8.0) / np.log(1.05)) + 1)
        runs = simulate_many([body], [motion], scales=levels, progress=False)
        stands = (runs.outcome == 0).isel(body=0, motion=0, tilt=0).transpose("polarity", "scale")
        for p in range(2):
            here = stands.values[p]
            above = np.flatnonzero(here & (np.arange(here.size) > here.argmin()))
            assert int(found["survived"][0, m, p]) == above.size
            highest = float(found["highest_survived"][0, m, p])
            if above.size:
                peak = intensity_measures(motion)["PGA"]
                assert highest == pytest.approx(levels[above[-1]] * peak)
            else:
                assert np.isnan(highest)


def test_levels_of_a_measure(p695: list[Motion], caplog: pytest.LogCaptureFixture) -> None:
    body = Body.rectangle(0.32, 1.8)
    found = ida(body, p695[:8], "PGV", levels=[0.1, 0.3, 0.5])
    told = found["capacity"].values
    assert np.isin(np.round(told, 9), [0.1, 0.3, 0.5, np.inf]).all()
    assert np.isinf(told).any()
    assert "motions did not overturn a body at any level that was tried" in caplog.text


def test_bad_input(p695: list[Motion]) -> None:
    body = Body.rectangle(0.32, 1.8)
    for given, said in (
        ({"measure": "Tm"}, "does not grow with the motion"),
        ({"levels": "hunt"}, "levels= must be 'hunt & fill' or levels"),
        ({"levels": [-1.0]}, "levels= must be above 0"),
        ({"precision": 0.0}, "precision must lie between"),
        ({"multiple": 0.5}, "multiple must be above 1"),
    ):
        with pytest.raises(InputError, match=said):
            ida(body, p695[:1], **given)
    with pytest.raises(InputError, match="its PGV is zero"):
        ida(body, [Motion([0.0, 0.0], 0.01, name="still")])
