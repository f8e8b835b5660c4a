"""What the columns of a list mean where their headings do not say it: a file beside the list.

[columns]
"Gerät" = "name"
"H" = "height_cm"
"Anschaffung" = ""        # not used
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from shaketable.errors import quoted
from shaketable.inventory.columns import ColumnsSaid, understood
from shaketable.inventory.vocabulary import heading
from shaketable.language import tell
from shaketable.tables import Cell
from shaketable.toml_file import TomlFile

SUFFIX = ".columns.toml"


def mapping_beside(path: Path) -> Path | None:
    """The file beside a list that says what its columns mean, None if there is none."""
    try:
        beside = path.with_name(path.name + SUFFIX)
        return beside if beside.is_file() else None
    except (OSError, ValueError):  # a name that is none, or too long; the list says so itself
        return None


def read_mapping(path: str | Path) -> ColumnsSaid:
    """What a file says of columns: headings as they are compared, and names of columns with units.

    Raises:
        InputError: lists what is wrong, with the line of each.
    """
    file = TomlFile(Path(path))
    table = file.table.get("columns")
    if not isinstance(table, Mapping) or set(file.table) != {"columns"}:
        file.note("", "columns", tell("one table is expected, [columns], of headings and meanings"))
        table = {}
    said = {}
    for name, meaning in table.items():
        known = meaning == "" or (isinstance(meaning, str) and understood(Cell(meaning, "")))
        if not known:
            text = tell(
                "expected the name of a column, such as height_cm, or nothing, found {found}",
                found=quoted(str(meaning)),
            )
            file.note("", str(name), text)
        said[heading(str(name))] = str(meaning)
    file.require()
    return said
