"""Functions of simulations of which the truth is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from shaketable import Motion
from shaketable.fragility.limit_states import LimitState, limit_state
from shaketable.fragility.lognormal import Points
from shaketable.library.case import Case, Held, Stand
from shaketable.library.draws import draws_of
from shaketable.library.effects import Effects, _squares, drawn_beta, effects_of
from shaketable.library.fitted import MOVING, TESTS, Shaking, functions_of_case
from shaketable.library.measures import levels_of
from shaketable.library.shaken import CaseRuns
from shaketable.library.states import has_state, reached
from shaketable.library.table import COLUMNS, table_of
from shaketable.library.thing import LibraryThing
from shaketable.origin import Origin
from shaketable.signal import measure_named

CASE = Case(thing=LibraryThing(kind="bookcase"), stand=Stand(), held=Held(draws=8))
MEDIAN, MOTIONS, CG = 0.8, 0.3, 0.15  # m/s, β of motions, effect of the centre of gravity
SCALES = np.geomspace(0.2, 5.0, 8)


@pytest.fixture(scope="module")
def ground() -> list[Motion]:
    """Forty recordings of twenty earthquakes: sines of about 1 m/s, in both directions alike."""
    t = 0.01 * np.arange(300)
    found = []
    for k in range(40):
        wave = (1.0 + 0.01 * k) * 2 * np.pi * np.cos(2 * np.pi * t) * np.sin(np.pi * t / t[-1])
        origin = Origin(event=f"earthquake {k // 2}", station=f"station {k}")
        found.append(
            Motion(wave, 0.01, transverse=wave, name=f"m{k}", origin=origin,
                   transverse_origin=origin)
        )  # fmt: skip
    return found


def simulated(ground: list[Motion], seed: int = 1) -> CaseRuns:
    """Outcomes whose capacity is lognormal over motions, and lower with a higher centre."""
    random = np.random.default_rng(seed)
    draws = draws_of(CASE, CASE.held.draws * len(ground), 0)
    draw = np.repeat(np.arange(len(draws.each), dtype=np.int32), SCALES.size)
    scale = np.tile(SCALES, len(draws.each))
    level = levels_of(measure_named("PGV"), ground)[draw % len(ground)] * scale
    of_motion = random.normal(size=len(ground))[draw % len(ground)]
    own = random.normal(size=draw.size)
    cg = draws.standard[draws.parameters.index("cg_height"), draw]
    spread = MOTIONS * (np.sqrt(0.5) * of_motion + np.sqrt(0.5) * own)
    fell = np.log(level / MEDIAN) > spread - CG * cg
    none = np.zeros(draw.size, np.float32)
    return CaseRuns(
        draw=draw, scale=scale, fell=fell, held_up=fell & False, off=fell & False,
        rotation=np.where(fell, 1.0, 0.0).astype(np.float32), farthest=none, reach=none,
        force=none, broke=fell & False, moving=np.arange(draw.size) % 20 == 0,
    )  # fmt: skip


def test_the_parts_of_beta_come_out_again(ground: list[Motion]) -> None:
    """θ is found to 10 %, four times its standard error of β_total/√40; β likewise."""
    found = functions_of_case(
        CASE, simulated(ground), Shaking(ground, draws=60), states=[LimitState("overturns")],
        measures=["PGV"],
    )  # fmt: skip
    (one,) = found
    assert one.curve.median == pytest.approx(MEDIAN, rel=0.15)
    assert one.curve.fits.beta[0] == pytest.approx(np.hypot(MOTIONS, CG), rel=0.15)
    assert one.curve.beta == pytest.approx(np.hypot(one.curve.fits.beta[0], TESTS))
    at = one.effects.parameters.index("cg_height")
    assert one.effects.slope[at] == pytest.approx(CG, abs=4 * one.effects.variance[at] ** 0.5)
    assert one.effects.variance[at] ** 0.5 < 0.03
    low, high = one.curve.median_interval
    assert low < MEDIAN < high
    row = table_of(found).iloc[0]
    assert row["beta_object"] == pytest.approx(CG, abs=0.05)
    parts = np.sqrt(row["beta_motions"] ** 2 + row["beta_object"] ** 2 + row["beta_model"] ** 2)
    assert parts == pytest.approx(row["beta"])
    assert (row["recordings"], row["events"], row["simulations"]) == (40, 20, 320 * 8)
    assert "5% of the simulations were given up" in row["caution"]
    assert MOVING < 0.05


def test_what_is_held_up_has_not_overturned_and_is_told(ground: list[Motion]) -> None:
    """A tenth of what stands is held up: the function of overturning is the same, and says so."""
    runs = simulated(ground)
    hanging = replace(runs, held_up=~runs.fell & (np.arange(runs.draw.size) % 10 == 0))
    shaking = Shaking(ground, draws=0)
    given = {"states": [limit_state("overturns"), limit_state("overturns or held up")],
             "measures": ["PGV"]}  # fmt: skip
    case = replace(CASE, held=Held(draws=8, wall_gap=0.01))
    before, _ = functions_of_case(case, runs, shaking, **given)
    falls, either = functions_of_case(case, hanging, shaking, **given)
    assert falls.curve.median == before.curve.median
    assert either.curve.median < falls.curve.median
    assert "see 'overturns or held up'" in falls.caution
    assert "held up" not in before.caution + either.caution
    rare = replace(runs, held_up=hanging.held_up & (runs.scale == SCALES[0]))
    falls, _ = functions_of_case(case, rare, shaking, **given)
    assert falls.held_up == pytest.approx(0.2)  # every fifth one at that factor


def test_a_function_below_one_that_it_includes_says_so(ground: list[Motion]) -> None:
    """All falls at strong shaking, three tenths are held up at weak ones: not lognormal."""
    runs = simulated(ground)
    runs = replace(runs, fell=runs.fell & (runs.scale > 1.0))
    weak = (runs.scale < 1.0) & (np.arange(runs.draw.size) % 10 < 3)
    given = {"states": [limit_state("overturns"), limit_state("overturns or held up")],
             "measures": ["PGV"]}  # fmt: skip
    case = replace(CASE, held=Held(draws=8, wall_gap=0.01))
    falls, either = functions_of_case(
        case, replace(runs, held_up=~runs.fell & weak), Shaking(ground, draws=0), **given
    )
    level = np.geomspace(0.1, 5.0, 500)
    more = (falls.curve.probability(level) - either.curve.probability(level)).max()
    assert either.crosses == pytest.approx(more, abs=0.01)
    assert "take the larger of both" in either.caution
    assert falls.crosses == 0.0


def test_a_median_above_all_motions_as_recorded_says_so(ground: list[Motion]) -> None:
    (one,) = functions_of_case(
        CASE, simulated(ground), Shaking(ground, draws=0), states=[limit_state("overturns")],
        measures=["PGV"],
    )  # fmt: skip
    strongest = levels_of(measure_named("PGV"), ground).max()
    assert one.scaled == pytest.approx(one.curve.median / strongest)
    assert "as recorded" not in one.caution
    assert "is 1.2 times the strongest motion as recorded" in replace(one, scaled=1.2).caution


def test_what_reaches_no_farther_is_no_extrapolation(ground: list[Motion]) -> None:
    (one,) = functions_of_case(
        CASE, simulated(ground), Shaking(ground, draws=0), states=[limit_state("overturns")],
        measures=["PGV"],
    )  # fmt: skip
    assert "an extrapolation" in replace(one, strongest=0.4).caution
    reaches = replace(one, strongest=0.4, state=limit_state("reaches 0.8 m"))
    assert "more need not do so at any level" in reaches.caution


def effects(slope: float, error: float, spread: float = 1.0) -> Effects:
    """The effect of the centre of gravity per unit of it; of restitution nothing is known."""
    return Effects(
        ("cg_height", "restitution"), np.array([spread, 1.0]),
        np.array([slope * spread, np.nan]), np.array([(error * spread) ** 2, np.nan]),
    )  # fmt: skip


def test_an_effect_by_itself_is_lessened_by_its_error() -> None:
    """By hand: √(0.5² - 0.3²) = 0.4; one that is not larger than its error counts as none."""
    (one,) = drawn_beta([effects(0.5, 0.3)])
    assert one.object == pytest.approx(0.4)
    assert one.model == 0.0
    assert drawn_beta([effects(0.1, 0.2)])[0].object == 0.0


def test_effects_that_agree_are_pooled() -> None:
    """By hand: 0.2 ± 0.1 and 0.3 ± 0.2 agree (Q = 0.2); their mean is 0.22 ± 0.0894."""
    known = np.sqrt(0.22**2 - 1.0 / (1.0 / 0.1**2 + 1.0 / 0.2**2))
    first, second = drawn_beta([effects(0.2, 0.1, 0.5), effects(0.3, 0.2, 2.0)])
    assert first.object == pytest.approx(0.5 * known)
    assert second.object == pytest.approx(2.0 * known)


def test_effects_that_differ_keep_their_own() -> None:
    """Friction decides whether a thing of low friction falls, and hardly whether a slender one."""
    large, small = drawn_beta([effects(0.65, 0.08), effects(0.01, 0.02)])
    assert large.object == pytest.approx(0.65, abs=0.05)
    assert small.object < 0.1


@pytest.mark.parametrize(("mean", "between"), [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.3, 0.2)])
def test_squares_of_effects_have_hardly_a_bias(mean: float, between: float) -> None:
    """Of ten cases, over 2,000 repetitions: within 6 % of the truth, or 0.0008 of none."""
    random = np.random.default_rng(1)
    found, truth = [], []
    for _ in range(2000):
        error = random.uniform(0.02, 0.1, 10)
        true = mean + between * random.normal(size=10)
        found.append(_squares(true + error * random.normal(size=10), error**2).mean())
        truth.append((true**2).mean())
    assert np.mean(found) == pytest.approx(np.mean(truth), rel=0.06, abs=8e-4)


def test_nothing_is_told_where_nothing_falls(ground: list[Motion]) -> None:
    runs = simulated(ground)
    still = CaseRuns(**{**runs.__dict__, "fell": runs.fell & False})
    (one,) = functions_of_case(
        CASE, still, Shaking(ground, draws=0), states=[LimitState("overturns")], measures=["PGV"]
    )
    assert "no simulation reaches overturns" in one.problem
    assert not one.caution
    row = table_of([one]).iloc[0]
    for name in ("median", "beta", "beta_motions", "beta_object", "beta_model"):
        assert np.isnan(row[name])


def test_states_are_reached_by_what_they_say() -> None:
    def column(*values: float) -> NDArray[np.float32]:
        return np.array(values, np.float32)

    fell, no = np.array([False, False, True]), np.zeros(3, np.bool_)
    runs = CaseRuns(
        draw=np.zeros(3, np.int32), scale=np.ones(3), fell=fell,
        held_up=np.array([True, False, False]), off=fell, moving=no, broke=no,
        rotation=column(0.0, 0.01, 0.0), farthest=column(0.099, 0.1, 0.0),
        reach=column(0.79, 0.8, 2.0), force=column(0, 0, 0),
    )  # fmt: skip
    for text, expected in {
        "uplift": [False, True, True], "slides 0.1 m": [False, True, True],
        "walks off": [False, False, True], "overturns": [False, False, True],
        "overturns or held up": [True, False, True],
        "reaches 0.8 m": [False, True, True],
    }.items():  # fmt: skip
        state = limit_state(text)
        assert reached(state, runs).tolist() == expected, text
    assert not has_state(CASE, limit_state("walks off"))
    table = Case(thing=CASE.thing, stand=Stand(), held=Held(name="table", edge=0.1))
    assert has_state(table, limit_state("walks off"))
    assert not has_state(table, limit_state("reaches 0.8 m"))
    assert not has_state(table, limit_state("overturns or held up"))
    wall = Case(thing=CASE.thing, stand=Stand(), held=Held(name="wall", wall_gap=0.01))
    assert has_state(wall, limit_state("overturns or held up"))


def test_every_column_is_explained(ground: list[Motion]) -> None:
    table = table_of(
        functions_of_case(
            CASE, simulated(ground), Shaking(ground, draws=0), states=[LimitState("overturns")],
            measures=["PGV", "SA(1.0)"],
        )
    )  # fmt: skip
    assert list(table) == list(COLUMNS)
    assert all(column.meaning for column in COLUMNS.values())
    assert table["unit"].tolist() == ["m/s", "m/s2"]


def test_a_regression_that_nothing_can_tell_has_no_effects() -> None:
    """Every simulation above a level falls and none below: the likelihood has no largest value."""
    draws = draws_of(CASE, 40, 0)
    level = np.linspace(0.5, 2.0, 40)
    points = Points(level, (level > 1.0).astype(np.int64), np.ones(40, np.int64),
                    np.arange(40))  # fmt: skip
    found = effects_of(points, draws, np.arange(40, dtype=np.int32), np.arange(40))
    assert np.isnan(found.slope).all()
