"""`python -m benchmarks.fema_p58`: FEMA P-58's furniture in the library, beside its own functions.

Medians of FEMA P-58 (2nd edition, E.20.22.102a to 125a) are as the Damage and Loss Model Library of
SimCenter holds them; ours are the rows of library/fema-p58.csv. With `--dlml FOLDER`, the folder of
the package simcenter-dlml that holds `fragility.csv` of FEMA P-58, its rows for contents are
counted.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from benchmarks.typologies import OBJECTS
from shaketable.fragility.lognormal import probability
from shaketable.library.published import found_rows, read_library_table

TABLE = Path(__file__).parents[1] / "library" / "fema-p58.csv"
#: What the library calls them, in the order of OBJECTS.
THINGS = (
    *(f"bookcase {count} shelves" for count in range(2, 7)),
    *(f"filing cabinet vertical {count} drawers" for count in (2, 4)),
    *(f"lateral file {count} drawers" for count in (4, 5)),
)
WHERE = (
    ("ground", "free", "PGV"), ("ground", "wall 10 mm", "PGV"),
    ("office6 floor 4", "free", "floor PGV"), ("office6 floor 4", "wall 10 mm", "floor PGV"),
)  # fmt: skip
BETA = 0.5  # of all of FEMA P-58's
LEVEL = 0.4  # m/s


def counted(folder: Path) -> None:
    """FEMA P-58's rows for contents."""
    rows = pd.read_csv(folder / "fragility.csv", index_col="ID")
    contents = rows[rows.index.str.startswith("E.20.22")]
    known = contents["LS1-Theta_0"].notna()
    velocity = contents["Demand-Type"].eq("Peak Floor Velocity")
    print(f"{len(rows)} rows, {len(contents)} of them for contents (E.20.22); "
          f"{int((known & velocity).sum())} with a median over the peak floor velocity, "
          f"{int((known & ~velocity).sum())} over the peak floor acceleration, "
          f"{int((~known).sum())} without numbers\n")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dlml", type=Path)
    given = parser.parse_args()
    if given.dlml:
        counted(given.dlml)
    table = read_library_table(TABLE)
    head = " | ".join(f"{place}, {held}: {measure}" for place, held, measure in WHERE)
    print(f"| thing | P-58: θ [m/s] | {head} |\n|---|---:|{'---|' * len(WHERE)}")
    ratios: dict[tuple[str, str, str], list[float]] = {each: [] for each in WHERE}
    betas: list[float] = []
    for published, thing in zip(OBJECTS, THINGS, strict=True):
        cells = []
        for place, held, measure in WHERE:
            rows = found_rows(table, measure=measure, place=place, held=held)
            (row,) = rows[rows["thing"] == thing].itertuples()
            if row.problem:
                cells.append("none")
                continue
            cells.append(f"{row.median:.2f} ({row.median_low:.2f} to {row.median_high:.2f}), "
                         f"β {row.beta:.2f}")  # fmt: skip
            ratios[place, held, measure].append(row.median / published.median)
            betas.append(row.beta)
        print(f"| {thing} | {published.median:.2f} | {' | '.join(cells)} |")
    for key, each in ratios.items():
        print(f"{', '.join(key)}: θ is {min(each):.2f} to {max(each):.2f} times that of P-58, "
              f"{np.exp(np.log(each).mean()):.2f} in the mean")  # fmt: skip
    one = found_rows(table, words="bookcase 5", measure="PGV", place="ground", held="free").iloc[0]
    theirs = next(each.median for each in OBJECTS if each.name == "bookcase, 5 shelves")
    chances = [
        float(probability(np.array(LEVEL), np.array(median), np.array(beta)))
        for median, beta in ((theirs, BETA), (one["median"], one["beta"]))
    ]
    print(f"at a PGV of {LEVEL:g} m/s the bookcase with 5 shelves falls with a probability of "
          f"{chances[0]:.2f} by P-58, and of {chances[1]:.2f} by ours")  # fmt: skip
    print(f"β of ours {min(betas):.2f} to {max(betas):.2f}, of P-58 {BETA:g}")


if __name__ == "__main__":
    main()
