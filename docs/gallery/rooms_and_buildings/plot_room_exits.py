"""
Which ways out stay free
========================

A room with a desk, a door and two bookcases. All things in it are shaken together; the map shows
where something came down, and the table how often the way out was closed.
"""

import tempfile
from pathlib import Path

from shaketable import suite
from shaketable.plot.room import plot_room
from shaketable.rooms import assess_room, read_room

plan = Path(tempfile.mkdtemp()) / "office.toml"
plan.write_text(
    """
outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[door]]
at_m = [3.4, 0]
[[place]]
kind = "desk"
at_m = [1.2, 2.2]
size_m = [1.2, 0.7]
[[thing]]
name = "bookcase"
at_m = [0.25, 1.0]
facing_deg = 90
depth_m = 0.32
width_m = 0.8
height_m = 1.9
[[thing]]
name = "locker"
at_m = [2.6, 0.3]
facing_deg = 0
depth_m = 0.4
width_m = 0.6
height_m = 1.8
"""
)
found = assess_room(
    read_room(plan),
    suite("fema-p695-both-directions", pairs=True)[:16],
    frictions=(),
    progress=False,
)
for way in found.ways:
    closed = way.closed
    print(
        f"{way.place} to {way.exit}: closed in {closed.value:.0%} of {found.runs} shakings "
        f"({closed.low:.0%} to {closed.high:.0%}; {found.recordings} independent recordings)"
    )
plot_room(found.room, found)
