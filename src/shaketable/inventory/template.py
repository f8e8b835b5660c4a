"""An empty inventory with examples and explanations, to be filled in."""

from __future__ import annotations

import csv
from pathlib import Path

from shaketable.outputs import appearing_file

HEADER = (
    "name", "depth_m", "width_m", "height_m", "cg_height_m", "eccentricity", "quantity", "floor",
    "location", "note",
)  # fmt: skip
EXPLAINED = {
    "name": "what it is; one row for each kind",
    "depth_m": "front to back, in metres, of the base on which it stands",
    "width_m": "side to side, of the base on which it stands",
    "height_m": "full height",
    "cg_height_m": "height of its centre of gravity; half the height if left empty",
    "eccentricity": "distance of its centre of gravity from the front, as a share of the depth; "
    "0.5 if empty",
    "quantity": "how many there are; 1 if empty",
    "floor": "label of the floor, as in the building's file; may be empty",
    "location": "room or place; may be empty",
    "note": "anything else; may be empty",
}
EXAMPLES = (
    ("Bookcase", "0.32", "0.9", "1.8", "", "", "8", "", "corridor", ""),
    ("Bench-top analyser", "0.6", "0.8", "0.5", "0.2", "", "2", "", "laboratory", "on rubber feet"),
)


def write_template(path: Path) -> None:
    """Write a template: a spreadsheet if the name ends in .xlsx, a CSV file otherwise."""
    with appearing_file(path) as fresh:
        if path.suffix.lower() == ".xlsx":
            _excel(fresh)
        else:
            with fresh.open("w", newline="", encoding="utf-8") as file:
                csv.writer(file).writerows((HEADER, *EXAMPLES))


def _excel(path: Path) -> None:
    from openpyxl import Workbook
    from openpyxl.comments import Comment
    from openpyxl.styles import Font
    from openpyxl.utils import get_column_letter

    book = Workbook()
    sheet = book.worksheets[0]
    sheet.title = "Inventory"
    sheet.append(HEADER)
    for example in EXAMPLES:
        sheet.append([float(cell) if cell[:1].isdigit() else cell or None for cell in example])
    for number, name in enumerate(HEADER, 1):
        cell = sheet.cell(1, number)
        cell.font = Font(bold=True)
        cell.comment = Comment(EXPLAINED[name], "shaketable")
        sheet.column_dimensions[get_column_letter(number)].width = 16
    sheet.column_dimensions["A"].width = 30
    sheet.freeze_panes = "A2"
    explained = book.create_sheet("Columns")  # read by nobody: the sheet with the objects is named
    for row in EXPLAINED.items():
        explained.append(row)
    explained.column_dimensions["A"].width = 16
    explained.column_dimensions["B"].width = 80
    book.save(path)
