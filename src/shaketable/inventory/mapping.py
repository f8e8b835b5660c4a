"""What a list does not say of itself: a file beside it, which is read with it.

sheet = "2026"            # of a workbook

[columns]
"Gerät" = "name"
"H" = "height_cm"
"Anschaffung" = ""        # not used
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from shaketable.errors import quoted
from shaketable.inventory.columns import ColumnsSaid, understood
from shaketable.inventory.vocabulary import heading
from shaketable.language import tell
from shaketable.tables import Cell
from shaketable.toml_file import TomlFile

SUFFIX = ".columns.toml"


@dataclass(frozen=True)
class ListSaid:
    """What a user says of a list.

    Attributes:
        columns: headings as they are compared, and names of columns with units.
        sheet: to be read; None where the list has one, or names it itself.
        path: of the file that says it, None without one.
    """

    columns: ColumnsSaid = field(default_factory=dict)
    sheet: str | None = None
    path: Path | None = None


def mapping_beside(path: Path) -> Path | None:
    """The file beside a list that says what its columns mean, None if there is none."""
    try:
        beside = path.with_name(path.name + SUFFIX)
        return beside if beside.is_file() else None
    except (OSError, ValueError):  # a name that is none, or too long; the list says so itself
        return None


def read_mapping(path: str | Path) -> ListSaid:
    """What a file says of a list.

    Raises:
        InputError: lists what is wrong, with the line of each.
    """
    file = TomlFile(Path(path))
    table = file.table.get("columns", {})
    sheet = file.table.get("sheet")
    known = isinstance(table, Mapping) and isinstance(sheet, str | None)
    if not known or not set(file.table) <= {"columns", "sheet"} or not file.table:
        text = tell(
            'a table is expected, [columns], of headings and meanings, and sheet = "…" where a '
            "sheet is meant"
        )
        file.note("", "columns", text)
        table = {}
    said = {}
    for name, meaning in table.items():
        if meaning != "" and not (isinstance(meaning, str) and understood(Cell(meaning, ""))):
            text = tell(
                "expected the name of a column, such as height_cm, or nothing, found {found}",
                found=quoted(str(meaning)),
            )
            file.note("", str(name), text)
        said[heading(str(name))] = str(meaning)
    file.require()
    return ListSaid(said, sheet, file.path)
