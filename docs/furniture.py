"""Common furniture by the static criterion, and by simulation: the table of docs/how_to/rooms.md.

python docs/furniture.py

By the static criterion a thing falls once the peak acceleration, over g, passes the smaller side of
its base over its height. Both are told of the same recordings: those of the default suite, each
with its larger component for the criterion. What is simulated cannot slide.
"""

from __future__ import annotations

import numpy as np

from shaketable import Body, Item, assess, suite
from shaketable.assess.shares import Share, share_of
from shaketable.inventory import BaseShape
from shaketable.records import DEFAULT_SUITE
from shaketable.report.words.numbers import with_interval
from shaketable.units import STANDARD_GRAVITY

#: Depth, width and height [m]; of a round one its diameter and height. Assumed, of no source.
FURNITURE = {
    "bookcase": (0.32, 0.90, 1.80),
    "narrow bookcase": (0.30, 0.60, 2.00),
    "wardrobe": (0.58, 1.00, 2.36),
    "locker": (0.50, 0.60, 1.80),
    "filing cabinet": (0.62, 0.46, 1.32),
    "cupboard": (0.45, 1.00, 1.10),
    "refrigerator": (0.60, 0.60, 1.85),
    "server rack": (0.80, 0.60, 2.00),
    "showcase": (0.60, 0.60, 1.90),
    "gas cylinder": (0.23, 1.46),
}


def item_of(name: str, sizes: tuple[float, ...]) -> Item:
    """A homogeneous thing of some sizes."""
    depth, *width, height = sizes
    body = Body.rectangle(depth, height, name=name)
    across = Body.rectangle(width[0] if width else depth, height)
    shape = BaseShape.BOX if width else BaseShape.CYLINDER
    return Item(body=body, sideways=across, height=height, shape=shape)


def main() -> None:
    """Print the table."""
    motions = [each for each in suite(DEFAULT_SUITE, pairs=True) if each.transverse is not None]
    peaks = np.array(
        [max(np.abs(each.horizontal).max(), np.abs(each.transverse).max()) for each in motions]
    )  # type: ignore[arg-type]
    items = [item_of(name, sizes) for name, sizes in FURNITURE.items()]
    found = assess(items, leading=0, progress=False)
    print("| thing | base × height [m] | static limit [g] | falls by it, of 100 | falls, of 100 |")
    print("|---|---|---|---|---|")
    for result, (name, sizes) in zip(found.results, FURNITURE.items(), strict=True):
        *base, height = sizes
        limit = min(base) / height
        static: Share = share_of(peaks > limit * STANDARD_GRAVITY, len(motions))
        said = " × ".join(f"{each:.2f}" for each in base)
        print(
            f"| {name} | {said} × {height:.2f} | {limit:.2f} | {with_interval(static)} | "
            f"{with_interval(result.overturns)} |"
        )


if __name__ == "__main__":
    main()
