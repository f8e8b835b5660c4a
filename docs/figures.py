"""Draws the README's pictures: python docs/figures.py (from the root of the checkout)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from shaketable.report.studies import boroschek_iruretagoyena_2006 as tilted
from shaketable.report.studies import boroschek_romo_2004 as off_centre
from shaketable.report.studies import cimellaro_2020 as floors_view

from shaketable import Body, General, Motion, ShearBuilding, Support, floor_motions, simulate, suite
from shaketable.assess import assess, assess_floors
from shaketable.building import Building
from shaketable.inventory import read_inventory
from shaketable.modes import map_modes
from shaketable.plot import plot_modes, plot_tilt
from shaketable.report.building import building_picture
from shaketable.report.figures import fall_shares
from shaketable.studies import boroschek_iruretagoyena_2006, boroschek_romo_2004, cimellaro_2020
from shaketable.tilting import design_tilt

DOCS = Path(__file__).parent


def floors_of(building: ShearBuilding, motions: list[Motion]) -> dict[str, list[Motion]]:
    """The motions of every floor, from the ground up."""
    floors = [[motion, *floor_motions(building, motion)] for motion in motions]
    return {str(k): [each[k] for each in floors] for k in range(building.storeys + 1)}


def main() -> None:
    motions = suite("fema-p695-far-field")
    shelf = Body.rectangle(0.32, 1.80, name="Bookcase 1.80 m")
    rocked = simulate(shelf, motions[0], Support(tilt=np.radians(3)))
    figure = rocked.plot()[0].get_figure(root=True)
    figure.savefig(DOCS / "bookcase.png", dpi=110)
    # the other component of the record, weaker, stands in for a vertical one
    cart = Body.rectangle(0.38, 0.90, name="Cart 0.90 m")
    shaken = Motion(
        2.1 * motions[0].horizontal,
        motions[0].time_step,
        vertical=1.26 * motions[1].horizontal,
        name=f"2.1 × {motions[0].name}",
    )
    slippery = General(static_friction=0.45, kinetic_friction=0.405, normal_restitution=0.1)
    slid = simulate(cart, shaken, model=slippery)
    above, below = slid.plot()
    below.set_xlim(0.0, 15.0)
    above.get_figure(root=True).savefig(DOCS / "cart.png", dpi=110)
    modes = map_modes(cart, 1, friction=0.45, kinetic_ratio=0.9)
    plot_modes(modes, 0.45).get_figure(root=True).savefig(DOCS / "modes.png", dpi=100)
    items = read_inventory(DOCS.parent / "examples" / "hospital.csv")
    shares = fall_shares(assess(items, motions)).get_figure(root=True)
    shares.savefig(DOCS / "shares.png", dpi=100)
    above, _ = plot_tilt(design_tilt(shelf, motions))
    above.get_figure(root=True).savefig(DOCS / "tilt.png", dpi=90)
    house = Building(
        name="Office of six storeys, 0.65 s, under 0.6 times FEMA P-695's far-field motions",
        floors=floors_of(ShearBuilding(storeys=6, first_period=0.65), motions),
        told="",
    )
    placed = [replace(item, floor=label) for label in house.floors for item in items]
    parts = assess_floors(placed, house, scale=0.6)
    building_picture(house.name, list(house.floors), parts).savefig(DOCS / "building.png", dpi=90)
    every = suite("fema-p695")
    for study, view, pictures in (
        (boroschek_iruretagoyena_2006, tilted, {"figure_07": "control", "figure_10": "sizes"}),
        (boroschek_romo_2004, off_centre, {"figure_05": "romo", "roc": "roc"}),
    ):
        drawn = dict(view.figures(study.run(every, description="FEMA P-695")))
        for name, picture in pictures.items():
            drawn[name].savefig(DOCS / f"{picture}.png", dpi=90)
    floors = cimellaro_2020.run(cimellaro_2020.stand_ins(), n=50)
    drawn = dict(floors_view.figures(floors))
    drawn["figure_06"].savefig(DOCS / "risk.png", dpi=80)
    drawn["calibration"].savefig(DOCS / "surfaces.png", dpi=80)


if __name__ == "__main__":
    main()
