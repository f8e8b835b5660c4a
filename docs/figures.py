"""Draws the pictures of the documentation, from the root of the checkout.

python docs/figures.py            all of them
python docs/figures.py theory     those of a name: theory, runs, main_job, building, studies, falls,
                                  earthquakes
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import theory_figure
from assessment_figures import building_picture, fall_shares
from matplotlib.axes import Axes

from shaketable import (
    Body,
    General,
    Motion,
    ShearBuilding,
    Support,
    assess,
    floor_motions,
    fragility,
    ida,
    overturning_spectrum,
    read_inventory,
    simulate,
    suite,
)
from shaketable.assess.earthquake import compared
from shaketable.building import Building
from shaketable.fragility import borders, vector_fragility
from shaketable.hazard import (
    artificial_motions,
    ln_spectra_of,
    read_shakemap,
    scenario,
    target_of,
)
from shaketable.hazard.earthquake import object_chances, shaken_places
from shaketable.hazard.functions import house_files
from shaketable.modes import map_modes
from shaketable.plot import (
    plot_capacities,
    plot_map,
    plot_modes,
    plot_overturning_spectrum,
    plot_target,
    plot_tilt,
    plot_two_measures,
)
from shaketable.signal import measure_named
from shaketable.study import StudyInput, installed_studies
from shaketable.tilting import design_tilt
from shaketable_studies.boroschek_iruretagoyena_2006.printed import TABLE_1

DOCS = Path(__file__).parent
PICTURES = DOCS / "pictures"
SUITE = "fema-p695-far-field"
SHELF = Body.rectangle(0.32, 1.80, name="Bookcase 1.80 m")


def save(ax: Axes, name: str, dpi: int) -> None:
    ax.get_figure(root=True).savefig(PICTURES / f"{name}.png", dpi=dpi)


def theory() -> None:
    theory_figure.draw().savefig(PICTURES / "theory.png", dpi=110)


def runs() -> None:
    """A film of one run, a run of the general model, the map of modes, and the tilt of a shelf."""
    motions = suite(SUITE)
    simulate(SHELF, motions[0], Support(tilt=np.radians(3))).animate(PICTURES / "bookcase.gif")
    # the other component of the record, weaker, stands in for a vertical one
    cart = Body.rectangle(0.38, 0.90, name="Cart 0.90 m")
    shaken = Motion(
        2.1 * motions[0].horizontal,
        motions[0].time_step,
        vertical=1.26 * motions[1].horizontal,
        name=f"2.1 × {motions[0].name}",
    )
    slippery = General(static_friction=0.45, kinetic_friction=0.405, normal_restitution=0.1)
    above, below = simulate(cart, shaken, model=slippery).plot()
    below.set_xlim(0.0, 15.0)
    save(above, "cart", 110)
    save(plot_modes(map_modes(cart, 1, friction=0.45, kinetic_ratio=0.9), 0.45), "modes", 100)
    save(plot_tilt(design_tilt(SHELF, motions))[0], "tilt", 90)


def main_job() -> None:
    items = read_inventory(DOCS.parent / "examples" / "hospital.csv")
    save(fall_shares(assess(items, suite(SUITE)).ranked()), "shares", 100)


def building() -> None:
    """The example inventory on every floor of an office."""
    items = read_inventory(DOCS.parent / "examples" / "hospital.csv")
    shear = ShearBuilding(storeys=6, first_period=0.65)
    floors = [[motion, *floor_motions(shear, motion)] for motion in suite(SUITE)]
    house = Building(
        name="Office of six storeys, 0.65 s, under 0.6 times FEMA P-695's far-field motions",
        floors={str(k): [each[k] for each in floors] for k in range(shear.storeys + 1)},
        told="",
    )
    placed = [replace(item, floor=label) for label in house.floors for item in items]
    found = assess(placed, house, scale=0.6)
    picture = building_picture(house.name, list(house.floors), found)
    picture.savefig(PICTURES / "building.png", dpi=90)


def studies() -> None:
    every = suite("fema-p695")
    for name, pictures, dpi in (
        (
            "boroschek-iruretagoyena-2006",
            {"figure_07": "control", "figure_10": "sizes", "open_questions": "open"},
            90,
        ),
        (
            "shaketable-2026-solids",
            {
                "direction": "solids_direction",
                "shares": "solids_shares",
                "losses": "solids_losses",
            },
            90,
        ),
        ("boroschek-romo-2004", {"figure_05": "romo", "roc": "roc", "friction": "friction"}, 90),
        (
            "cimellaro-2020",
            {
                "figure_06": "risk",
                "calibration": "surfaces",
                "recovered": "recovered",
                "slide": "slide",
            },
            80,
        ),
    ):
        study = installed_studies()[name]
        options = {"n": 50} if name == "cimellaro-2020" else {}
        given = StudyInput(motions=every, description="FEMA P-695", options=options)
        drawn = dict(study.figures(study.do(given)))
        for figure, picture in pictures.items():
            drawn[figure].savefig(PICTURES / f"{picture}.png", dpi=dpi)


def falls() -> None:
    """A fragility function, two measures at once, capacities, and both spectra."""
    motions = suite(SUITE)
    found = fragility(SHELF, motions, limit_states=("uplift", "rocks 0.5 α", "overturns"))
    save(found.plot(), "fragility", 90)
    bodies = [Body.rectangle(size.base, size.height) for size in TABLE_1]
    save(plot_two_measures(vector_fragility(bodies, motions, draws=0)), "two_measures", 90)
    save(plot_capacities(ida(SHELF, motions), 100.0, "cm/s"), "capacities", 90)
    axis = np.linspace(0.05, 12.0, 240)
    spectrum = overturning_spectrum(SHELF, frequencies=axis, amplitudes=axis)
    save(plot_overturning_spectrum(spectrum, borders(SHELF, spectrum)), "spectrum", 90)


def earthquakes() -> None:
    """The spectra of an earthquake's motions, and the map of one of which the shaking is known."""
    quake = scenario(7.0, 20.0, 400.0)
    target = target_of(quake)
    motions = artificial_motions(quake, 128)
    save(plot_target(target, ln_spectra_of(motions, target.periods)), "scenario", 90)
    examples = DOCS.parent / "examples"
    items = read_inventory(examples / "campus.csv")
    shaken = read_shakemap(examples / "shakemap" / "grid.xml")
    places = shaken_places(items, shaken, "PGV")
    files = [examples / "campus-wards.toml", examples / "campus-surgery.toml"]
    houses = house_files(files, items)
    chances = object_chances(items, places, suite(SUITE), "PGV", houses=houses)
    found = compared(shaken.name, measure_named("PGV"), chances, places)
    save(plot_map(shaken, "PGV", found.place_table()), "map", 90)


if __name__ == "__main__":
    drawn = (theory, runs, main_job, building, studies, falls, earthquakes)
    parts = {part.__name__: part for part in drawn}
    for wanted in sys.argv[1:] or parts:
        parts[wanted]()
