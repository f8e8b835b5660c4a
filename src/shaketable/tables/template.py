"""Tables to be filled in: their columns explained, and rows that stand there as examples."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from shaketable.atomic_files import appearing_file

if TYPE_CHECKING:
    from openpyxl import Workbook
    from openpyxl.worksheet.datavalidation import DataValidation
    from openpyxl.worksheet.worksheet import Worksheet

ROWS = 2000  # that have menus
WIDE, NARROW, TEXT = 30, 16, 80  # characters


@dataclass(frozen=True)
class Question:
    """A line of a sheet that asks for one thing beside its name.

    Attributes:
        name: of what is asked.
        explained: what it means.
        menu: what may be answered; any number, or any text, where it is empty.
    """

    name: str
    explained: str
    menu: Sequence[str] = ()


@dataclass(frozen=True)
class Template:
    """A table to be filled in.

    Attributes:
        title: of its sheet in a spreadsheet, by which it is told from the explanations.
        explained: what each column means, by its name, in their order.
        examples: rows by the columns' names.
        menus: words that a cell of a column may have, by its name.
        suggested: likewise, where any other may be written, too.
        numbers: columns of positive numbers, and whether these are whole.
        explanations: title of the sheet of the explanations.
        asked: what another sheet asks for, by its title.
    """

    title: str
    explained: Mapping[str, str]
    examples: Sequence[Mapping[str, object]]
    menus: Mapping[str, Sequence[str]] = field(default_factory=dict)
    suggested: Mapping[str, Sequence[str]] = field(default_factory=dict)
    numbers: Mapping[str, bool] = field(default_factory=dict)
    explanations: str = "Columns"
    asked: Mapping[str, Sequence[Question]] = field(default_factory=dict)


def write_template(path: Path, template: Template) -> None:
    """Write a template: a spreadsheet if the name ends in .xlsx, a CSV file otherwise."""
    with appearing_file(path) as fresh:
        if path.suffix.lower() == ".xlsx":
            _excel(fresh, template)
        else:
            # with a mark by which spreadsheet programs know UTF-8, where it is more than ASCII
            plain = all(name.isascii() for name in template.explained)
            with fresh.open("w", newline="", encoding="utf-8" if plain else "utf-8-sig") as file:
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
    _explain(book, template)
    for number, (name, meaning) in enumerate(template.explained.items(), 1):
        letter = get_column_letter(number)
        cell = sheet.cell(1, number)
        cell.font = Font(bold=True)
        cell.comment = Comment(meaning, "shaketable")
        sheet.column_dimensions[letter].width = WIDE if number == 1 else NARROW
        rule = _rule(template, name)
        if rule:
            rule.add(f"{letter}2:{letter}{ROWS}")
            sheet.add_data_validation(rule)
    sheet.freeze_panes = "B2"
    for title, questions in template.asked.items():
        _ask(book.create_sheet(title), questions)
    book.save(path)


def _rule(template: Template, name: str) -> DataValidation | None:
    """What a cell of a column may hold; None where that is anything."""
    from openpyxl.worksheet.datavalidation import DataValidation

    if name in template.menus:
        words = ",".join(template.menus[name])
        return DataValidation("list", formula1=f'"{words}"', showErrorMessage=True)
    if name in template.suggested:
        last = 1 + len(template.suggested[name])
        title = template.explanations.replace("'", "''")
        return DataValidation("list", formula1=f"'{title}'!$D$2:$D${last}")
    if name in template.numbers:
        whole = template.numbers[name]
        return DataValidation(
            "whole" if whole else "decimal",
            operator="greaterThanOrEqual" if whole else "greaterThan",
            formula1="1" if whole else "0",
            showErrorMessage=True,
        )
    return None


def _explain(book: Workbook, template: Template) -> None:
    """A sheet of what the columns mean, and of what is suggested for one of them."""
    explained = book.create_sheet(template.explanations)  # not read as rows
    for row in template.explained.items():
        explained.append(row)
    explained.column_dimensions["A"].width = NARROW
    explained.column_dimensions["B"].width = TEXT
    for name, words in template.suggested.items():
        explained.cell(1, 4, name)
        for k, word in enumerate(words, 2):
            explained.cell(k, 4, word)
        explained.column_dimensions["D"].width = WIDE


def _ask(sheet: Worksheet, questions: Sequence[Question]) -> None:
    from openpyxl.styles import Font
    from openpyxl.worksheet.datavalidation import DataValidation

    for number, one in enumerate(questions, 1):
        sheet.append([one.name, None, one.explained])
        sheet.cell(number, 1).font = Font(bold=True)
        if one.menu:
            words = ",".join(one.menu)
            rule = DataValidation("list", formula1=f'"{words}"', showErrorMessage=True)
            rule.add(f"B{number}")
            sheet.add_data_validation(rule)
    for letter, width in zip("ABC", (WIDE, WIDE, TEXT), strict=True):
        sheet.column_dimensions[letter].width = width
