"""Buildings: their files, their floors' motions, and the main job in them."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from openpyxl import load_workbook

from shaketable import Body, InputError, Motion, ShearBuilding, floor_motions, simulate_many
from shaketable.assess import assess
from shaketable.building import Building, read_building
from shaketable.building.recorded import _facing
from shaketable.building.typical import typical_period
from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004
from shaketable.inventory import Item, read_inventory
from shaketable.inventory.template import inventory_template
from shaketable.report.words.headline import how_sure
from shaketable.signal import peaks
from shaketable.tables.template import write_template
from tests.support.command import refused, shaketable

SHEAR = 'name = "Office"\nstoreys = 3\nfirst_period_s = 0.4\n'
THINGS = """name,width_m,height_m,quantity,floor
shelf,0.32,1.8,8,1
shelf,0.32,1.8,6,3
box,0.5,0.4,2,3
"""


@pytest.fixture
def recorded(tmp_path: Path, p695: list[Motion]) -> Path:
    """A building of two recorded floors, the roof with two channels."""
    for name, motion in zip(("ground", "roof_a", "roof_b"), p695[:3], strict=True):
        rows = "\n".join(f"{a:.8f}" for a in motion.horizontal)
        (tmp_path / f"{name}.txt").write_text(f"a\n{rows}\n")
    path = tmp_path / "building.toml"
    path.write_text(
        'units = "m/s2"\ntime_step_s = 0.01\n[floors]\nground = "ground.txt"\n'
        'roof = ["roof_a.txt", "roof_b.txt"]\n'
    )
    return path


def test_recorded_floors(recorded: Path, p695: list[Motion]) -> None:
    building = read_building(recorded)
    assert building.name == "building"
    assert list(building.floors) == ["ground", "roof"]
    assert [len(motions) for motions in building.floors.values()] == [1, 2]
    written = building.floors["roof"][1].horizontal
    assert written == pytest.approx(p695[2].horizontal, abs=1e-8)


def test_a_shear_building(tmp_path: Path, p695: list[Motion]) -> None:
    path = tmp_path / "office.toml"
    path.write_text(f'{SHEAR}damping = 0.03\nmotions = ["near-field-pulse"]\n')
    building = read_building(path)
    assert list(building.floors) == ["0", "1", "2", "3"]
    # both components of a recording are one motion
    assert {len(motions) for motions in building.floors.values()} == {14}
    assert {len(motions) for motions in building.in_components().floors.values()} == {28}
    given = read_building(path, p695[:2])  # in place of the file's own
    assert {len(motions) for motions in given.floors.values()} == {1}
    shear = ShearBuilding(storeys=3, first_period=0.4, damping=0.03)
    roof = floor_motions(shear, p695[1])[-1]
    across = given.floors["3"][0].transverse
    assert across is not None
    assert np.array_equal(across[: roof.horizontal.size], roof.horizontal)


def test_a_building_of_which_the_structure_is_known(tmp_path: Path) -> None:
    """The typical one and those that it may be; the table's equation by hand."""
    path = tmp_path / "office.toml"
    path.write_text('structure = "concrete frame"\nstoreys = 3\nmotions = ["near-field-pulse"]\n')
    building = read_building(path)
    typical = 0.0466 * 9.6**0.9  # Taly, Design of Reinforced Masonry Structures, eq. 7.59
    assert typical == pytest.approx(0.357, abs=0.001)
    assert list(building.variants) == ["0.25 s", "0.36 s", "0.5 s"]
    for share, one in zip((0.7, 1.0, 1.4), building.variants.values(), strict=True):
        shear = ShearBuilding(storeys=3, first_period=float(f"{share * typical:.3g}"))
        alone = floor_motions(shear, building.floors["0"][0])
        for label, motion in zip("123", alone, strict=True):
            assert one.floors[label][0].horizontal == pytest.approx(motion.horizontal, abs=1e-12)
    assert building.floors["3"][0] == building.variants["0.36 s"].floors["3"][0]
    assert "0.25 s, 0.36 s, 0.5 s are usual" in building.told
    assert "Table 7.4" in building.told
    assert typical_period("steel frame", 3) == pytest.approx(0.0724 * 9.6**0.8)
    assert typical_period("timber", 2, 2.5) == pytest.approx(0.0488 * 5**0.75)
    for storeys in (0, -3, 10**400, 2.5):
        with pytest.raises(InputError, match="storeys: a whole number from 1 to 200"):
            typical_period("timber", storeys)  # type: ignore[arg-type]


def test_of_the_buildings_that_it_may_be_the_worst_leads(tmp_path: Path) -> None:
    """Each object's share is the largest of those in each building alone."""
    path = tmp_path / "office.toml"
    path.write_text('structure = "steel frame"\nstoreys = 4\nmotions = ["near-field-pulse"]\n')
    building = read_building(path)
    (tmp_path / "a.csv").write_text(
        "name,depth_m,height_m,floor\na,0.3,1.0,4\nb,0.5,1.8,4\nc,0.8,2.0,2\nd,0.3,0.8,0\n"
    )
    items = read_inventory(tmp_path / "a.csv")
    found = assess(items, building, planar=True, progress=False)
    alone = [
        assess(items, each, planar=True, progress=False).results
        for each in building.variants.values()
    ]
    worst = [max(one.governing_share.value for one in same) for same in zip(*alone, strict=True)]
    assert [each.governing_share.value for each in found.results] == worst
    assert len({tuple(one.governing_share.value for one in each) for each in alone}) == 3
    assert found.tried == tuple(building.variants)
    assert any("were tried, and of each object" in each for each in how_sure(found))


def test_a_building_is_softer_in_one_direction(tmp_path: Path, p695: list[Motion]) -> None:
    """Each component goes through the shear building of its own direction."""
    (tmp_path / "a.toml").write_text(f"{SHEAR}period_ratio = 1.5\n")
    (tmp_path / "b.toml").write_text(f"{SHEAR}first_period_y_s = 0.6\n")
    pair = p695[:2]
    one, other = (read_building(tmp_path / name, pair) for name in ("a.toml", "b.toml"))
    roof = one.floors["3"][0]
    assert roof.transverse is not None
    also = other.floors["3"][0].transverse
    assert also is not None
    assert roof.transverse[: also.size] == pytest.approx(also[: roof.transverse.size], abs=1e-12)
    soft = floor_motions(ShearBuilding(storeys=3, first_period=0.6), pair[1])[-1].horizontal
    n = pair[1].horizontal.size
    assert roof.transverse[:n] == pytest.approx(soft[:n], abs=1e-12)
    stiff = floor_motions(ShearBuilding(storeys=3, first_period=0.4), pair[0])[-1].horizontal
    assert roof.horizontal[:n] == pytest.approx(stiff[:n], abs=1e-12)
    assert "first periods 0.4 s along x and 0.6 s across it" in one.told


def test_recordings_are_turned_to_the_axes_of_a_building(
    tmp_path: Path, p695: list[Motion]
) -> None:
    """A component along x at 40° from north is a sum of those that were recorded."""
    pair = p695[:2]
    first = pair[0].origin
    assert first is not None
    assert first.azimuth is not None
    axis = first.azimuth + 30.0
    (tmp_path / "a.toml").write_text(f"{SHEAR}x_direction_deg = {axis % 360.0}\n")
    ground = read_building(tmp_path / "a.toml", pair).ground[0]
    # clockwise: x is the first component's cosine less the sine of the one to its left
    expected = np.cos(np.pi / 6) * pair[0].horizontal - np.sin(np.pi / 6) * pair[1].horizontal
    assert ground.horizontal == pytest.approx(expected, abs=1e-12)
    assert ground.origin is not None
    assert ground.origin.azimuth == pytest.approx(axis % 360.0)


def test_floors_that_twist(tmp_path: Path, p695: list[Motion]) -> None:
    """Without eccentricity the corner moves as the shear building does; with it, more."""
    even = "plan_m = [30, 15]\n"
    (tmp_path / "even.toml").write_text(f"{SHEAR}{even}")
    (tmp_path / "twists.toml").write_text(f"{SHEAR}{even}eccentricity = [0.2, 0]\n")
    pair = p695[:2]
    plain = floor_motions(ShearBuilding(storeys=3, first_period=0.4), pair[0])[-1].horizontal
    corner = read_building(tmp_path / "even.toml", pair).floors["3"][0]
    n = pair[0].horizontal.size
    assert corner.horizontal[:n] == pytest.approx(plain[:n], abs=1e-9 * np.abs(plain).max())
    twists = read_building(tmp_path / "twists.toml", pair)
    assert "that twist" in twists.told
    moved = twists.floors["3"][0]
    assert moved.transverse is not None
    assert corner.transverse is not None
    assert np.abs(moved.transverse).max() > 1.05 * np.abs(corner.transverse).max()
    with pytest.raises(InputError, match="floors that twist need both horizontal components"):
        read_building(tmp_path / "twists.toml", p695[:1])
    (tmp_path / "bad.toml").write_text(f"{SHEAR}{even}period_ratio = 2\n")
    with pytest.raises(InputError, match="has one first_period_s"):
        read_building(tmp_path / "bad.toml", pair)


def test_recorded_floors_are_paired_by_their_instruments(recorded: Path) -> None:
    """A channel to the left of two makes a pair with each; one that fits none stays alone."""
    recorded.with_name("roof_c.txt").write_text(recorded.with_name("roof_a.txt").read_text())
    head = 'units = "m/s2"\ntime_step_s = 0.01\n[floors]\nground = "ground.txt"\n[floors.roof]\n'
    recorded.write_text(f'{head}92 = "roof_a.txt"\n2 = "roof_b.txt"\n')
    (roof,) = read_building(recorded).floors["roof"]
    assert roof.origin is not None
    assert roof.transverse_origin is not None
    assert (roof.origin.azimuth, roof.transverse_origin.azimuth) == (92.0, 2.0)
    recorded.write_text(f'{head}92 = "roof_a.txt"\n50 = "roof_b.txt"\n')
    assert [m.transverse for m in read_building(recorded).floors["roof"]] == [None, None]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("storeys = ", "not a TOML file"),
        (
            'name = "x"\n',
            r"give recorded motions in a table \[floors\], or storeys and first_period",
        ),
        (
            f"{SHEAR}period = 3\n",
            "period: unknown; accepted: damping, eccentricity, first_period_s",
        ),
        (SHEAR, "no ground motions: give motions"),
        (SHEAR.replace("3", "0"), r"no ground motions|storeys"),
        (f'{SHEAR.replace("0.4", "-1")}motions = ["far-field"]\n', "first_period"),
        (f'{SHEAR}motions = ["nowhere"]\n', "neither a file, a folder nor a suite"),
        (f"{SHEAR}units = 3\n", "units: expected text, found 3"),
        (SHEAR.replace("0.4", '"0.4"'), "first_period_s: expected a number, found '0.4'"),
        (SHEAR.replace("3", "true"), "storeys: expected a whole number, found True"),
        ('[floors]\n1 = ["a.txt", "a.txt"]\n', "'a.txt' is named 2 times"),
        ("[floors]\n", "a table of labels and files is needed"),
        ("[floors]\n1 = 3\n", "floor '1': expected a path or a list of paths"),
        (
            '[floors]\n1 = "a.txt"\nroof = "b.txt"\n',
            "floor '1': .*a.txt(.|\n)*floor 'roof': .*b.txt",
        ),
        ('storeys = 3\n[floors]\n1 = "a.txt"\n', "storeys: unknown; accepted: floors, name"),
    ],
)
def test_bad_files(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_building(path)


def test_no_such_file_and_ground_for_recorded_floors(recorded: Path, p695: list[Motion]) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_building(recorded.with_name("none.toml"))
    with pytest.raises(InputError, match="leave out --motions"):
        read_building(recorded, p695[:1])


def test_a_floor_without_motion(recorded: Path) -> None:
    recorded.with_name("up.csv").write_text("time_s,UP_g\n0.0,0.1\n0.01,0.0\n0.02,0.1\n")
    recorded.write_text('[floors]\nroof = "up.csv"\n')
    with pytest.raises(InputError, match="floor 'roof': no horizontal motion"):
        read_building(recorded)


def test_every_floor_under_its_own_motions(p695: list[Motion]) -> None:
    shelf = Body.rectangle(0.32, 1.8, name="shelf")
    house = Building(name="h", floors={"1": p695[:4], "2": p695[4:8], "3": p695[8:12]}, told="")
    items = [Item(body=shelf, height=1.8, floor=floor, quantity=2) for floor in ("3", "1")]
    found = assess(items, house, progress=False)
    assert [floor.floor for floor in found.floors] == ["1", "3"]  # from the lowest up; none on 2
    for floor, motions in zip(found.floors, (p695[:4], p695[8:12]), strict=True):
        outcome = simulate_many([shelf], motions, progress=False).outcome.values
        assert floor.results[0].falls == (outcome != 0).sum()
        assert floor.expected_falls == pytest.approx(2 * (outcome != 0).mean())
    table = found.table
    assert list(table["floor"]) == ["1", "3"]
    # the ratios of floors, means over the motions
    measured = [peaks(motion) for motion in p695[8:12]]
    pfa, pfv = (np.array([each[k] for each in measured]) for k in (0, 1))
    ratio = kaneko_hayashi_2004.overturning_ratio(0.32, 1.8, pfa, pfv).mean()
    assert table["kaneko_hayashi_ratio"][1] == pytest.approx(ratio)
    risk = cimellaro_2020.overturning_ratio(0.32 / 1.8, pfa).mean()
    assert table["cimellaro_ratio"][1] == pytest.approx(risk)
    doubts = [bool(cimellaro_2020.out_of_range(0.32 / 1.8, float(a))) for a in pfa]
    assert table["cimellaro_out_of_range_share"][1] == np.mean(doubts)


def test_items_on_no_floor_or_an_unknown_one(p695: list[Motion]) -> None:
    house = Building(name="hotel", floors={"ground": p695[:1], "1": p695[:1]}, told="")
    items = [
        Item(body=Body.rectangle(0.3, 1.0, name="a"), height=1.0),
        Item(body=Body.rectangle(0.3, 1.0, name="b"), height=1.0, floor="9"),
    ]
    with pytest.raises(InputError, match="no floor is given: 'a'") as raised:
        assess(items, house, progress=False)
    said = str(raised.value)
    assert "floor '9' is none of the building: 'b'" in said
    assert said.count("hotel has the floors ground, 1") == 1
    # thirty objects without a floor are one error
    many = [replace(items[0], body=Body.rectangle(0.3, 1.0, name=f"{n}")) for n in range(30)]
    with pytest.raises(InputError) as raised:
        assess(many, house, progress=False)
    assert len(str(raised.value).splitlines()) == 2
    assert "'9' and 20 more" in str(raised.value)


def test_one_name_may_stand_on_several_floors(tmp_path: Path) -> None:
    path = tmp_path / "things.csv"
    path.write_text(THINGS)
    assert [(item.name, item.floor) for item in read_inventory(path)] == [
        ("shelf", "1"), ("shelf", "3"), ("box", "3"),
    ]  # fmt: skip
    path.write_text(f"{THINGS}{THINGS.splitlines()[2]}\n")
    with pytest.raises(InputError, match="line 5, name: 'shelf' is also on line 3"):
        read_inventory(path)


def test_the_sheet_of_a_list_is_its_building(tmp_path: Path) -> None:
    """The same result as with a file that says the same; without the sheet's answers none."""
    template = tmp_path / "list.xlsx"
    write_template(template, inventory_template(lengths="m"))
    book = load_workbook(template)
    rows = book.worksheets[0]
    floor = [cell.value for cell in rows[1]].index("Floor") + 1
    for row, label in zip(range(2, 6), (0, 1, 2, 2), strict=True):
        rows.cell(row, floor, label)
    book.save(template)
    options = ("--planar", "--motions", "fema-p695-near-field-pulse", "--overwrite")
    ground = shaketable("assess", template, *options, "--out", tmp_path / "ground")
    for k, value in enumerate(("Wing", 2, "timber"), 1):
        book["Building"].cell(k, 2, value)
    book.save(template)
    sheet = shaketable("assess", template, *options, "--out", tmp_path / "sheet")
    (tmp_path / "wing.toml").write_text('name = "Wing"\nstoreys = 2\nstructure = "timber"\n')
    by_file = ("--building", tmp_path / "wing.toml", "--out", tmp_path / "file")
    file = shaketable("assess", template, *options, *by_file)
    assert (ground.returncode, sheet.returncode, file.returncode) == (0, 0, 0), sheet.stderr
    tables = [(tmp_path / each / "results.csv").read_text() for each in ("ground", "sheet", "file")]
    assert tables[1] == tables[2] != tables[0]
    assert "first period is not known" in sheet.stdout.replace("\n", " ")
    run = json.loads((tmp_path / "sheet" / "run.json").read_text())
    assert run["building"] == {"name": "Wing", "storeys": 2, "structure": "timber"}


def test_assess_a_building(tmp_path: Path) -> None:
    (tmp_path / "things.csv").write_text(THINGS)
    (tmp_path / "office.toml").write_text(SHEAR)
    arguments = ("assess", "things.csv", "--building", "office.toml")
    run = shaketable(*arguments, "--motions", "near-field-pulse", "--out", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    # floors by themselves come last, the highest on top
    (header,) = re.findall(r"^floor +pieces +fall *$", run.stdout, re.MULTILINE)
    floors = run.stdout[run.stdout.index(header) :].splitlines()
    assert [line.split()[0] for line in floors[2:4]] == ["3", "1"]
    table = pd.read_csv(tmp_path / "out" / "results.csv")
    assert list(table["floor"]) == [1, 3, 3]
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    # the list of all comes first, then the floors from the top down, then each by itself
    assert page.index("What to do first") < page.index("Floor by floor</h2>")
    assert page.index("<h3>floor 3</h3>") < page.index("<h3>floor 1</h3>")
    assert page.index(">floor 1</td>") < page.index(">floor 3</td>") < page.index("Method</h3>")
    assert "linear shear building of 3 storeys" in page
    log = json.loads((tmp_path / "out" / "run.json").read_text())
    assert len(log["building"]["sha256"]) == 64
    assert list(log["motions"]["floors"]) == ["0", "1", "2", "3"]
    assert "no ground motions" in refused(*arguments, "--out", "x", cwd=tmp_path)
    said = refused(*arguments, "--vertical", "--out", "x", cwd=tmp_path)
    assert "--vertical, --units and --time-step-s are for --motions" in said
    plain = shaketable("assess", "things.csv", "--out", "plain", cwd=tmp_path)
    assert plain.returncode == 0, plain.stderr
    # after what they are shaken by, and before all else; on the page as well
    said = " ".join(plain.stdout.split())
    assert " g The list names floors, and everything was simulated" in said
    assert said.startswith("Shaken by 48 motions with both horizontal components")
    page = (tmp_path / "plain" / "report.html").read_text(encoding="utf-8")
    lead = page[page.index('class="warning"') :]
    assert lead.index("The list names floors") < lead.index("overturn")


def test_recorded_floors_can_be_repeated_from_the_log(recorded: Path, tmp_path: Path) -> None:
    (tmp_path / "things.csv").write_text("name,width_m,height_m,floor\nshelf,0.32,1.8,roof\n")
    arguments = ("assess", "things.csv", "--building", "building.toml", "--out", "out")
    run = shaketable(*arguments, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    log = json.loads((tmp_path / "out" / "run.json").read_text())
    sources = log["motions"]["sources"]
    assert [Path(source["name"]).name for source in sources] == [
        "ground.txt", "roof_a.txt", "roof_b.txt",
    ]  # fmt: skip
    assert {len(source["sha256"]) for source in sources} == {64}
    assert log["motions"]["count"] == 3
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert re.search(r"the roof</td><td>2</td><td>2</td>", page)  # motions, and recordings
    assert "–––" not in page


@pytest.mark.parametrize(
    "text",
    [
        "a=" + "[" * 20_000,
        "storeys=" + "9" * 5000,
        SHEAR.replace("storeys = 3", "storeys = " + "9" * 400) + 'motions = ["near-field-pulse"]',
        SHEAR.replace("storeys = 3", "storeys = 3000") + 'motions = ["near-field-pulse"]',
        SHEAR.replace("0.4", "1e300") + 'motions = ["near-field-pulse"]',
        SHEAR + f'motions = ["{"x" * 5000}"]',
        f'[floors]\na = "{"x" * 5000}"',
    ],
)
def test_damaged_buildings_are_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "b.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=r"b\.toml"):
        read_building(str(path))


def test_directions_of_instruments(recorded: Path) -> None:
    """A floor by direction: the motions carry it; nonsense and contradictions are refused."""
    head = 'units = "m/s2"\ntime_step_s = 0.01\n[floors]\nground = "ground.txt"\n[floors.roof]\n'
    recorded.write_text(f'{head}2 = "roof_a.txt"\n92 = ["roof_b.txt"]\n')
    building = read_building(recorded)
    (roof,) = building.floors["roof"]  # both directions of it
    facing = [each.origin.azimuth for each in roof.components() if each.origin]
    assert facing == [92.0, 2.0]
    assert len(building.files) == 3
    for wrong, said in (
        ('north = "roof_a.txt"', "from 0 to 360 degrees"),
        ('400 = "roof_a.txt"', "from 0 to 360 degrees"),
        ('2 = "roof_a.txt"\n92 = "roof_a.txt"', "give one file for one direction"),
        ("2 = 3", "expected a path"),
    ):
        recorded.write_text(f"{head}{wrong}\n")
        with pytest.raises(InputError, match=said):
            read_building(recorded)


def test_a_direction_against_the_record_s_own(p695: list[Motion]) -> None:
    motion = p695[0]
    assert motion.origin is not None
    turned = replace(motion, origin=replace(motion.origin, azimuth=90.0))
    assert _facing(turned, "90").origin == turned.origin
    with pytest.raises(InputError, match="the record says 90"):
        _facing(turned, "0")
