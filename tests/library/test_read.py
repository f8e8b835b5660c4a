"""Libraries as TOML files describe them."""

from __future__ import annotations

from pathlib import Path

import pytest

from shaketable import InputError
from shaketable.campaign.description import read_campaign
from shaketable.campaign.libraries import Libraries

LIBRARY = Path(__file__).parents[2] / "library"
BASIC = """
[library]
title = "Some"
edition = "0.1"
measures = ["PGV", "floor PGA"]
limit_states = ["uplift", "overturns"]
seed = 3

[motions]
of = "fema-p695-near-field-pulse"

[[places]]
name = "ground"

[[places]]
name = "roof"
storeys = 2
first_period_s = 0.3
damping = 0.03
floor = 2

[[held]]
name = "free"

[[held]]
name = "strap"
wall_gap_mm = 10
strap_strength = 1.5
slack_mm = 5
draws = 2

[[things]]
kinds = ["bookcase", "vase"]
sizes = ["slender", "stout"]
scales = [1.0, 2.0]
tilts_deg = [0, 1]
friction = [[0.2, 0.4]]
"""


def read(folder: Path, text: str) -> Libraries:
    (folder / "library.toml").write_text(text)
    work = read_campaign(folder / "library.toml")
    assert isinstance(work, Libraries)
    return work


def test_all_combinations_are_cases(tmp_path: Path) -> None:
    work = read(tmp_path, BASIC)
    assert work.blocks == 2 * 2 * 2 * 2 * 2 * 2
    library = work.library
    assert (library.title, library.edition, library.seed) == ("Some", "0.1", 3)
    assert library.measures == ("PGV", "floor PGA")
    assert [state.name for state in library.states] == ["uplift", "overturns"]
    last = work.cases[-1]
    assert last.name == "vase.stout_x2.roof.strap.tilt1.mu0_2to0_4".replace("_x2", ".x2")
    assert (last.held.wall_gap, last.held.strength, last.held.slack, last.held.draws) == (
        0.01, 1.5, 0.005, 2,
    )  # fmt: skip
    building = last.stand.building
    assert building is not None
    assert (building.storeys, building.first_period, building.damping) == (2, 0.3, 0.03)
    assert all(head.has_transverse for head in [*work.named["motions"]])


def test_lengths_of_its_own(tmp_path: Path) -> None:
    own = BASIC.replace('sizes = ["slender", "stout"]', 'label = "mine"\nlengths_m = [1, 2, 3]')
    thing = read(tmp_path, own.replace('"vase"', '"locker"')).cases[0].thing
    assert (thing.name, thing.depth, thing.width, thing.height) == ("bookcase mine", 1, 2, 3)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"vase"]', '"vaze"]', "line 33, kinds: the catalogue has no 'vaze'"),
        ('"stout"]', '"tall"]', "line 34, sizes: unknown 'tall'; known: slender, middle, stout"),
        ("scales = [1.0, 2.0]", 'scales = "x"', "line 35, scales: expected a list"),
        ("[[0.2, 0.4]]", "[0.2, 0.4]", "friction: expected ranges such as"),
        ("[[0.2, 0.4]]", "[[0.4, 0.2]]", "friction must be from the least to the largest"),
        ("floor = 2", "floor = 3", "roof: floor must be from 1 to 2 storeys, got 3"),
        ("wall_gap_mm = 10\n", "", "strap: a strap goes to a wall; give the wall's gap"),
        ('"overturns"]', '"rocks 0.5 alpha"]', "is of planar bodies; write 'uplift'"),
        ('"overturns"]', '"falls"]', "unknown limit state 'falls'"),
        ('"floor PGA"', '"floor D5-95"', "does not grow with the motion"),
        ('"floor PGA"', '"roof PGA"', "library.measures"),
        ("draws = 2", "draws = 2.5", "draws: expected a whole number, found 2.5"),
        ("storeys = 2\n", "", "first_period_s: is of a building: give its storeys as well"),
        ('name = "roof"', 'name = "ground"', "name: 'ground' is there twice"),
        ('name = "strap"', 'name = "free"', "name: 'free' is there twice"),
        (
            'sizes = ["slender", "stout"]',
            'label = "x"\nlengths_m = [0.2, 1.5]',
            "lengths_m: expected depth, width and height, found [0.2, 1.5]",
        ),
        ("draws = 2", "drawn = 2", "drawn: unknown; accepted: name, wall_gap_mm"),
        ("[[places]]", "[[place]]", "place: unknown; accepted: library, motions, places"),
        ('of = "fema-p695-near-field-pulse"', "", "motions.of: give suites"),
        ("scales = [1.0, 2.0]", "scales = [1.0, 1.0]", "is there twice"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(tmp_path: Path, old: str, new: str, says: str) -> None:
    with pytest.raises(InputError) as told:
        read(tmp_path, BASIC.replace(old, new))
    assert says in str(told.value)


def test_a_library_is_made_on_the_cpu(tmp_path: Path) -> None:
    (tmp_path / "library.toml").write_text(BASIC)
    with pytest.raises(InputError, match="a library is made on the CPU"):
        read_campaign(tmp_path / "library.toml", device="cuda")


def test_single_components_are_refused(tmp_path: Path) -> None:
    rows = "\n".join(f"{0.01 * k:g},{0.1 * (k % 7 - 3):g}" for k in range(200))
    (tmp_path / "one.csv").write_text(f"time_s,acceleration_g\n{rows}\n")
    with pytest.raises(InputError, match="things need both components; one alone"):
        read(tmp_path, BASIC.replace("fema-p695-near-field-pulse", "one.csv"))


@pytest.mark.parametrize(
    ("name", "cases", "things"),
    [("edition-1.0", 286, 43), ("fema-p58", 36, 9), ("whole", 79_758, 198)],
)
def test_the_files_of_the_project_can_be_read(name: str, cases: int, things: int) -> None:
    work = read_campaign(LIBRARY / f"{name}.toml")
    assert isinstance(work, Libraries)
    assert work.blocks == cases
    assert len({case.thing.name for case in work.cases}) == things
