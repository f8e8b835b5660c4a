"""`python -m benchmarks.library_table [TABLE]`: what the rows of a library say, in two tables.

TABLE is library/edition-1.0.csv by default. The first table has the median of every thing that
stands on a floor; the second by what a wall, a strap, a tilt and a floor multiply medians.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from shaketable.fragility.limit_states import HELD_UP, LEANS, OVERTURNS
from shaketable.library.published import found_rows, read_library_table

TABLE = Path(__file__).parents[1] / "library" / "edition-1.0.csv"
GROUND, PGV, FLOOR_PGV = "ground", "PGV", "floor PGV"


class Column(NamedTuple):
    """A column of the table of things: where a thing stands, and over which measure."""

    title: str
    on_floor: bool
    held: str
    tilt: float = 0.0


COLUMNS = (
    Column("free", False, "free"),
    Column("free, 2°", False, "free", 2.0),
    Column("wall 10 mm", False, "wall 10 mm"),
    Column("wall, 2°", False, "wall 10 mm", 2.0),
    Column("strap 1 W", False, "strap 1 W"),
    Column("floor: free", True, "free"),
    Column("floor: wall", True, "wall 10 mm"),
    Column("floor: strap", True, "strap 1 W"),
)
STRONG = 3.0  # m/s: about the strongest ever recorded (Chi-Chi 1999, TCU068); above it no median
#: What is compared: each column beside that in which one thing is otherwise.
BESIDE = (
    ("at a wall, beside free", "wall 10 mm", "free"),
    ("in a strap, beside at a wall", "strap 1 W", "wall 10 mm"),
    ("on a tilt of 2°, beside level, free", "free, 2°", "free"),
    ("on a tilt of 2°, beside level, at a wall", "wall, 2°", "wall 10 mm"),
    ("at a wall, beside free, on the floor", "floor: wall", "floor: free"),
    ("in a strap, beside at a wall, on the floor", "floor: strap", "floor: wall"),
    ("PGV of the floor beside that of the ground, free", "floor: free", "free"),
    ("PGV of the floor beside that of the ground, at a wall", "floor: wall", "wall 10 mm"),
    ("PGV of the floor beside that of the ground, in a strap", "floor: strap", "strap 1 W"),
)


def medians(table: pd.DataFrame, column: Column, state: str = OVERTURNS) -> pd.Series[float]:
    """θ of the things of a column by their names [m/s]; NaN where there is no function."""
    rows = found_rows(table, limit_state=state, measure=FLOOR_PGV if column.on_floor else PGV)
    here = (rows["held"] == column.held) & (rows["tilt"] == column.tilt)
    here &= (rows["place"] != GROUND) == column.on_floor
    return rows[here].set_index("thing")["median"]


def shown(median: float) -> str:
    """In cm/s."""
    if median > STRONG:
        return f"> {100 * STRONG:.0f}"
    return "none" if np.isnan(median) else f"{100 * median:.0f}"


def ratios(values: pd.Series[float]) -> str:
    """Their geometric mean and their range."""
    return f"{np.exp(np.log(values).mean()):.2f} ({values.min():.2f} to {values.max():.2f})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", nargs="?", type=Path, default=TABLE)
    table = read_library_table(parser.parse_args().table)
    falls = table[(table["limit_state"] == OVERTURNS) & (table["edge"].isna())]
    things = falls.drop_duplicates("thing").set_index("thing")
    columns = {each.title: medians(table, each) for each in COLUMNS}
    columns = {title: each for title, each in columns.items() if each.size}
    print(f"| thing | size [m] | {' | '.join(columns)} |")
    print(f"|---|---|{'---:|' * len(columns)}")
    for thing, about in things.iterrows():
        size = f"{about['depth']:.2g}×{about['width']:.2g}×{about['height']:.3g}"
        cells = [shown(each[thing]) if thing in each else "" for each in columns.values()]
        print(f"| {thing} | {size} | {' | '.join(cells)} |")

    states = set(table["limit_state"])
    either = next((state for state in (HELD_UP, LEANS) if state in states), OVERTURNS)
    held = {
        each.title: medians(table, each, OVERTURNS if each.held == "free" else either)
        for each in COLUMNS
    }
    print("\n| compared | θ of falls is multiplied by | θ of falls or held up by | things |\n"
          "|---|---|---|---:|")  # fmt: skip
    for what, one, other in BESIDE:
        if one in columns and other in columns:
            four = pd.DataFrame(
                [columns[one], columns[other], held[one], held[other]]
            ).T.dropna()  # fmt: skip
            four = four[(four < STRONG).all(axis=1)]
            falls_by, either_by = (
                four.iloc[:, 0] / four.iloc[:, 1],
                four.iloc[:, 2] / four.iloc[:, 3],
            )
            print(f"| {what} | {ratios(falls_by)} | {ratios(either_by)} | {len(four)} |")

    known = table["median"].notna()
    print(f"\n{len(table):,} rows of {table['id'].str.rsplit('.', n=1).str[0].nunique()} cases and "
          f"{table['thing'].nunique()} things; {int(known.sum()):,} with a function, "
          f"{int((table['caution'] != '').sum()):,} of them with a caution; β of overturning "
          f"{falls['beta'].quantile(0.05):.2f} to {falls['beta'].quantile(0.95):.2f} (5 and 95 % "
          "of the rows)")  # fmt: skip


if __name__ == "__main__":
    main()
