"""Inventories."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError
from shaketable.cli.assess import example_inventory
from shaketable.inventory import BaseShape, Castors, read_inventory
from shaketable.tables import sheet
from tests.support.mutations import MUTATIONS


def write(folder: Path, text: str) -> Path:
    path = folder / "things.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_defaults(tmp_path: Path) -> None:
    (item,) = read_inventory(write(tmp_path, "name,width_m,height_m\nshelf,0.3,1.8\n"))
    assert (item.name, item.quantity, item.location) == ("shelf", 1, "")
    assert item.body.cg_height == 0.9
    assert item.body.left == pytest.approx(0.15)
    assert item.body.gyration_radius == pytest.approx(math.hypot(0.3, 1.8) / math.sqrt(12))


def test_all_columns(tmp_path: Path) -> None:
    text = (
        "\ufeffname, height_m, width_m, cg_height_m, eccentricity, gyration_radius_m, quantity,"
        ' location, note\n"Cart, tall", 1.2, 0.5, 0.7, 0.4, 0.35, 12, ward 3, wheels locked\n\n'
    )
    (item,) = read_inventory(write(tmp_path, text))
    assert item.name == "Cart, tall"
    assert item.height == 1.2
    assert item.body.left == pytest.approx(0.2)
    assert (item.body.cg_height, item.body.gyration_radius) == (0.7, 0.35)
    assert (item.quantity, item.location, item.note) == (12, "ward 3", "wheels locked")


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ('a,0.3,1.8,1,"open\nb,0.3,1.8,1,x\nc,0.3,1.8,1,y\n', "unexpected end of data"),
        ('a,0.3,1.8,1,"open\nb,0.3,1.8,1,x\nc,0.3,1.8,1,"\n', "swallows whole rows"),
        ("a,0.3,1.8,1,x\nb,0.3,1", "line 3: the file ends within this row"),
        ("a,1e308,1e308,1,x\n", "line 2, width_m: must lie between 1e-06 and 1e+06 m"),
        ("a,0.3,1.8,inf,x\n", "line 2, quantity: expected a positive number, found 'inf'"),
        ("a,0.3,1.8,1e300,x\n", "line 2, quantity: found 1e+300; at most 1,000,000"),
        ("a" * 100_000 + ",0.3,1.8,1,x\n", "line 2, name: has 100,000 characters; at most 1,000"),
        ("a,\x1b[31m,1.8,1,x\n", r"found '\x1b[31m'"),
    ],
)
def test_damage_is_an_error(tmp_path: Path, rows: str, said: str) -> None:
    path = write(tmp_path, f"name,width_m,height_m,quantity,note\n{rows}")
    with pytest.raises(InputError, match=r"things\.csv") as error:
        read_inventory(path)
    assert said in str(error.value)


@pytest.mark.parametrize("count", [100, pytest.param(5000, marks=pytest.mark.slow)])
def test_damaged_inventories_are_input_errors_or_read(tmp_path: Path, count: int) -> None:
    rng = np.random.default_rng(count)
    whole = (
        "name,width_m,height_m,cg_height_m,eccentricity,quantity,floor,note\n"
        + "".join(
            f"thing {n},0.{3 + n % 5},1.{n % 9},0.5,0.5,{n},{n % 3},as it is\n"
            for n in range(1, 30)
        )
    ).encode()
    path = tmp_path / "things.csv"
    read, messages = 0, ""
    for _ in range(count):
        path.write_bytes(MUTATIONS[int(rng.integers(len(MUTATIONS)))](whole, rng).raw)
        try:
            read += len(read_inventory(path)) > 0
        except InputError as error:
            messages += str(error).replace("\n", "")
    assert messages.isprintable()
    assert 0.1 < read / count < 0.9


def test_all_faults_at_once(tmp_path: Path) -> None:
    text = (
        "name,width_m,height_m,cg_height_m,eccentricity,quantity\n"
        "a,0.3,1.8,,,\n"
        ",-1,wide,,,\n"
        "a,0.3,1.0,1.5,1.2,2.5\n"
        "b,0.3,nan,,,-1\n"
        "c,0.3,1.0,,,1,extra\n"
        "d,,1.0,,0,\n"
    )
    path = write(tmp_path, text)
    with pytest.raises(InputError) as error:
        read_inventory(path)
    faults = str(error.value).splitlines()
    expected = [
        "line 3, width_m: expected a positive number, found '-1'",
        "line 3, height_m: expected a positive number, found 'wide'",
        "line 3, name: is empty",
        "line 4, quantity: expected a whole number, found 2.5",
        "line 4, eccentricity: must lie between 0 and 1",
        "line 4, cg_height_m: 1.5 m is not inside the body",
        "line 5, height_m: expected a positive number, found 'nan'",
        "line 5, quantity: expected a positive number, found '-1'",
        "line 6: has more cells",
        "line 7, eccentricity: expected a positive number, found '0'",
        "line 7, width_m: is empty",
    ]
    assert len(faults) == len(expected)
    for message in expected:
        assert sum(fault.startswith(f"{path}, {message}") for fault in faults) == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file is empty"),
        ("name,width_m,height_m\n", "holds no objects"),
        ("name,width_m,height_m\n,,\n", "holds no objects"),
        ("name,width_m\na,1\n", "I found no column for the height"),
        ("name,width_km,height_m\na,1,2\n", "is 'width' in one of m, .* meant"),
        ("name,w_m,width_m,height_m\na,1,1,2\n", "2 columns mean 'width': 'w_m', 'width_m'"),
    ],
)
def test_faults_of_the_table(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_inventory(write(tmp_path, text))


def test_files_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_inventory(tmp_path / "none.csv")
    with pytest.raises(InputError, match="is a folder"):
        read_inventory(tmp_path)
    path = tmp_path / "binary.csv"
    path.write_bytes(b"\xff\xfe\x00name")
    with pytest.raises(InputError, match="not a text file"):
        read_inventory(path)


def test_mass_lies_within_the_body(tmp_path: Path) -> None:
    head = "name,width_m,height_m,cg_height_m,gyration_radius_m\n"
    # i² <= 0.2 · 0.8 + 0.15 · 0.15 = 0.427² m²
    with pytest.raises(InputError, match=r"gyration_radius_m: found 0\.5 m; .* at most 0\.427 m"):
        read_inventory(write(tmp_path, head + "a,0.3,1.0,0.2,0.5\n"))
    (low,) = read_inventory(write(tmp_path, head + "a,0.3,1.0,0.05,\n"))
    assert low.body.gyration_radius == pytest.approx(math.sqrt(0.05 * 0.95 + 0.15**2))


def test_example() -> None:
    items = read_inventory(example_inventory())
    assert len(items) >= 12
    assert all(item.depth_known and item.sideways for item in items)  # it is what users copy
    smaller = {
        (min(item.body.base, item.sideways.base), item.height) for item in items if item.sideways
    }
    fema_p58 = {(0.32, h) for h in (0.74, 1.04, 1.42, 1.80, 2.06)} | {(0.38, 0.61), (0.38, 1.32)}
    assert fema_p58 <= smaller
    assert {item.name for item in items if item.must_not_fall} == {"Oxygen cylinder 50 l"}
    assert {item.castors for item in items} == {Castors.NONE, Castors.FREE, Castors.LOCKED}
    assert any(item.body.left != item.body.base / 2 for item in items)


def test_an_infinite_quantity_is_a_fault_like_others(tmp_path: Path) -> None:
    path = tmp_path / "things.csv"
    path.write_text("name,width_m,height_m,quantity\na,0.3,1,inf\n")
    with pytest.raises(InputError, match="quantity: expected a positive number, found 'inf'"):
        read_inventory(path)


def test_a_long_number_is_refused_at_once(tmp_path: Path) -> None:
    # a pattern that tries every split of the digits would take minutes
    path = write(tmp_path, f"name,width_m,height_m\nshelf,{'1' * 100_000}x,1.8\n")
    with pytest.raises(InputError, match="has 100,001 characters"):
        read_inventory(path)


def test_limits_of_an_inventory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # a table that was transposed: 50,000 columns took 16 s and a message of 10 MB
    with pytest.raises(InputError, match="what is listed needs a row each, not a column"):
        read_inventory(write(tmp_path, ",".join(f"object {k}" for k in range(50_000)) + "\n"))
    monkeypatch.setattr(sheet, "MOST_ROWS", 10)
    rows = "".join(f"thing {k},0.3,1.8\n" for k in range(11))
    with pytest.raises(InputError, match="holds more than 10 rows"):
        read_inventory(write(tmp_path, f"name,width_m,height_m\n{rows}"))


@pytest.mark.parametrize(
    ("castors", "anchored", "shape", "found"),
    [
        ("libres", "no", "caja", (Castors.FREE, False, BaseShape.BOX)),
        ("con freno", "Sin cadena", "patas", (Castors.SOME, False, BaseShape.FEET)),
        ("sin ruedas", "Sí", "cilindro", (Castors.NONE, True, BaseShape.CYLINDER)),
        ("frei", "nein", "rechteckig", (Castors.FREE, False, BaseShape.BOX)),
        ("gebremst", "verankert", "Füße", (Castors.LOCKED, True, BaseShape.FEET)),
        ("keine", "ja", "rund", (Castors.NONE, True, BaseShape.CYLINDER)),
        ("ninguna", "con cadena", "redondo", (Castors.NONE, True, BaseShape.CYLINDER)),
    ],
)
@pytest.mark.parametrize(
    "header",
    [
        "Nombre;Fondo;Ancho;Altura;Ruedas;Fijo al muro;Forma",
        "Bezeichnung;Tiefe;Breite;Höhe;Rollen;Verankert;Grundform",
        "name;depth;width;height;castors;anchored;shape",
    ],
)
def test_lists_in_three_languages(
    tmp_path: Path, header: str, castors: str, anchored: str, shape: str, found: object
) -> None:
    text = f"{header}\nUno;0,4;0,4;1,2;{castors};{anchored};{shape}\n"
    (item,) = read_inventory(write(tmp_path, text))
    assert (item.castors, item.anchored, item.shape) == found
    assert item.unread == ()


@pytest.mark.parametrize(
    ("name", "note", "castors"),
    [
        ("Carro de paro", "", Castors.UNKNOWN),
        ("Rollwagen", "", Castors.UNKNOWN),
        ("Estante", "con ruedas", Castors.UNKNOWN),
        ("Schrank", "auf Rollen", Castors.UNKNOWN),
        ("Estante", "sin ruedas", Castors.NONE),
        ("Schrank", "ohne Rollen", Castors.NONE),
        ("Cabinet", "no wheels", Castors.NONE),
        ("Cabinet", "no longer on wheels", Castors.NONE),
        ("Cabinet", "wheels: none", Castors.NONE),
        ("Ventilador de techo", "no tiene ruedas", Castors.NONE),
    ],
)
def test_castors_are_asked_for_in_three_languages(
    tmp_path: Path, name: str, note: str, castors: Castors
) -> None:
    text = f"name,depth_m,width_m,height_m,note\n{name},0.4,0.9,1.2,{note}\n"
    (item,) = read_inventory(write(tmp_path, text))
    assert item.castors is castors


@pytest.mark.parametrize(
    ("header", "value", "stops"),
    [
        ("Rodízios", "livres", True),  # Portuguese: castors
        ("Roulettes", "oui", True),  # French: castors
        ("Cadena de seguridad", "", True),  # Spanish: a chain
        ("Rögzítve", "x", True),  # Hungarian: fixed; its value is an answer
        ("Ancoré", "", True),
        ("Bauart", "rund", True),  # German: kind; its value is a shape
        ("Asegurado", "sí", True),  # Spanish: insured, or made fast
        ("Supplier", "Acme", False),
        ("Ground floor area", "12", False),
        ("Kontrolle", "2024", False),
        ("Activo fijo", "123", False),
        ("Serial", "-", False),
        ("Format", "A4", False),
        ("Order", "7", False),
        ("#Castor type", "x", False),
        ("Nummer", "4711", False),
        ("#Rodízios", "livres", False),  # left out on purpose
        ("# insured", "yes", False),
    ],
)
def test_a_column_that_may_say_castors_stops_the_classes(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, header: str, value: str, stops: bool
) -> None:
    text = f"name,depth_m,width_m,height_m,{header}\nshelf,0.4,0.9,1.2,{value}\nbox,1,1,0.5,\n"
    items = read_inventory(write(tmp_path, text))
    assert [bool(item.unread) for item in items] == [stops, stops]
    assert ("nothing gets a class" in caplog.text) == stops


@pytest.mark.parametrize(
    ("note", "stands_on"),
    [
        ("auf Tisch", "auf Tisch"), ("sobre mesa", "sobre mesa"), ("two pieces", "two pieces"),
        ("on unit 50 high", "on unit 50"), ("gestapelt", "gestapelt"), ("auf Stativ", "auf Stativ"),
        ("auf Regal, oberstes Brett", "auf Regal"), ("sul carrello", "sul carrello"),
        ("冷蔵庫の上", "冷蔵庫の上"), ("on a stand", "on a stand"), ("", ""), ("上に複合機", ""),
    ],
)  # fmt: skip
def test_what_stands_on_something_is_said_to(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, note: str, stands_on: str
) -> None:
    text = f'name,depth_m,width_m,height_m,note\nvase,0.2,0.2,0.5,"{note}"\nbox,1,1,1,\n'
    vase, _ = read_inventory(write(tmp_path, text))
    assert vase.stands_on == stands_on
    assert ("'vase' stand on something else, or are stacked" in caplog.text) is bool(stands_on)
    assert "'box'" not in caplog.text


@pytest.mark.parametrize(
    "note", ["on pedestal", "auf dem Labortisch", "sobre mesón", "on a fixed shelf", "実験台の上"]
)
def test_what_stands_on_something_fastened_counts_as_on_the_floor_and_is_asked(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, note: str
) -> None:
    text = f"name,depth_m,width_m,height_m,note\nvase,0.2,0.2,0.5,{note}\nbox,1,1,1,\n"
    assert [each.stands_on for each in read_inventory(write(tmp_path, text))] == ["", ""]
    assert "'vase' stand on a bench, a plinth or a shelf, which is taken as fas" in caplog.text
    assert "'box'" not in caplog.text


@pytest.mark.parametrize(
    ("location", "stands_on"),
    [("laboratory shelf", True), ("Tisch 3", True), ("repisa", True), ("shelf store", False),
     ("table tennis room", False), ("ward", False), ("fixed laboratory shelf", False)],
)  # fmt: skip
def test_a_location_that_is_furniture_carries(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, location: str, stands_on: bool
) -> None:
    text = f"name,depth_m,width_m,height_m,location\nvase,0.2,0.2,0.5,{location}\n"
    (vase,) = read_inventory(write(tmp_path, text))
    assert vase.stands_on == (location if stands_on else "")
    assert ("'vase' stand on something else" in caplog.text) is stands_on


@pytest.mark.parametrize(
    ("name", "note", "anchored", "hangs"),
    [
        ("Notice board, hanging", "", "", True),
        ("Sprossenwand", "fest an der Wand", "", True),
        ("Beamer", "hängt an der Decke", "", True),
        ("Hängeschrank", "", "", True),
        ("Wall cupboard", "", "", True),
        ("Televisor", "colgado en la pared", "", True),
        ("Pensile", "", "", True),
        ("書庫", "突っ張り棒", "", True),
        ("サーバーラック", "アンカー", "", True),
        ("Regal", "steht an der Wand", "", False),
        ("Hanging file cabinet", "", "", False),
        ("Bookcase", "floor to ceiling", "", False),
        ("Anaesthesia machine", "gas hoses from the ceiling", "", False),
        ("Narkosegerät", "Schläuche von der Decke", "", False),
        ("Máquina de anestesia", "mangueras del techo", "", False),
        ("Lamp", "comes from the ceiling", "", True),
        ("Bookcase", "reaches to the ceiling", "", False),
        ("Estante", "llega al techo", "", False),
        ("Regal", "reicht bis an die Decke", "", False),
        ("Bookcase", "should be fixed to the wall", "", False),
        ("Bookcase", "to be anchored", "", False),
        ("Bookcase", "next to wall cupboard", "", False),
        ("Regal", "neben Hängeschrank", "", False),
        ("Cabinet", "for suspended files", "", False),
        ("Coat stand", "coats hung on it", "", False),
        ("Desk", "TV hangs above it", "", False),
        ("書庫", "突っ張り棒なし", "", False),
        ("Schülerspinde", "nebeneinander, nicht verschraubt", "", False),
        ("Wall cupboard", "", "no", False),  # a column that says it decides
        ("Wall cupboard", "", "yes", False),  # then it is anchored
    ],
)
def test_what_hangs_or_is_fixed_is_asked_about(
    tmp_path: Path, caplog: pytest.LogCaptureFixture,
    name: str, note: str, anchored: str, hangs: bool,
) -> None:  # fmt: skip
    text = (
        "name,depth_m,width_m,height_m,note,anchored\n"
        f'"{name}",0.3,0.6,0.7,"{note}",{anchored}\nbox,1,1,1,,\n'
    )
    item, box = read_inventory(write(tmp_path, text))
    assert (item.hangs, item.loose, box.loose) == (hangs, not hangs and anchored != "yes", True)
    assert ("may hang, or be fixed to the building" in caplog.text) is hangs


def test_what_rolls_does_not_hang(tmp_path: Path) -> None:
    text = "name,depth_m,width_m,height_m,castors,note\n" + "".join(
        f"Monitor {castors},0.5,0.6,1.4,{castors},from the ceiling\n"
        for castors in ("free", "yes", "none")
    )
    assert [item.hangs for item in read_inventory(write(tmp_path, text))] == [False, False, True]


@pytest.mark.parametrize(
    ("cell", "castors"),
    [
        ("yes", Castors.SOME), ("Y", Castors.SOME), ("lockable", Castors.SOME),
        ("5 castors", Castors.SOME), ("yes, brakes", Castors.SOME), ("fahrbar", Castors.SOME),
        ("Rollen mit Feststeller", Castors.SOME), ("キャスター付", Castors.SOME),
        ("con ruedas", Castors.SOME), ("su ruote", Castors.SOME), ("no, on feet", Castors.NONE),
        ("ohne Rollen", Castors.NONE), ("sí, sueltas", Castors.FREE),
        ("yes, brakes on", Castors.LOCKED), ("yes - not locked", Castors.FREE),
        ("can be locked", Castors.SOME), ("2 of 4 locked", Castors.SOME), ("locked?", Castors.SOME),
        ("ロックしていない", Castors.SOME),
    ],
)  # fmt: skip
def test_cells_of_castors(tmp_path: Path, cell: str, castors: Castors) -> None:
    text = f'name,depth_m,width_m,height_m,Wheels?\ncart,0.5,0.6,1.1,"{cell}"\n'
    (item,) = read_inventory(write(tmp_path, text))
    assert (item.castors, item.unread) == (castors, ())


@pytest.mark.parametrize(
    ("cell", "anchored"),
    [
        ("chain", True), ("screws", True), ("yes (4 bolts)", True), ("mit Ketten", True),
        ("2 tornillos", True), ("con catena", True), ("チェーン", True), ("連結なし", False),
        ("no, planned", False), ("chain missing", False), ("nicht verschraubt", False),
        ("noch nicht", False),
    ],
)  # fmt: skip
def test_cells_of_what_fixes_it(tmp_path: Path, cell: str, anchored: bool) -> None:
    text = f'name,depth_m,width_m,height_m,Fixed?\nrack,0.5,0.6,1.9,"{cell}"\nbox,1,1,1,\n'
    item, _ = read_inventory(write(tmp_path, text))
    assert (item.anchored, item.unread) == (anchored, ())


@pytest.mark.parametrize(
    "cell",
    ["unanchored", "unbolted", "to be bolted", "needs a bracket", "strap ordered", "loose cable",
     "unbefestigt", "unverankert", "soll verankert werden", "Kette bestellt", "falta anclar",
     "por anclar", "da ancorare", "固定していない", "要固定", "固定予定", "bolted?"],
)  # fmt: skip
def test_what_is_not_fixed_yet_is_asked_about_and_simulated(tmp_path: Path, cell: str) -> None:
    text = f'name,depth_m,width_m,height_m,Fixed?\nrack,0.5,0.6,1.9,"{cell}"\nbox,1,1,1,\n'
    item, _ = read_inventory(write(tmp_path, text))
    assert (item.anchored, item.loose, item.unread) == (False, True, ("Fixed?",))


def test_a_cell_that_is_not_understood_is_asked_with_what_is_accepted(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    text = "name,depth_m,width_m,height_m,castors,anchored\ncart,0.5,0.6,1.1,maybe,?\nbox,1,1,1,,\n"
    item, box = read_inventory(write(tmp_path, text))
    assert (item.unread, box.unread) == (("castors", "anchored"), ())
    assert "'maybe' cannot be read" in caplog.text
    assert "none, free, locked, or yes if that is not known" in caplog.text


def test_a_column_says_what_things_stand_on(tmp_path: Path) -> None:
    """Floors and what is fastened are the floor; what the column says decides."""
    text = (
        "name,depth_m,width_m,height_m,Support,note\nvase,0.2,0.2,0.5,trolley,on a table\n"
        "jar,0.2,0.2,0.5,floor,on a table\nbust,0.3,0.3,0.5,plinth,\nbox,1,1,1,,\n"
    )
    assert [each.stands_on for each in read_inventory(write(tmp_path, text))] == [
        "trolley", "", "", "",
    ]  # fmt: skip


@pytest.mark.parametrize("header", ["Apoyado en", "Sockel"])
def test_a_column_of_what_things_stand_on_is_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, header: str
) -> None:
    text = f"name,depth_m,width_m,height_m,{header}\nvase,0.2,0.2,0.5,Tisch\nbox,1,1,1,\n"
    read_inventory(write(tmp_path, text))
    assert f"'{header}' may say what objects stand on, which is not simulated" in caplog.text


def test_a_row_has_the_number_that_messages_about_it_have(tmp_path: Path) -> None:
    path = write(
        tmp_path, "My list\n\nname,depth_m,width_m,height_m\nshelf,0.4,0.9,1.2\nbox,1,1,1\n"
    )
    assert [item.row for item in read_inventory(path)] == [4, 5]
    wrong = write(tmp_path, "My list\n\nname,depth_m,width_m,height_m\nshelf,0.4,0.9,high\n")
    with pytest.raises(InputError, match="line 4, height_m"):
        read_inventory(wrong)


def test_a_department_and_a_room_are_two_columns(tmp_path: Path) -> None:
    """One of them is the location; a list with both is not refused."""
    for header in ("Servicio;Sala", "Abteilung;Raum"):
        text = f"Nombre;Fondo;Ancho;Altura;{header}\nUno;0,4;0,9;1,2;UCI;12\n"
        (item,) = read_inventory(write(tmp_path, text))
        assert (item.location, item.unread) == ("12", ())


def test_an_error_holds_the_faults_that_it_lists(tmp_path: Path) -> None:
    """For programs, which need not read its words: where, in which column and of what kind."""
    path = tmp_path / "list.csv"
    path.write_text("name,width_m,height_m,castors\na,0.3,x,\n,0.3,1,\nc,300,2,free\n")
    with pytest.raises(InputError) as told:
        read_inventory(path)
    assert [fault[1:4] for fault in told.value.faults] == [
        ("line 2", "height_m", "number"),
        ("line 3", "name", "empty"),
        ("line 4", "width_m", "implausible"),
        ("", "", "accepted"),
    ]
    assert {fault.path for fault in told.value.faults} == {path}
    assert str(told.value) == "\n".join(map(str, told.value.faults))


def test_faults_of_one_cause_are_one_with_all_its_rows(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    rows = "".join(f"item {k},x,y\n" for k in range(9))
    path.write_text(f"name,width_m,height_m\n{rows}")
    with pytest.raises(InputError) as told:
        read_inventory(path)
    assert [(fault.where, fault.column) for fault in told.value.faults] == [
        ("line 2–10", "width_m"), ("line 2–10", "height_m"),
    ]  # fmt: skip


def test_faults_that_differ_are_shown_three_times_and_the_others_by_their_rows(
    tmp_path: Path,
) -> None:
    path = tmp_path / "list.csv"
    rows = "".join(f"item {k},0.3,x{k}\n" for k in (1, 2, 3, 4, 5, 6))
    path.write_text(f"name,width_m,height_m\n{rows}good,0.3,1.8\nitem 8,0.3,x8\n")
    with pytest.raises(InputError) as told:
        read_inventory(path)
    assert [fault.where for fault in told.value.faults] == [
        "line 2", "line 3", "line 4", "line 5–7, 9",
    ]  # fmt: skip
    assert "the same there, 4 times" in str(told.value)


def test_what_is_not_needed_and_cannot_be_read_is_left_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """Numbers as if they were not given; of words that decide the object gets no class."""
    path = tmp_path / "list.csv"
    path.write_text(
        "name,width_m,height_m,mass_kg,quantity,castors,people_nearby,anchored\n"
        "a,0.3,1.8,ca. 350,?,none,no,no\nb,0.3,1.8,40,2,maybe,perhaps,no\n"
        "c,0.3,1.8,approx.,3,,,somehow\nd,0.3,1.8,50,1,,,\n"
    )
    a, b, c, d = read_inventory(path)
    assert (a.mass, a.quantity, b.mass, c.mass, d.mass) == (350.0, 1, 40.0, None, 50.0)
    assert (a.unread, b.unread, c.unread, d.unread) == ((), ("castors",), ("anchored",), ())
    assert [b.people_nearby, c.anchored] == [False, False]
    for said in (
        "line 2, mass_kg: 'ca. 350' is taken as 350", "line 4, mass_kg: 'approx.'",
        "line 2, quantity: '?'", "line 3, castors: 'maybe' cannot be read, accepted: none, free",
        "line 3, people_nearby: 'perhaps'",
    ):  # fmt: skip
        assert said in caplog.text


def test_of_a_range_the_less_stable_end_is_taken(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / "list.csv"
    path.write_text(
        "name,depth_cm,width,height_cm,mass_kg\nshelf,30–35,80 - 90 cm,180 bis 190,40-60\n"
    )
    (shelf,) = read_inventory(path)
    assert shelf.sideways is not None
    sizes = (shelf.body.base, shelf.sideways.base, shelf.height, shelf.mass)
    assert sizes == pytest.approx((0.30, 0.80, 1.90, 60.0))
    assert "line 2, depth_cm: '30–35' is taken as 30" in caplog.text
