"""
A hospital's objects, floor by floor
====================================

Three objects on every floor of a building of three storeys, in one plane: the share of 44
shakings (22 recordings, both polarities) that overturn each of them.
"""

from dataclasses import replace

import matplotlib.pyplot as plt

from shaketable import Body, Item, ShearBuilding, assess, floor_motions, suite
from shaketable.building import Building

things = [
    Item(body=Body.rectangle(0.32, 1.80, name="bookcase"), height=1.80),
    Item(body=Body.rectangle(0.45, 1.30, name="cabinet"), height=1.30),
    Item(body=Body.rectangle(0.60, 1.60, name="analyser"), height=1.60),
]
shear = ShearBuilding(storeys=3, first_period=0.35)
motions = suite("fema-p695-far-field")[::2]
floors = [[motion, *floor_motions(shear, motion)] for motion in motions]
building = Building(
    name="three storeys, 0.35 s",
    floors={str(k): [each[k] for each in floors] for k in range(shear.storeys + 1)},
    told="",
)
placed = [replace(thing, floor=floor) for floor in building.floors for thing in things]
found = assess(placed, building, planar=True, leading=0, progress=False)

figure, ax = plt.subplots()
for name, rows in found.table.groupby("name", sort=False):
    rows = rows.sort_values("floor")
    ax.plot(100 * rows.fall_share, range(len(rows)), "o-", label=name)
ax.set(xlabel="overturns [% of shakings]", ylabel="floor", xlim=(0, 100), yticks=range(4))
ax.legend()
