"""A published library: the table of its rows, read from its file, and rows found in it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from shaketable.errors import InputError, named, quoted, refused
from shaketable.library.table import COLUMNS, TEXT, WHOLE

if TYPE_CHECKING:
    import pandas as pd

MOST_NAMED = 5


def read_library_table(path: str | Path) -> pd.DataFrame:
    """The rows of a library, as `shaketable campaign collect` wrote them.

    Args:
        path: of its functions.csv.

    Returns:
        The columns of COLUMNS; text that is empty is "".

    Raises:
        InputError: it cannot be read, lacks columns, or has a cell that is no number where one
            must be; it names the column.
    """
    import pandas as pd

    path = Path(path)
    try:
        table = pd.read_csv(path, dtype=str, keep_default_na=False)
    except (OSError, ValueError) as error:
        raise refused(path, f"cannot be read ({error})") from None
    table = table.rename(columns={"leaning": "held_up"})  # of edition 1.0
    missing = [name for name in COLUMNS if name not in table]
    if missing:
        raise refused(
            path,
            f"has no column {named(missing, MOST_NAMED)}; a library's rows are in the "
            "functions.csv that `shaketable campaign collect` writes",
        )
    for name, column in COLUMNS.items():
        if column.kind == TEXT:
            continue
        numbers = pd.to_numeric(table[name].replace("", None), errors="coerce")
        bad = numbers.isna() & (table[name] != "")
        if column.kind == WHOLE:
            bad |= numbers.notna() & (numbers % 1 != 0)
        wrong = table.index[bad]
        if wrong.size:
            found = quoted(str(table[name][wrong[0]]))
            line = f"line {int(wrong[0]) + 2}"
            wanted = "a whole number" if column.kind == WHOLE else "a number"
            raise refused(path, f"expected {wanted}, found {found}", where=line, column=name)
        table[name] = numbers.astype("Int64" if column.kind == WHOLE else "float64")
    return table[list(COLUMNS)]


def found_rows(
    table: pd.DataFrame,
    *,
    words: str = "",
    limit_state: str | None = None,
    measure: str | None = None,
    place: str | None = None,
    held: str | None = None,
) -> pd.DataFrame:
    """The rows of a library that have all of some words, and are of a state, measure and place.

    Args:
        table: of the library.
        words: each a whole word of the id, the thing, the place or how it is held.
        limit_state, measure, place, held: exactly as the table has them; any if None.

    Raises:
        InputError: a value that the table has not got, or no row left.
    """
    chosen = {"limit_state": limit_state, "measure": measure, "place": place, "held": held}
    found = table
    for column, value in chosen.items():
        if value is None:
            continue
        there = [str(each) for each in table[column].unique()]
        if value not in there:
            raise InputError(
                f"{column}: the library has no {quoted(value)}; it has {named(there, 20)}"
            )
        found = found[found[column] == value]
    told = found["id"] + " " + found["thing"] + " " + found["place"] + " " + found["held"]
    for word in words.lower().split():
        whole = rf"(?<![a-z0-9]){re.escape(word)}(?![a-z0-9])"  # "free" is not in "freezer"
        found = found[told.loc[found.index].str.lower().str.contains(whole)]
    if found.empty:
        raise InputError(f"the library has no such rows; its things are "
                         f"{named(list(table['thing'].unique()), 10)}")  # fmt: skip
    return found
