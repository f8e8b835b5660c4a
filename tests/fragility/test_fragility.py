"""Fragility functions of bodies, intensities of runs, limit states."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, run_campaign, simulate_many, suite
from shaketable.fragility import fragility, with_intensities
from shaketable.fragility.counts import count_stripes
from shaketable.fragility.limit_states import limit_state, limit_states
from shaketable.signal import intensity_measures
from shaketable.signal.intensity import measure_named
from shaketable.synthesis import one_sine

BOOKCASE = Body.rectangle(0.32, 1.80, name="bookcase")
SCALES = (0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0)


@pytest.fixture(scope="module")
def far_field() -> list[Motion]:
    return suite("fema-p695-far-field")


@pytest.mark.parametrize(
    ("measure", "median", "beta"), [("PGA", 3.908, 0.483), ("PGV", 0.4258, 0.448)]
)
def test_a_bookcase(far_field: list[Motion], measure: str, median: float, beta: float) -> None:
    """Numbers found by an independent maximum likelihood; 1 % is that of the digits printed."""
    found = fragility(BOOKCASE, far_field, measure=measure, scales=SCALES)
    assert found.median == pytest.approx(median, rel=0.01)
    assert found.beta == pytest.approx(beta, rel=0.01)
    low, high = found.median_interval
    assert low < found.median < high
    assert found.probability([found.median]) == pytest.approx([0.5])
    at = np.array([0.5, 1.0, 2.0]) * found.median
    below, above = found.curve.band(at)
    assert (below < found.probability(at)).all()
    assert (found.probability(at) < above).all()
    assert (found.curve.recordings, found.curve.events) == (22, 14)


def test_the_fit_depends_on_the_levels_chosen(far_field: list[Motion]) -> None:
    """The truth is not quite lognormal: pooled fits of other scales have other β."""
    sets = [SCALES, (0.5, 1.0, 1.5), (0.25, 0.5, 1.0, 2.0, 4.0, 8.0), (1.0, 2.0, 3.0)]
    betas = [fragility(BOOKCASE, far_field, scales=one).beta for one in sets]
    assert max(betas) / min(betas) > 1.1


def test_scales_by_themselves(far_field: list[Motion]) -> None:
    found = fragility(BOOKCASE, far_field)
    runs = simulate_many([BOOKCASE], far_field, scales=found.scales, progress=False)
    share = (runs.outcome != 0).mean(["motion", "polarity"]).values.ravel()
    assert share[0] < 0.02 < share[1]
    assert share[-2] < 0.98 < share[-1]


def test_scales_span_all_states(far_field: list[Motion]) -> None:
    """However the states are ordered; uplift alone would end where hardly anything falls."""
    both = [
        fragility(BOOKCASE, far_field, limit_states=states, draws=0)
        for states in (("uplift", "overturns"), ("overturns", "uplift"))
    ]
    assert both[0].scales.tolist() == both[1].scales.tolist()
    assert both[0].median.ravel() == pytest.approx(both[1].median.ravel()[::-1])
    assert both[0].scales[-1] >= fragility(BOOKCASE, far_field, draws=0).scales[-1]


def test_runs_of_before(far_field: list[Motion], tmp_path: Path) -> None:
    """A cloud from stored simulations is that of new ones, on the tilt that is asked for."""
    motions = far_field[:12]
    bodies = [BOOKCASE, Body.rectangle(0.4, 1.2, name="cabinet")]
    given = {"limit_states": ("rocks 0.5 α", "overturns"), "tilt": 0.02, "draws": 0}
    stored = run_campaign(
        bodies, motions, store=tmp_path / "store", tilts=[0.0, 0.02], scales=SCALES, progress=False
    )
    new = fragility(bodies, motions, scales=SCALES, **given)
    old = fragility(bodies, motions, runs=stored, **given)
    assert old.median.tolist() == new.median.tolist()
    assert [curve.falls for curve in old.curves] == [curve.falls for curve in new.curves]
    assert old.scales.tolist() == list(SCALES)
    for wrong, message in (
        ({"tilt": 0.01}, "on no tilt of 0.01 rad"),
        ({"polarities": [1]}, "runs= have polarities of their own"),
        ({"scales": [1.0]}, "runs= have scales of their own"),
        ({"model": "general"}, "runs= were simulated with Rocking"),
        ({"method": "ida", "tilt": 0.0, "limit_states": "overturns"}, "runs= is not for method="),
    ):
        with pytest.raises(InputError, match=message):
            fragility(bodies, motions, runs=stored, **{**given, **wrong})
    with pytest.raises(InputError, match="runs= are of other bodies, or in another order: 2"):
        fragility(BOOKCASE, motions, runs=stored)
    with pytest.raises(InputError, match="runs= are of other bodies"):
        fragility(bodies[::-1], motions, runs=stored, **given)
    with pytest.raises(InputError, match="runs= are of other motions"):
        fragility(bodies, motions[::-1], runs=stored, **given)
    undone = stored.assign(done=stored.outcome.copy(data=stored.outcome.values == 0))
    with pytest.raises(InputError, match="runs= are not all done"):
        fragility(bodies, motions, runs=undone, **given)
    with pytest.raises(InputError, match="runs= were simulated with None"):
        fragility(bodies, motions, runs=stored.drop_attrs(), **given)
    strange = stored.assign(outcome=stored.outcome.where(stored.outcome == 0, 9))
    with pytest.raises(InputError, match="outcomes that are none: 9"):
        fragility(bodies, motions, runs=strange, **given)
    with pytest.raises(InputError, match="the runs hold no peak_rotation"):
        fragility(bodies, motions, runs=stored.drop_vars("peak_rotation"), **given)
    with pytest.raises(InputError, match="must be over body, motion, polarity, tilt, scale"):
        fragility(bodies, motions, runs=stored.isel(scale=0), **given)


def test_plot(far_field: list[Motion]) -> None:
    found = fragility(BOOKCASE, far_field, limit_states=("uplift", "overturns"), draws=20)
    ax = found.plot()
    assert ax.get_xlabel() == "PGV [cm/s]"
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels[1] == f"overturns: θ {100 * found.curves[1].median:.3g}, β {found.beta[0, 1]:.2f}"
    other = ax.figure.subplots()
    assert found.plot(other) is other


@pytest.mark.slow
def test_other_methods(far_field: list[Motion]) -> None:
    """All are of one truth; the lowest falls of an IDA lie furthest away, 19 % to the left."""
    cloud = fragility(BOOKCASE, far_field, draws=0)
    found = [
        fragility(BOOKCASE, far_field, draws=0, **given)
        for given in (
            {"method": "stripes", "levels": (0.2, 0.3, 0.4, 0.6, 0.8)},
            {"method": "ida"},
            {"method": "truncated ida", "highest": 0.5},
        )
    ]
    for one in found:
        assert one.median == pytest.approx(cloud.median, rel=0.2)
        assert 0.2 < one.beta < 0.5
    # an IDA takes the lowest fall, whatever the body survives above it
    assert found[1].median < cloud.median


def test_an_ida_that_ends_too_early_tells_no_median(far_field: list[Motion]) -> None:
    found = fragility(BOOKCASE, far_field, method="truncated ida", highest=0.21, draws=0)
    assert "PGV = 21 cm/s" in found.curve.problem
    assert np.isnan(found.median)


def test_stripes_are_at_their_levels(far_field: list[Motion]) -> None:
    found = fragility(
        BOOKCASE, far_field[:6], measure="SA(1.0)", method="stripes", levels=(2.0, 4.0), draws=0
    )
    scaled = [
        motion.scaled(4.0 / intensity_measures(motion)["SA(1.0)"]) for motion in far_field[:6]
    ]
    runs = simulate_many([BOOKCASE], scaled, progress=False)
    falls = (runs.outcome != 0).sum(["polarity"]).values.ravel()
    assert found.curve.data.reached[1::2].tolist() == falls.tolist()


def test_several_bodies_and_states(far_field: list[Motion]) -> None:
    bodies = [BOOKCASE, Body.rectangle(0.5, 1.5)]
    states = ("uplift", "rocks 0.5 α", "overturns")
    found = fragility(bodies, far_field, limit_states=states, draws=50)
    assert found.median.shape == found.beta.shape == (2, 3)
    assert found.median_interval.shape == (2, 3, 2)
    assert found.probability([0.2, 0.4]).shape == (2, 3, 2)
    assert (np.diff(found.median, axis=1) > 0.0).all()  # what is worse takes more
    assert (found.median[1] > found.median[0]).all()
    table = found.table()
    assert table["limit_state"].tolist() == 2 * list(states)
    assert table["median"].values == pytest.approx(found.median.ravel())
    with pytest.raises(InputError, match=r"there are 6 curves, of 2 bodies and 3 limit states"):
        _ = found.curve


def test_slip_and_directions(far_field: list[Motion]) -> None:
    model = General(static_friction=0.3)
    found = fragility(
        BOOKCASE, far_field[:20], limit_states="slides 0.05 m", model=model, draws=20, tilt=0.03
    )
    assert 0.0 < found.median < 2.0
    slender = fragility(BOOKCASE, far_field, tilt=0.05, draws=0).curve
    assert slender.downhill > 0.8  # theory, section 1: the tilt decides
    assert sum(slender.falls) == slender.data.reached.sum()
    with pytest.raises(InputError, match="the rocking model knows no slip"):
        fragility(BOOKCASE, far_field[:2], limit_states="slides 0.05 m", scales=(1.0,))


@pytest.mark.parametrize(
    ("scales", "said"),
    [
        (
            (0.05, 0.1),
            r"no simulation reaches overturns, up to PGV = .* cm/s: the median lies above",
        ),
        ((8.0, 9.0), "every simulation reaches overturns, from PGV = .* the median lies below"),
        ((0.1, 9.0), "every simulation from PGV = .* the median lies between, and β is not known"),
    ],
)
def test_bounds_in_place_of_a_fit(
    far_field: list[Motion], caplog: pytest.LogCaptureFixture, scales: tuple[float, ...], said: str
) -> None:
    found = fragility(Body.rectangle(0.2, 1.8), far_field, scales=scales)
    assert re.search(said, found.curve.problem)
    assert found.curve.problem in caplog.text
    assert np.isnan([found.median, found.beta, *found.median_interval]).all()


def test_what_lies_beyond_all_shaking_is_not_told(far_field: list[Motion]) -> None:
    """One recording overturns it, in both directions: a fit would lie beyond all shaking."""
    found = fragility(BOOKCASE, far_field, scales=(0.25, 0.5), draws=0)
    assert found.curve.data.reached.sum() == 2
    assert found.curve.fits.median[0] > found.curve.data.intensity.max()
    assert np.isnan([found.median, found.beta, *found.probability([0.4])]).all()
    assert "only 1 of 22 recordings reach overturns, too few to tell" in found.curve.problem


def test_few_recordings_are_cautioned(far_field: list[Motion]) -> None:
    """Where fewer than half of them ever reach a state the curve is mostly extrapolated."""
    found = fragility(BOOKCASE, far_field, scales=(0.4, 0.6), draws=0).curve
    assert 3 <= found.reached_by < 11
    assert f"only {found.reached_by} of 22 recordings reach overturns: the upper" in found.caution
    assert not fragility(BOOKCASE, far_field, draws=0).curve.caution


def test_one_mixed_level_tells_no_beta(far_field: list[Motion]) -> None:
    """The largest likelihood is that of a step at the level, not of a falling function."""
    found = fragility(
        BOOKCASE, far_field, method="stripes", levels=(0.05, 0.35, 2.5), draws=0
    ).curve
    assert found.fits.beta[0] == 0.0
    assert found.fits.median[0] == pytest.approx(0.35)
    assert "differ at PGV = 35 cm/s alone, which is about the median" in found.problem


def test_strange_scales_are_told(far_field: list[Motion], caplog: pytest.LogCaptureFixture) -> None:
    fragility(BOOKCASE, far_field[:2], scales=(1.0, 20.0), draws=0)
    assert "scaled by up to 20: beyond 10 what shakes is hardly an earthquake" in caplog.text


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"measure": "PGW"}, "unknown intensity measure 'PGW'; accepted: PGA, PGV"),
        ({"measure": "SA(x)"}, r"unknown intensity measure 'SA\(x\)'"),
        ({"measure": "Tm", "method": "stripes", "levels": [1.0]}, "does not grow with the motion"),
        ({"limit_states": "topples"}, "unknown limit state 'topples'; accepted: overturns, uplift"),
        ({"limit_states": ("uplift", "uplift")}, "one is there twice"),
        ({"limit_states": ()}, "limit_states= is empty"),
        ({"method": "clouds"}, "method= must be one of cloud, stripes, ida, truncated ida"),
        ({"method": "stripes"}, "takes levels="),
        ({"method": "truncated ida"}, "takes highest="),
        ({"method": "ida", "scales": [1.0]}, "scales= is not for method='ida'"),
        ({"method": "ida", "limit_states": "uplift"}, "for the limit state 'overturns' alone"),
        ({"method": "ida", "tilt": 0.1}, "is for a level support"),
        ({"method": "ida", "components": "geometric mean"}, "scales each component by itself"),
        ({"method": "stripes", "levels": [0.0, 1.0]}, "must be above 0"),
        ({"components": "both"}, "components= must be one of own, geometric mean"),
        ({"seed": -1}, "a seed must not be negative"),
    ],
)
def test_bad_input(far_field: list[Motion], given: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        fragility(BOOKCASE, far_field[:4], **given)


def test_intensities_of_runs(far_field: list[Motion]) -> None:
    some, scales = far_field[:4], (0.5, 2.0)
    runs = simulate_many([BOOKCASE], some, scales=scales, progress=False)
    names = ("PGA", "SA(0.5)", "AvgSA(1.0)", "Arias", "D5-95", "Dbracketed")
    found = with_intensities(runs, some, names)
    for k, motion in enumerate(some):
        for j, scale in enumerate(scales):
            known = intensity_measures(motion.scaled(scale), sa=(0.5,), average_sa=(1.0,))
            for name in names:
                assert found[name].values[k, j] == pytest.approx(known[name], rel=1e-9)
    assert found["SA(0.5)"].attrs["units"] == "m/s2"
    both = with_intensities(runs, some, ["PGV"], components="geometric mean")["PGV"].values
    own = with_intensities(runs, some, ["PGV"])["PGV"].values
    assert both[0] == pytest.approx(np.sqrt(own[0] * own[1]))  # two components of a station
    assert both[0] == pytest.approx(both[1])
    with pytest.raises(InputError, match="must be those of the runs: 4 of them, got 3"):
        with_intensities(runs, some[:3], ["PGA"])


def test_limit_states_are_written_as_they_are_read() -> None:
    for text in ("overturns", "uplift", "rocks 0.5 α", "slides 0.1 m"):
        assert limit_state(text).name == text
    assert limit_state("rocks 0.5 alpha") == limit_state("rocks 0.5 α")
    assert [one.kind for one in limit_states("uplift")] == ["uplift"]
    for text in ("rocks 0.5 m", "slides 0.1", "slides -1 m", "rocks 1e α", "slides 0 m"):
        with pytest.raises(InputError, match="unknown limit state"):
            limit_state(text)


def test_stripes_of_a_measure_that_grows_with_the_square_of_the_motion() -> None:
    """Levels of the Arias intensity four times that of a motion are its double."""
    motions = [one_sine(size, 0.9) for size in (1.6, 2.3)]
    once = np.array([intensity_measures(each)["Arias"] for each in motions])
    measure = measure_named("Arias")
    assert measure.power == 2
    bodies = [Body.rectangle(0.3, 1.7), Body.rectangle(0.45, 1.5)]
    levels = np.array([0.5, 2.7, 9.1])
    counts = count_stripes(
        bodies, motions, [limit_state("uplift"), limit_state("overturns")], measure, once, levels,
        0.0, False, {"model": None},
    )  # fmt: skip
    expected = np.zeros((2, 2, 2, 3))
    for m, motion in enumerate(motions):
        for k, level in enumerate(levels):
            runs = simulate_many(
                bodies, [motion.scaled(math.sqrt(level / once[m]))], progress=False
            )
            fell = runs.outcome.values != 0
            expected[:, 0, m, k] = (fell | (runs.peak_rotation.values > 0.0)).sum(axis=(1, 2, 3, 4))
            expected[:, 1, m, k] = fell.sum(axis=(1, 2, 3, 4))
    assert counts.reached.tolist() == expected.tolist()
    assert 0.0 < expected[:, 1].mean() < 2.0  # some fall, and some do not
