"""Buildings: what shakes their floors, recorded or computed from what shakes the ground."""

from shaketable.building.building import Building
from shaketable.building.read import (
    Overview,
    building_of_structure,
    overview,
    read_building,
)

__all__ = ["Building", "Overview", "building_of_structure", "overview", "read_building"]
