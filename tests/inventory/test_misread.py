"""What was read wrong without a word, or refused although people have it."""

from __future__ import annotations

from pathlib import Path

import pytest
from openpyxl import Workbook

from shaketable import InputError
from shaketable.inventory import BaseShape, Item, read_inventory
from shaketable.inventory.lengths import written
from shaketable.inventory.read import read_with_columns
from shaketable.inventory.sizes import order_in, parts_of, unit_beside_order
from shaketable.language import speaking
from shaketable.tables import SheetChoiceError

INCH, FOOT, POUND = 0.0254, 0.3048, 0.45359237


def read(folder: Path, text: str, encoding: str = "utf-8") -> list[Item]:
    path = folder / "list.csv"
    path.write_bytes(text.encode(encoding))
    return read_inventory(path)


def base(item: Item) -> tuple[float, float | None, float]:
    """Depth, width and height [m]."""
    across = item.sideways.base if item.sideways else None
    return (item.body.base, across, item.height)


# units --------------------------------------------------------------------------------------


def test_a_column_says_the_unit_of_each_row(tmp_path: Path) -> None:
    text = "name,depth,width,height,unit\na,1.0,2.6,4.9,ft\nb,30,80,202,cm\nc,450,900,1800,mm\n"
    a, b, c = read(tmp_path, text)
    assert base(a) == pytest.approx((1.0 * FOOT, 2.6 * FOOT, 4.9 * FOOT))
    assert base(b) == pytest.approx((0.30, 0.80, 2.02))
    assert base(c) == pytest.approx((0.45, 0.90, 1.80))
    with pytest.raises(InputError, match="is empty: in which unit are the sizes of this row"):
        read(tmp_path, text.replace("202,cm", "202,"))
    with pytest.raises(InputError, match="the unit is cm in the column's name, and ft in the row"):
        read(tmp_path, text.replace("height,unit", "height_cm,unit"))


def test_units_that_are_counted_are_quantities(tmp_path: Path) -> None:
    heads = "name,depth_m,width_m,height_m"
    items = read(tmp_path, f"{heads},Units\na,0.3,0.9,1.8,12\nb,0.3,0.9,1.7,12\n")
    assert [item.quantity for item in items] == [12, 12]
    (rack,) = read(tmp_path, f"{heads},Units\nrack,1,0.6,2,42\n")  # its own, of 44 mm
    assert rack.quantity == 1
    (item,) = read(tmp_path, "name,depth_m,width_m,height_m,Unit\na,0.3,0.9,1.8,each\n")
    assert (item.quantity, item.height) == (1, 1.8)


def test_one_size_without_a_unit_is_asked(tmp_path: Path) -> None:
    """4.5 m beside centimetres is no height that anybody meant."""
    with pytest.raises(InputError, match=r"height: names no unit, and 'depth_cm' names cm"):
        read(tmp_path, "name,depth_cm,width_cm,height\nurn,20,20,4.5\n")
    text = "name,depth_cm,width_cm,height\nurn,20,20,45 cm\n"
    assert base(read(tmp_path, text)[0]) == pytest.approx((0.2, 0.2, 0.45))


def test_a_unit_ends_with_the_cells_over_which_it_is_merged(tmp_path: Path) -> None:
    book = Workbook()
    sheet = book.worksheets[0]
    for row in (
        ["", "[cm]", None, None],
        ["name", "depth", "width", "height"],
        ["urn", 20, 25, 45],
    ):
        sheet.append(row)
    sheet.merge_cells("B1:C1")
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(InputError, match="cell D2, height: names no unit"):
        read_inventory(tmp_path / "a.xlsx")
    sheet.unmerge_cells("B1:C1")
    sheet.merge_cells("B1:D1")
    book.save(tmp_path / "a.xlsx")
    assert base(read_inventory(tmp_path / "a.xlsx")[0]) == pytest.approx((0.2, 0.25, 0.45))


@pytest.mark.parametrize(
    ("shown", "metres"),
    [
        ('0.0" ft"', FOOT), ('0" cm"', 0.01), ('#,##0.0 "in"', INCH), ('0.0\\ "ft"', FOOT),
        ('0.0" ft."', FOOT), ("0.0\\'", FOOT), ('General" ft"', FOOT), ('_-* #,##0.0" ft"_-', FOOT),
        ('0.0" Fuß"', FOOT), ("0.0", 1.0),
    ],
)  # fmt: skip
def test_a_number_format_shows_the_unit(tmp_path: Path, shown: str, metres: float) -> None:
    book = Workbook()
    sheet = book.worksheets[0]
    for row in (["name", "depth", "width", "height"], ["shelf", 12.5, 30, 60]):
        sheet.append(row)
    for cell in sheet[2][1:]:
        cell.number_format = shown
    book.save(tmp_path / "a.xlsx")
    (item,) = read_inventory(tmp_path / "a.xlsx", accept_sizes=True)
    assert base(item) == pytest.approx((12.5 * metres, 30 * metres, 60 * metres))


def test_what_is_said_of_a_column_must_not_contradict_its_heading(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    path.write_text("name,depth_m,Tall (cm)\nshelf,0.3,180\n")
    said = tmp_path / "said.toml"
    said.write_text('[columns]\n"Tall (cm)" = "height_mm"\n')
    with pytest.raises(InputError, match="the heading says cm and what is said of the column mm"):
        read_inventory(path, columns=said)
    said.write_text('[columns]\n"Tall (cm)" = "height_cm"\n')
    assert read_inventory(path, columns=said)[0].height == pytest.approx(1.8)


def test_another_unit_among_the_objects_is_refused(tmp_path: Path) -> None:
    rows = "name,depth_cm,width_cm,height_cm\na,30,90,180\n{}b,30,90,180\n"
    for said in ("From here on all dimensions in mm", "Sizes in inches", "Workshop (in inches)"):
        with pytest.raises(InputError, match="line 3: says another unit among the objects"):
            read(tmp_path, rows.format(f"{said},,,\n"))
    assert len(read(tmp_path, rows.format("All dimensions in cm,,,\n"))) == 2


@pytest.mark.parametrize(
    "title",
    ["Units: ft", "All dimensions in feet.", "All values in feet", "Unit of measurement: foot",
     "Alle Angaben in Fuß", "Medidas en pies"],
)  # fmt: skip
@pytest.mark.parametrize("below", [False, True])
def test_units_in_titles_and_footnotes(tmp_path: Path, title: str, below: bool) -> None:
    table = "name,depth,width,height\nshelf,1.5,3,4.5\n"
    text = f"{table}\n{title}\n" if below else f"{title}\n{table}"
    assert base(read(tmp_path, text)[0]) == pytest.approx((1.5 * FOOT, 3 * FOOT, 4.5 * FOOT))


@pytest.mark.parametrize("row", ["Unit,ft,ft,ft", "(ft),,,", ",ft,ft,ft"])
def test_a_row_of_units(tmp_path: Path, row: str) -> None:
    (item,) = read(tmp_path, f"name,depth,width,height\n{row}\nshelf,1.5,3,4.5\n")
    assert base(item) == pytest.approx((1.5 * FOOT, 3 * FOOT, 4.5 * FOOT))


def test_a_title_of_several_units_is_asked(tmp_path: Path) -> None:
    table = "name,depth,width,height\nshelf,30,90,180\n"
    with pytest.raises(InputError, match="names several units"):
        read(tmp_path, f"All dimensions in cm; height in inches\n{table}")
    # a title in brackets is no unit
    with pytest.raises(InputError, match="is not to be expected"):
        read(tmp_path, f"Indiana State Museum (IN)\n{table}")


def test_masses_beside_inches_are_asked(tmp_path: Path) -> None:
    text = "name,depth_in,width_in,height_in,weight\nshelf,12,36,72,{}\n"
    with pytest.raises(InputError, match="is it in kg or in lb"):
        read(tmp_path, text.format(150))
    assert read(tmp_path, text.format("150 lb"))[0].mass == pytest.approx(150 * POUND)
    text = "name,depth_cm,width_cm,height_cm,weight,unit\nshelf,30,90,180,150,lb\n"
    assert read(tmp_path, text)[0].mass == pytest.approx(150 * POUND)


def test_a_header_again_with_other_units_is_refused(tmp_path: Path) -> None:
    head = "name,depth,width,height\n,{0},{0},{0}\n"
    text = f"{head.format('cm')}vase,20,20,40\n{head.format('in')}urn,10,10,20\n"
    with pytest.raises(InputError, match="line 5: the header comes again with other units"):
        read(tmp_path, text)


# headings -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("heading", "value"), [("Dept", "3"), ("Pesos", "900"), ("With", "2"), ("Fondos", "12")]
)
def test_words_of_their_own_are_no_slips(tmp_path: Path, heading: str, value: str) -> None:
    (item,) = read(tmp_path, f"name,width_m,height_m,{heading}\nshelf,0.4,1.8,{value}\n")
    assert base(item) == (0.4, None, 1.8)
    assert item.mass is None


@pytest.mark.parametrize(
    ("heading", "values", "quantity"),
    [
        ("Number", "3 3 8", 8),
        ("No.", "1 2 3", 1),  # they number the rows
        ("N.", "2 1 2", 2),
        ("Number", "1041 1042 1042", 1),  # too large to count
        ("Anz.", "4 5 6", 6),
        ("No. of pieces", "4 5 6", 6),
        ("Cant.", "4 5 6", 6),
        ("N. pezzi", "4 5 6", 6),
        ("Menge", "4 5 6", 6),
        ("台数", "4 5 6", 6),
    ],
)
def test_quantities(tmp_path: Path, heading: str, values: str, quantity: int) -> None:
    rows = "".join(f"{'abc'[k]},0.3,0.9,1.8,{each}\n" for k, each in enumerate(values.split()))
    assert (
        read(tmp_path, f"name,depth_m,width_m,height_m,{heading}\n{rows}")[2].quantity == quantity
    )


def test_a_name_is_text(tmp_path: Path) -> None:
    sizes = "Height (cm),Width (cm),Depth (cm)"
    (item,) = read(tmp_path, f"Item,Title,ObjectID,{sizes}\n1,Amphora,7,48,31,30\n")
    assert item.name == "Amphora"
    (item,) = read(tmp_path, f"Object,Title,{sizes}\nVase,Spring,48,31,30\n")
    assert item.name == "Vase"  # the stronger heading


@pytest.mark.parametrize(
    "heading",
    [
        "Höhe in cm",
        "H/cm",
        "Höhe cm",
        "Height [cm]",
        "Alt. cm",
        "高さcm",
        "高さ（cm）",
        "height_cm",
    ],
)
def test_units_in_headings(tmp_path: Path, heading: str) -> None:
    (item,) = read(tmp_path, f"name,depth_cm,width_cm,{heading}\nshelf,30,90,180\n")
    assert base(item) == pytest.approx((0.3, 0.9, 1.8))


def test_two_rows_of_heading(tmp_path: Path) -> None:
    text = "Name,Size (cm),,,Weight\n,H,W,D,kg\nBookcase,180,90,32,50\n"
    (item,) = read(tmp_path, text)
    assert (base(item), item.mass) == (pytest.approx((0.32, 0.9, 1.8)), 50.0)
    # T is a depth here, and no tonne
    (item,) = read(tmp_path, "Artikel;Maße in cm;;;Gewicht\n;B;T;H;kg\nRegal;90;32;180;50\n")
    assert base(item) == pytest.approx((0.32, 0.9, 1.8))


def test_headings_of_parts_are_places(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    head, row = "name,depth_m,width_m,height_m", "shelf,0.3,0.9,1.8"
    text = f"{head}\nRoom 1,,,\n{row}\n\nRoom 2,,,\n{row}\nRoom 3,closed,,\n{row}\n"
    assert [(item.name, item.location) for item in read(tmp_path, text)] == [
        ("shelf", "Room 1"), ("shelf", "Room 2"), ("shelf", "Room 3"),
    ]  # fmt: skip
    assert "'Room 1', 'Room 2', 'Room 3' are read as headings of parts of the list" in caplog.text


def test_an_index_has_no_name(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert len(read(tmp_path, ",name,depth_m,height_m\n0,a,0.3,1.8\n1,b,0.4,1.7\n")) == 2
    assert "a column without a name that numbers the rows" in caplog.text
    with pytest.raises(InputError, match="stands in a column that the header does not name"):
        read(tmp_path, ",name,depth_m,height_m\n7,a,0.3,1.8\n5,b,0.4,1.7\n")


def test_yes_and_no_of_something_else_take_no_class_away(tmp_path: Path) -> None:
    text = "name,depth_m,height_m,{}\na,0.3,1.8,Yes\nb,0.4,1.7,No\n"
    assert [item.unread for item in read(tmp_path, text.format("in_warranty"))] == [(), ()]
    assert [item.unread for item in read(tmp_path, text.format("Roulettes"))] == [
        ("Roulettes",)
    ] * 2


def test_a_column_that_is_missing_is_asked_for_in_the_users_words(tmp_path: Path) -> None:
    text = "Gegenstand;Tiefe;Breite;Ausdehnung\nRegal;30;90;180\n"
    with speaking("de"), pytest.raises(InputError) as told:
        read(tmp_path, text)
    (said,) = str(told.value).splitlines()
    assert "Spalte für die Höhe" in said
    assert "'Gegenstand', 'Tiefe', 'Breite', 'Ausdehnung'" in said
    assert "'Höhe (cm)' wie in der Vorlage" in said


# numbers ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("ca. 140", "140"), ("approx. 80", "80"), ("140 circa", "140"), ("約600mm", "600mm"),
        ("6'8\"", "80 in"), ("35 3/4\"", "35.75 in"), ("5 ft", "60 in"), ("22 1/2", "22.5"),
        ("1,10 m", "1,10 m"), ("180-190", "180-190"),
    ],
)  # fmt: skip
def test_numbers_as_people_write_them(text: str, plain: str) -> None:
    assert written(text).text == plain


@pytest.mark.parametrize(
    ("column", "mass"),
    [
        ("1.250 155 180", 1250.0),  # beside whole numbers
        ("1.250 1,5 2,5", 1250.0),  # beside decimal commas
        ("1.250 1.5 2.5", 1.25),
        ("1.250 1.300 1.400", None),  # nothing tells
        ("1.250 3 4", None),  # whole numbers say nothing of thousandths
        ("1.250.000 155 180", None),  # more than anything of this size weighs
    ],
)
def test_thousands_and_decimals(tmp_path: Path, column: str, mass: float | None) -> None:
    rows = "".join(f"{'abc'[k]};0,5;0,5;0,8;{each}\n" for k, each in enumerate(column.split()))
    path = tmp_path / "list.csv"
    path.write_text(f"name;depth_m;width_m;height_m;mass_kg\n{rows}")
    if mass is None:
        with pytest.raises(InputError, match=r"which may be 1\.25 or 1250|is not to be expected"):
            read_inventory(path)
    else:
        assert read_inventory(path, accept_sizes=True)[0].mass == mass


def test_money_has_no_thousandths(tmp_path: Path) -> None:
    text = "Objeto;Fondo (cm);Ancho (cm);Alto (cm);Costo de reposición\nLibrero;30;90;180;125.000\n"
    assert read(tmp_path, text)[0].cost == 125_000.0
    with pytest.raises(InputError, match="which may be 2 or 2000"):
        read(tmp_path, "name;depth_m;height_m;quantity\nshelf;0,3;1,8;2.000\n")


# several sizes in a cell --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("heading", "order", "unit"),
    [
        ("Size H x W x D (cm)", ("height", "width", "depth"), "cm"),
        ("Dimensions (WxDxH)", ("width", "depth", "height"), ""),
        ("L x W x H, mm", ("depth", "width", "height"), "mm"),
        ("Maße (H x B x T in cm)", ("height", "width", "depth"), "cm"),
        ("Medidas (alto x ancho x fondo)", ("height", "width", "depth"), ""),
        ("L x P x H (mm)", ("width", "depth", "height"), "mm"),
        ("サイズ（W×D×H mm）", ("width", "depth", "height"), "mm"),
        ("size_hwd_in", ("height", "width", "depth"), "in"),
        ("Height (cm)", (), "cm"),
        ("Width x Depth", (), ""),  # no height: two sizes of the base
    ],
)
def test_orders_in_headings(heading: str, order: tuple[str, ...], unit: str) -> None:
    assert (order_in(heading), unit_beside_order(heading)) == (order, unit)


@pytest.mark.parametrize(
    ("cell", "sizes"),
    [
        ("180x90x32", [("", "180", ""), ("", "90", ""), ("", "32", "")]),
        (
            "H. 60 x W. 36 x D. 18 in",
            [("height", "60", "in"), ("width", "36", "in"), ("depth", "18", "in")],
        ),
        ("W900×D300×H2100", [("width", "900", ""), ("depth", "300", ""), ("height", "2100", "")]),
        ("H 62, Dm. 34", [("height", "62", ""), ("diameter", "34", "")]),
        ("Ø 20 x 145 (alto)", [("diameter", "20", ""), ("height", "145", "")]),
        ("1,40 x 0,95 x 0,50 m", [("", "1,40", "m"), ("", "0,95", "m"), ("", "0,50", "m")]),
        ("H 60 W 36 D 18", [("height", "60", ""), ("width", "36", ""), ("depth", "18", "")]),
        ("32 x 18 in (81 x 46 cm)", [("", "32", "in"), ("", "18", "in")]),
        ("60 x 70 x 180 cm (BxTxH)",
         [("width", "60", "cm"), ("depth", "70", "cm"), ("height", "180", "cm")]),
        ("180", []),
        ("dimensions unknown", []),
    ],
)  # fmt: skip
def test_sizes_in_a_cell(cell: str, sizes: list[tuple[str, str, str]]) -> None:
    assert [tuple(part) for part in parts_of(cell)] == sizes


def test_sizes_in_one_column(tmp_path: Path) -> None:
    text = "Item,{},Weight (kg)\nFreezer,900 x 1020 x 1980,310\n"
    (item,) = read(tmp_path, text.format('"Dimensions (WxDxH, mm)"'))
    assert (base(item), item.mass) == (pytest.approx((1.02, 0.9, 1.98)), 310.0)
    with pytest.raises(InputError, match="holds several sizes: which is the height"):
        read(tmp_path, text.format("Dimensions (mm)"))
    with pytest.raises(InputError, match="names no unit, and neither does the heading"):
        read(tmp_path, text.format("Dimensions (WxDxH)"))
    path, said = tmp_path / "list.csv", tmp_path / "said.toml"
    path.write_text(text.format("Dimensions"))
    said.write_text('[columns]\nDimensions = "size_wdh_mm"\n')
    assert base(read_inventory(path, columns=said)[0]) == pytest.approx((1.02, 0.9, 1.98))


def test_what_is_round_in_one_column(tmp_path: Path) -> None:
    text = "Object,Dimensions,Weight (lb)\nKrater,H. 18 x Diam. 15 in,24\nBust,lost,\n"
    found = read_with_columns(write(tmp_path, text))
    (krater,) = found.items
    assert krater.shape is BaseShape.CYLINDER
    assert (krater.body.base, krater.height) == pytest.approx((15 * INCH, 18 * INCH))
    assert krater.mass == pytest.approx(24 * POUND)
    assert found.not_assessed == ["Bust"]


def write(folder: Path, text: str) -> Path:
    path = folder / "list.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_sizes_that_are_not_known_leave_the_others(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    text = "name,D (in),H (in),W (in)\nrack,17.5,65,20\neasel,?,?,?\ncarpet,103,-,143\n"
    found = read_with_columns(write(tmp_path, text))
    assert base(found.items[0]) == pytest.approx((17.5 * INCH, 20 * INCH, 65 * INCH))
    assert found.not_assessed == ["easel", "carpet"]
    assert "2 not assessed" in caplog.text
    # a slip is no word for what is not known
    with pytest.raises(InputError, match=r"expected a positive number, found '6\.5\.0'"):
        read_inventory(write(tmp_path, text.replace("65", "6.5.0")))


# files --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("encoding", "text", "name"),
    [
        ("cp932", "品名,奥行き(cm),幅(cm),高さ(cm)\n本棚,30,90,180\n", "本棚"),
        ("euc_jp", "品名,奥行き(cm),幅(cm),高さ(cm)\n本棚,30,90,180\n", "本棚"),
        ("cp1252", "Gerät;Tiefe (cm);Breite (cm);Höhe (cm)\nKühlschrank;30;90;180\n",
         "Kühlschrank"),
        ("utf-16", "Gerät\tTiefe (cm)\tBreite (cm)\tHöhe (cm)\nKühlschrank\t30\t90\t180\n",
         "Kühlschrank"),
    ],
)  # fmt: skip
def test_encodings(tmp_path: Path, encoding: str, text: str, name: str) -> None:
    (item,) = read(tmp_path, text, encoding)
    assert (item.name, base(item)) == (name, pytest.approx((0.3, 0.9, 1.8)))


@pytest.mark.parametrize(
    ("encoding", "text", "heading"),
    [
        ("gb18030", "名称,深度(cm),宽度(cm),高度(cm)\n书架,30,90,180\n柜子,40,80,190\n", "深度"),
        ("cp1251", "Наименование;Глубина;Ширина;Высота\nШкаф книжный;40;90;180\n", "Глубина"),
    ],
)
def test_of_other_scripts_the_headings_are_shown_as_they_are(
    tmp_path: Path, encoding: str, text: str, heading: str
) -> None:
    with pytest.raises(InputError, match=rf"Your headings are: .*{heading}"):
        read(tmp_path, text, encoding)


def test_the_largest_sheet_is_not_left_out(tmp_path: Path) -> None:
    book = Workbook()
    ward = book.worksheets[0]
    ward.title = "Ward 3B"
    ward.append(["What it is", "Deep", "Wide", "Tall"])
    for k in range(5):
        ward.append([f"bed {k}", 90, 210, 95])
    kitchen = book.create_sheet("Kitchen")
    kitchen.append(["name", "depth (cm)", "width (cm)", "height (cm)"])
    kitchen.append(["fridge", 60, 65, 180])
    book.create_sheet("Notes").append(["measured by tape"])
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(
        SheetChoiceError, match="'Ward 3B' holds 6: which of them is the list"
    ) as told:
        read_inventory(tmp_path / "a.xlsx")
    assert told.value.sheets == ("Ward 3B", "Kitchen", "Notes")
    assert read_inventory(tmp_path / "a.xlsx", sheet="Kitchen")[0].name == "fridge"


# what a hunter of misreadings found ---------------------------------------------------------


def test_sizes_of_something_else_are_not_its_own(tmp_path: Path) -> None:
    for heading in ("Packing size (L x W x H cm)", "Innenmaße (H x B x T in cm)"):
        assert order_in(heading) == ()
        with pytest.raises(InputError, match="I found no column for the height"):
            read(tmp_path, f"name,{heading}\nshelf,180 x 90 x 40\n")
    text = "Name,H x W x D (cm),Inside (cm),,\n,,Height,Width,Depth\nsafe,190x90x80,100,70,60\n"
    assert base(read(tmp_path, text)[0]) == pytest.approx((0.8, 0.9, 1.9))


def test_letters_in_a_cell_against_the_order_of_the_heading(tmp_path: Path) -> None:
    text = "name,Size W x D x H (cm)\na,{}\nb,80 x 40 x 190\n"
    found = read_with_columns(write(tmp_path, text.format("H 180 x 90 x 40")))
    assert ([item.name for item in found.items], found.not_assessed) == (["b"], ["a"])
    (a, _) = read(tmp_path, text.format("W 90 x 40 x 180"))
    assert base(a) == pytest.approx((0.4, 0.9, 1.8))


@pytest.mark.parametrize("cell", ["L 120 x H 180", "W 90 x H 180", "90 x 40 x 72 (max. 120)"])
def test_what_leaves_a_size_open_is_not_assessed(tmp_path: Path, cell: str) -> None:
    text = f"name,Size W x D x H (cm)\na,{cell}\nb,80 x 40 x 190\n"
    assert read_with_columns(write(tmp_path, text)).not_assessed == ["a"]


def test_a_size_that_is_given_twice(tmp_path: Path) -> None:
    text = "name,Dimensions,Height (cm)\ndesk,W 160 x D 80 x H 75 cm,{}\n"
    with pytest.raises(InputError, match=r"found 1\.5 m, and 0\.75 m among the sizes"):
        read(tmp_path, text.format(150))
    for height in ("75", ""):
        assert base(read(tmp_path, text.format(height))[0]) == pytest.approx((0.8, 1.6, 0.75))


def test_running_numbers_of_each_room_are_no_quantities(tmp_path: Path) -> None:
    rows = "".join(f"{n},{name},0.3,0.9,1.8\n" for n, name in ((1, "a"), (2, "b"), (1, "c")))
    items = read(tmp_path, f"No,Item,depth_m,width_m,height_m\n{rows}")
    assert [item.quantity for item in items] == [1, 1, 1]


def test_tables_side_by_side_are_refused(tmp_path: Path) -> None:
    text = "Item,depth_m,width_m,height_m,,Item,Qty\nshelf,0.3,0.9,1.8,,pens,200\n"
    with pytest.raises(InputError, match="two tables side by side"):
        read(tmp_path, text)


def test_fractions_are_of_lengths_alone(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (item,) = read(tmp_path, "name,depth_m,height_m,quantity\nshelf,0.3,1.8,12/3\n")
    assert item.quantity == 1
    assert "quantity: '12/3' cannot be read, and is left out" in caplog.text
    (item,) = read(tmp_path, "name,depth_in,width_in,height_in\nshelf,12 1/2,36,72\n")
    assert item.body.base == pytest.approx(12.5 * INCH)


@pytest.mark.parametrize("heading", ["Qty (pcs)", "Anzahl [Stk]"])
def test_units_of_what_has_none(tmp_path: Path, heading: str) -> None:
    assert read(tmp_path, f"name,depth_m,height_m,{heading}\nshelf,0.3,1.8,7\n")[0].quantity == 7


def test_a_depth_under_another_name_is_asked(tmp_path: Path) -> None:
    text = "name,Thickness (cm),width_cm,height_cm\nshelf,30,90,180\n"
    with pytest.raises(InputError, match=r"'Thickness \(cm\)' is not used: is it that"):
        read(tmp_path, text)
    assert len(read(tmp_path, text.replace("Thick", "#Thick"))) == 1


def test_a_unit_that_is_none_is_told_with_its_row(tmp_path: Path) -> None:
    text = "name,depth,width,height,unit\na,1,2,4.5,ft\nb,1,2,4.5,ea\n"
    with pytest.raises(InputError, match="line 3, unit: expected a unit of length"):
        read(tmp_path, text)


def test_codes_are_no_names(tmp_path: Path) -> None:
    text = "Item,Description,depth_m,height_m\nA-101,Oxygen cylinder,0.23,1.5\n"
    assert read(tmp_path, text)[0].name == "Oxygen cylinder"


def test_several_in_a_name_are_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    read(tmp_path, "name,depth_m,height_m\n2 x Bookcase,0.3,1.8\nChair (12 pcs),0.5,0.9\n")
    assert "may be several: each row is counted once" in caplog.text


@pytest.mark.parametrize(
    ("heading", "cell"),
    [
        ("Höhe (in cm)", "180"), ("Höhe H (cm)", "180"), ("Höhe / Height (cm)", "180"),
        ("Height (mm)", "1'800"), ("Height (mm)", "1 800"), ("Height (in.)", "70.8661417"),
        ("Höhe (cm.)", "180"),
    ],
)  # fmt: skip
def test_headings_and_cells_of_ordinary_lists(tmp_path: Path, heading: str, cell: str) -> None:
    (item,) = read(tmp_path, f"name,depth_cm,width_cm,{heading}\nshelf,30,90,{cell}\n")
    assert base(item) == pytest.approx((0.3, 0.9, 1.8))
