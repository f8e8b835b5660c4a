"""The published rows, and a part of them made again."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import InputError
from shaketable.campaign.description import read_campaign
from shaketable.campaign.libraries import Libraries
from shaketable.fragility.limit_states import limit_state
from shaketable.library.case import Case
from shaketable.library.fitted import TESTS, Shaking, functions_of_case
from shaketable.library.published import found_rows, read_library_table
from shaketable.library.shaken import motions_under, simulated
from shaketable.library.states import has_state
from shaketable.report.library import dictionary

LIBRARY = Path(__file__).parents[2] / "library"
P58, EDITION = "fema-p58", "edition-1.0"
NAMES = (P58, EDITION)
#: Cases that take seconds: on the ground and on a floor, free, and on a tilt. None at a wall or in
#: a strap of edition 1.0: there what ended turned at any angle counted, so that other scales were
#: chosen. None on a table: there the edge was a rule, as the cautions of these rows say.
AGAIN = (
    (P58, "bookcase.5.shelves.ground.free.mu0_4to0_6"),
    (P58, "filing_cabinet.vertical.4.drawers.office6_floor_4.free.mu0_4to0_6"),
    (EDITION, "gas_cylinder_large.slender.ground.free.tilt2.mu0_4to0_6"),
)


@pytest.fixture(scope="module", params=NAMES)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def table(name: str) -> pd.DataFrame:
    return read_library_table(LIBRARY / f"{name}.csv")


@pytest.fixture(scope="module")
def p58() -> pd.DataFrame:
    return read_library_table(LIBRARY / f"{P58}.csv")


@pytest.fixture(scope="module")
def edition() -> pd.DataFrame:
    return read_library_table(LIBRARY / f"{EDITION}.csv")


@cache
def described(name: str) -> Libraries:
    found = read_campaign(LIBRARY / f"{name}.toml")
    assert isinstance(found, Libraries)
    return found


def test_there_is_a_row_for_every_case_state_and_measure(name: str, table: pd.DataFrame) -> None:
    library = described(name).library

    def rows(case: Case) -> int:
        on_ground = case.stand.building is None
        measures = [each for each in library.measures if not (on_ground and "floor" in each)]
        return len(measures) * sum(has_state(case, state) for state in library.states)

    assert len(table) == sum(rows(case) for case in library.cases)
    assert not table.duplicated(["id", "measure"]).any()
    names = {case.name for case in library.cases}
    assert set(table["id"].str.rsplit(".", n=1).str[0]) == names


def test_a_row_has_a_function_or_says_why_not(table: pd.DataFrame) -> None:
    known = table["median"].notna()
    assert (known == (table["problem"] == "")).all()
    numbers = ["beta", "beta_motions", "beta_object", "beta_model"]
    assert (table[numbers].notna().all(axis=1) == known).all()
    assert known.mean() > 0.7
    assert (table["caution"][~known] == "").all()


def test_the_parts_of_beta_are_its_squares(table: pd.DataFrame) -> None:
    known = table[table["median"].notna()]
    parts = np.sqrt((known[["beta_motions", "beta_object", "beta_model"]] ** 2).sum(axis=1))
    # five digits of each; where more is drawn than is found, nothing is left for the motions
    assert (parts / known["beta"] - 1.0).abs().max() < 1e-3
    assert (known["beta_model"] >= TESTS).all()


def test_intervals_hold_their_medians(table: pd.DataFrame) -> None:
    known = table[table["median_low"].notna()]
    assert (known["median_low"] <= known["median"]).all()
    assert (known["median"] <= known["median_high"]).all()
    assert set(known["events"]) == {18}
    assert set(known["recordings"]) == {48}


def test_taller_bookcases_of_one_depth_take_less(p58: pd.DataFrame) -> None:
    """On the ground, where nothing but the height differs."""
    rows = p58[
        (p58["kind"] == "bookcase") & (p58["measure"] == "PGV")
        & (p58["place"] == "ground")
    ]  # fmt: skip
    for held in ("free", "wall 10 mm"):
        some = rows[rows["held"] == held].sort_values("height")
        assert len(some) == 5
        assert some["median"].is_monotonic_decreasing, held


def test_a_wall_makes_nothing_fall_more_often(p58: pd.DataFrame) -> None:
    """Medians at a wall are not below those of free things by more than 3 %, as draws differ."""
    by_held = p58.pivot_table(
        index=["thing", "place", "measure"], columns="held", values="median"
    ).dropna()
    assert len(by_held) == 48
    assert (by_held["wall 10 mm"] > 0.97 * by_held["free"]).all()


@pytest.mark.parametrize("kind", ["bookcase", "cupboard"])
@pytest.mark.parametrize("held", ["free", "wall 10 mm"])
def test_larger_things_of_one_shape_take_more(kind: str, held: str, edition: pd.DataFrame) -> None:
    """As the period of a rocking body goes with the root of its size (Housner 1963)."""
    rows = edition[
        (edition["kind"] == kind) & (edition["size"] == "middle") & (edition["held"] == held)
        & (edition["limit_state"] == "overturns") & (edition["measure"] == "PGV")
        & (edition["place"] == "ground") & (edition["tilt"] == 0.0)
    ].sort_values("scale")  # fmt: skip
    assert rows["scale"].tolist() == [0.7, 1.0, 1.4]
    assert rows["median"].is_monotonic_increasing


def test_slender_things_take_less(edition: pd.DataFrame) -> None:
    """The smallest base with the largest height beside the middle of both, by the acceleration."""
    rows = edition[
        (edition["limit_state"] == "overturns") & (edition["measure"] == "PGA")
        & (edition["place"] == "ground") & (edition["held"] == "free") & (edition["scale"] == 1.0)
        & (edition["tilt"] == 0.0)
    ]  # fmt: skip
    by_size = rows.pivot_table(index="kind", columns="size", values="median").dropna()
    assert len(by_size) > 9
    assert (by_size["slender"] < by_size["middle"]).all()


def test_words_are_whole(edition: pd.DataFrame) -> None:
    """What is free is no freezer."""
    assert set(found_rows(edition, words="free")["held"]) == {"free"}
    assert set(found_rows(edition, words="ultra-low wall")["held"]) == {"wall 10 mm"}
    with pytest.raises(InputError, match="no such rows"):
        found_rows(edition, words="freez")


def test_the_code_and_the_motions_are_told(name: str) -> None:
    told = json.loads((LIBRARY / f"{name}.json").read_text())
    assert told["seed"] == 1
    assert len(told["motions"]["hashes"]) == 48
    assert told["environment"]["shaketable's code"]


def test_the_dictionary_is_that_of_the_columns() -> None:
    written = pd.read_csv(LIBRARY / "data_dictionary.csv", keep_default_na=False)
    pd.testing.assert_frame_equal(written, dictionary(), check_dtype=False)


#: Factors on the motions that the first runs of edition 1.0 chose, where one of these runs ends
#: otherwise today: at other strengths other runs are drawn, and a row moves by its counting error.
SCALES = {
    "filing_cabinet.vertical.4.drawers.office6_floor_4.free.mu0_4to0_6": np.geomspace(
        2.0**-3.5, 4.0, 8
    ).tolist()
}


@pytest.mark.parametrize(
    ("name", "again"),
    [
        *AGAIN[:2],
        pytest.param(*AGAIN[2], marks=pytest.mark.slow),  # 14 s: what rolls, on a tilt
    ],
)
def test_a_part_made_again_is_what_is_published(name: str, again: str) -> None:
    """Where the last digit is rounded otherwise, a few of a thousand simulations end otherwise.

    On another processor the 108 rows of FEMA P-58's furniture differed by 0.7 % in θ and by 2 % in
    β at most. Since impacts are solved in the body's frame, 3 % of the runs on the ground have
    another peak, as what slips on a corner turns chaotic; 14 of 1,536 end otherwise, and θ differs
    by 2.5 %.
    """
    table, work = read_library_table(LIBRARY / f"{name}.csv"), described(name)
    (case,) = [each for each in work.cases if each.name == again]
    motions = motions_under(case, work.ground)
    runs = simulated(case, motions, seed=work.library.seed, scales=SCALES.get(again))
    functions = functions_of_case(
        case, runs, Shaking(work.ground, draws=0), states=[limit_state("overturns")],
        measures=["PGV", "PGA"], seed=work.library.seed,
    )  # fmt: skip
    for one in functions:
        rows = table[(table["id"] == one.identifier) & (table["measure"] == one.measure.name)]
        (row,) = rows.itertuples()
        assert one.curve.median == pytest.approx(row.median, rel=0.04)
        assert one.curve.beta == pytest.approx(row.beta, rel=0.05)
        assert one.simulations == pytest.approx(row.simulations, rel=0.2)  # a factor more or less
