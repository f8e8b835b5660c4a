"""What objects lose together: against closed forms, and against the rates of each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, InputError, Motion
from shaketable.hazard import Hazard
from shaketable.hazard.exceedance import Correlation
from shaketable.hazard.objects import ObjectRates, object_rates
from shaketable.hazard.totals import VARIED, loss_totals
from shaketable.inventory import Item
from shaketable.report.words.hazard import of_totals
from shaketable.signal.intensity import measure_named

SHELF = Body.rectangle(0.3, 1.8, name="shelf")
TALL = Body.rectangle(0.35, 2.0, name="tall")
CHEST = Body.rectangle(3.0, 0.5, name="chest")
LEVELS = np.geomspace(0.02, 3.0, 30)


def rates_of(p695: list[Motion], *items: Item, draws: int = 40) -> ObjectRates:
    curve = Hazard(measure=measure_named("PGV"), levels=LEVELS, rates=1e-3 * LEVELS**-2.0)
    return object_rates(list(items), p695[:24], curve, draws=draws)


@pytest.fixture(scope="module")
def one(p695: list[Motion]) -> ObjectRates:
    return rates_of(p695, Item(body=SHELF, height=1.8, quantity=4, cost=100.0))


@pytest.fixture(scope="module")
def two(p695: list[Motion]) -> ObjectRates:
    return rates_of(
        p695,
        Item(body=SHELF, height=1.8, quantity=10, cost=100.0),
        Item(body=TALL, height=2.0, quantity=5, cost=300.0),
    )


def test_the_average_is_the_sum_of_the_rates(two: ObjectRates) -> None:
    """Exactly, with any correlation; the curve's own mean is within 2 %, the error of its draws."""
    expected = sum(
        each.item.quantity * (each.item.cost or 0.0) * each.found.rate for each in two.rates
    )
    found = loss_totals(two)
    assert found.average == pytest.approx(expected)
    under = -np.diff(found.rates, prepend=found.rates[0])  # the rate of each loss above the first
    assert under @ found.losses == pytest.approx(expected, rel=0.02)
    assert found.in_cost
    assert found.value == 10 * 100 + 5 * 300
    low, high = found.average_interval
    assert low < found.average < high
    for correlation in VARIED.values():
        again = loss_totals(two, correlation=correlation)
        assert again.average == pytest.approx(expected)


def test_alike_pieces_fall_together_at_the_rate_of_one(one: ObjectRates) -> None:
    """All four or none: the curve is one step, at the rate with which a piece falls."""
    found = loss_totals(one)
    assert found.losses.tolist() == [0.0, 400.0]
    assert found.rates[0] == pytest.approx(one.rates[0].found.rate, rel=0.02)
    assert found.rates[1] == 0.0
    rate = one.rates[0].found.rate
    periods = {each.years: each.loss for each in loss_totals(
        one, return_periods=[0.5 / rate, 2.0 / rate]).periods}  # fmt: skip
    assert periods == {0.5 / rate: 0.0, 2.0 / rate: 400.0}


def test_pieces_by_themselves_are_binomial(one: ObjectRates) -> None:
    """P(all four fall) = ∫ F⁴ |dλ|, by a sum over 4,000 levels; 3 %: the error of the draws."""
    found = loss_totals(one, correlation=Correlation(0.0, 0.0))
    assert set(found.losses.tolist()) == {0.0, 100.0, 200.0, 300.0, 400.0}
    edges = np.geomspace(0.005, 40.0, 4001)
    rate = -np.diff(one.hazard.rate(edges))
    falls = one.rates[0].curve.probability(np.sqrt(edges[1:] * edges[:-1]))
    above = dict(zip(found.losses.tolist(), found.rates.tolist(), strict=True))
    assert above[300.0] == pytest.approx(rate @ falls**4, rel=0.03)
    assert above[0.0] == pytest.approx(rate @ (1.0 - (1.0 - falls) ** 4), rel=0.03)


def test_correlation_makes_rare_losses_larger(two: ObjectRates) -> None:
    found = loss_totals(two)
    alone, together = found.varied.values()
    seldom = [each.years for each in found.periods].index(2475.0)
    assert alone[seldom] <= found.periods[seldom].loss <= together[seldom]
    assert list(found.varied) == ["each piece by itself", "all together"]
    # those that are given are those that are used
    assert loss_totals(two, correlation=Correlation(1.0, 1.0)).periods[seldom].loss == (
        pytest.approx(together[seldom], rel=0.1)
    )


def test_without_costs_pieces_are_counted(p695: list[Motion]) -> None:
    found = loss_totals(rates_of(p695, Item(body=SHELF, height=1.8, quantity=4), draws=0))
    assert not found.in_cost
    assert found.losses.tolist() == [0.0, 4.0]
    assert np.isnan(found.average_interval).all()
    assert found.table()["unit"].tolist() == ["pieces"] * 7
    assert "pieces fall in a year (not known to not known)" in of_totals(found)[0]


def test_what_does_not_count_is_told(p695: list[Motion]) -> None:
    rates = rates_of(
        p695, Item(body=SHELF, height=1.8, cost=5.0), Item(body=TALL, height=2.0),
        Item(body=CHEST, height=0.5, cost=9.0),
    )  # fmt: skip
    found = loss_totals(rates)
    assert found.value == 5.0
    assert found.without_cost == ("2: tall",)
    assert found.without_function == ("3: chest",)
    said = " ".join(of_totals(found))
    assert "Not counted, without a cost: 2: tall." in said
    assert "Not counted, without a fragility function: 3: chest." in said


def test_what_is_rarer_than_the_curve_is_no_result(p695: list[Motion]) -> None:
    """The curve's last rate is once in 400 years."""
    levels = np.geomspace(0.02, 0.632456, 20)
    curve = Hazard(measure=measure_named("PGV"), levels=levels, rates=1e-3 * levels**-2.0)
    rates = object_rates([Item(body=SHELF, height=1.8)], p695[:24], curve, draws=0)
    found = loss_totals(rates)
    assert [each.beyond_curve for each in found.periods] == [False] * 3 + [True] * 3
    assert (
        "Losses of once in 475, 1000, 2475 years come from shaking beyond" in of_totals(found)[-1]
    )
    ends = replace(curve, levels=np.append(levels, 1.0), rates=np.append(curve.rates, 0.0))
    ended = loss_totals(replace(rates, hazard=ends))
    assert not any(each.beyond_curve for each in ended.periods)


@pytest.mark.parametrize(("alike", "kinds"), [(0.5, 0.7), (1.1, 0.5), (0.5, -0.1)])
def test_wrong_correlations_are_refused(alike: float, kinds: float) -> None:
    with pytest.raises(InputError, match="must be 1 >= alike >= kinds >= 0, got"):
        Correlation(alike, kinds)


def test_nothing_can_be_added_up_without_functions(p695: list[Motion]) -> None:
    with pytest.raises(InputError, match="its losses cannot be computed"):
        loss_totals(rates_of(p695, Item(body=CHEST, height=0.5)))


def test_many_kinds_are_added_up_in_parts(
    two: ObjectRates, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The curve differs by the draws alone, as the order of random numbers is another."""
    whole = loss_totals(two, correlation=Correlation(0.0, 0.0))
    monkeypatch.setattr("shaketable.hazard.exceedance.AT_ONCE", 1)
    parts = loss_totals(two, correlation=Correlation(0.0, 0.0))
    assert parts.rates[0] == pytest.approx(whole.rates[0], rel=0.03)


def test_intervals_of_losses_hold_them_and_no_more_than_there_is(two: ObjectRates) -> None:
    found = loss_totals(two)
    for each in found.periods:
        assert 0.0 <= each.low <= each.loss <= each.high <= found.value


def test_no_interval_is_told_where_that_of_a_function_is_not(p695: list[Motion]) -> None:
    """Two earthquakes tell none."""
    few = [motion for motion in p695 if motion.origin and motion.origin.event in {
        one.origin.event for one in p695[:1] + p695[-1:] if one.origin}]  # fmt: skip
    curve = Hazard(measure=measure_named("PGV"), levels=LEVELS, rates=1e-3 * LEVELS**-2.0)
    found = loss_totals(object_rates([Item(body=SHELF, height=1.8)], few, curve, draws=40))
    assert np.isnan(found.average_interval).all()
    assert all(np.isnan(each.low) for each in found.periods)


def test_what_always_falls_in_one_direction_has_no_rate(p695: list[Motion]) -> None:
    """Not that of the other direction, in which it falls less often."""
    thin = Body.rectangle(0.004, 1.8, name="panel")
    rates = rates_of(
        p695, Item(body=thin, height=1.8, sideways=SHELF, cost=7.0),
        Item(body=SHELF, height=1.8, cost=5.0), draws=0,
    )  # fmt: skip
    assert np.isnan(rates.of_objects()[1].found.rate)
    found = loss_totals(rates)
    assert found.without_function == ("1: panel",)
    assert found.value == 5.0
