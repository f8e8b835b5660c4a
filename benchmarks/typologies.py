"""`python -m benchmarks.typologies`: unanchored bookcases and files beside FEMA P-58's functions.

Sizes and medians are those of FEMA P-58, 2nd edition, fragilities E.20.22.102a to 125a, as the
Damage and Loss Model Library of SimCenter holds them: peak floor velocity, β 0.5 for all, "a
function of the aspect ratio and the building period". Ours are of one horizontal direction of the
ground; a second table shows what other demands change of one of them.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable import Body, Motion, ShearBuilding, floor_motions, fragility, suite

INCH = 0.0254  # m


class Published(NamedTuple):
    """A function of FEMA P-58."""

    name: str
    depth: float  # in
    height: float  # in
    median: float  # m/s


OBJECTS = (
    Published("bookcase, 2 shelves", 12.625, 29.0, 0.724),
    Published("bookcase, 3 shelves", 12.625, 41.0, 0.493),
    Published("bookcase, 4 shelves", 12.625, 56.0, 0.361),
    Published("bookcase, 5 shelves", 12.625, 71.0, 0.290),
    Published("bookcase, 6 shelves", 12.625, 81.25, 0.251),
    Published("vertical file, 2 drawers", 15.0, 24.0, 1.229),
    Published("vertical file, 4 drawers", 15.0, 52.0, 0.498),
    Published("lateral file, 4 drawers", 18.6, 52.5, 0.688),
    Published("lateral file, 5 drawers", 18.6, 67.75, 0.526),
)


def kaneko_hayashi(depth: float, height: float) -> float:
    """Their peak velocity of 50 % overturning [m/s], from lengths [m]; a formula in cm and s."""
    b, h = 100.0 * depth, 100.0 * height
    return 0.1 * b / math.sqrt(h) * (1.0 + b / h) ** 2.5


#: A wood-frame house, an office, a tower: storeys and first period [s].
BUILDINGS = ((2, 0.2), (6, 0.65), (12, 1.5))


def other_demands(motions: list[Motion]) -> None:
    """One bookcase under motions of floors, and with intensities of two directions."""
    one = OBJECTS[3]
    body = Body.rectangle(INCH * one.depth, INCH * one.height)
    rows = [
        ("ground, its own direction", fragility(body, motions)),
        (
            "ground, geometric mean of both directions",
            fragility(body, motions, components="geometric mean"),
        ),
    ]
    for storeys, period in BUILDINGS:
        building = ShearBuilding(storeys=storeys, first_period=period)
        roofs = [floor_motions(building, motion)[-1] for motion in motions]
        rows.append((f"roof, {storeys} storeys, first period {period} s", fragility(body, roofs)))
    print(f"\n| PGV of the {one.name} | θ, 95 % [m/s] | β | over P-58 |\n|---|---:|---:|---:|")
    for name, found in rows:
        low, high = found.curve.median_interval
        print(f"| {name} | {found.curve.median:.2f} ({low:.2f}–{high:.2f}) | "
              f"{found.curve.beta:.2f} | {found.curve.median / one.median:.2f} |")  # fmt: skip


def main() -> None:
    motions = suite("fema-p695-far-field")
    bodies = [Body.rectangle(INCH * one.depth, INCH * one.height) for one in OBJECTS]
    found = fragility(bodies, motions)
    print("| object | depth × height [m] | P-58: θ [m/s] | Kaneko-Hayashi | simulated: θ, 95 % | "
          "β | simulated over P-58 |\n|---|---|---:|---:|---:|---:|---:|")  # fmt: skip
    for one, curve in zip(OBJECTS, found.curves, strict=True):
        low, high = curve.median_interval
        depth, height = INCH * one.depth, INCH * one.height
        print(f"| {one.name} | {depth:.2f} × {height:.2f} | {one.median:.2f} | "
              f"{kaneko_hayashi(depth, height):.2f} | {curve.median:.2f} ({low:.2f}–{high:.2f}) | "
              f"{curve.beta:.2f} | {curve.median / one.median:.2f} |")  # fmt: skip
    other_demands(motions)


if __name__ == "__main__":
    main()
