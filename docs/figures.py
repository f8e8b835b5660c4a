"""Draws the README's pictures: python docs/figures.py (from the root of the checkout)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shaketable import Body, Support, simulate, suite
from shaketable.assess import assess
from shaketable.inventory import read_inventory
from shaketable.report.figures import fall_shares

DOCS = Path(__file__).parent


def main() -> None:
    motions = suite("fema-p695-far-field")
    shelf = Body.rectangle(0.32, 1.80, name="Bookcase 1.80 m")
    run = simulate(shelf, motions[0], Support(tilt=np.radians(3)))
    figure = run.plot()[0].get_figure(root=True)
    figure.savefig(DOCS / "bookcase.png", dpi=110)
    items = read_inventory(DOCS.parent / "examples" / "hospital.csv")
    shares = fall_shares(assess(items, motions)).get_figure(root=True)
    shares.savefig(DOCS / "shares.png", dpi=100)


if __name__ == "__main__":
    main()
