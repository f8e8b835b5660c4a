"""Tables to be filled in: their columns explained, and rows that stand there as examples."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from shaketable.atomic_files import appearing_file


class Template(NamedTuple):
    """A table to be filled in.

    Attributes:
        title: of its sheet in a spreadsheet, by which it is told from the explanations.
        explained: what each column means, by its name, in their order.
        examples: rows by the columns' names.
    """

    title: str
    explained: Mapping[str, str]
    examples: Sequence[Mapping[str, object]]


def write_template(path: Path, template: Template) -> None:
    """Write a template: a spreadsheet if the name ends in .xlsx, a CSV file otherwise."""
    with appearing_file(path) as fresh:
        if path.suffix.lower() == ".xlsx":
            _excel(fresh, template)
        else:
            with fresh.open("w", newline="", encoding="utf-8") as file:
                writer = csv.DictWriter(file, list(template.explained), restval="")
                writer.writeheader()
                writer.writerows(template.examples)


def _excel(path: Path, template: Template) -> None:
    from openpyxl import Workbook
    from openpyxl.comments import Comment
    from openpyxl.styles import Font
    from openpyxl.utils import get_column_letter

    book = Workbook()
    sheet = book.worksheets[0]
    sheet.title = template.title
    sheet.append(list(template.explained))
    for example in template.examples:
        sheet.append([example.get(name) for name in template.explained])
    for number, meaning in enumerate(template.explained.values(), 1):
        cell = sheet.cell(1, number)
        cell.font = Font(bold=True)
        cell.comment = Comment(meaning, "shaketable")
        sheet.column_dimensions[get_column_letter(number)].width = 16
    sheet.column_dimensions["A"].width = 30
    sheet.freeze_panes = "A2"
    explained = book.create_sheet("Columns")  # not read as rows: the other sheet has its title
    for row in template.explained.items():
        explained.append(row)
    explained.column_dimensions["A"].width = 16
    explained.column_dimensions["B"].width = 80
    book.save(path)
