"""An empty inventory with examples and explanations, to be filled in."""

from __future__ import annotations

from shaketable.tables.template import Template

_EXPLAINED = {
    "name": "what it is; one row for each kind. Replace the rows that stand here as examples",
    "depth_m": "front to back, of the base on which it stands, in metres; call the column "
    "depth_cm, depth_mm or depth_in for other units, and any other length likewise",
    "width_m": "side to side, of the base on which it stands",
    "height_m": "full height",
    "shape": "of its base: box, cylinder (its depth is its diameter) or feet (four, in the corners "
    "of depth and width); box if empty",
    "cg_height_m": "height of its centre of gravity; half the height if left empty",
    "eccentricity": "distance of its centre of gravity from the front, as a share of the depth; "
    "0.5 if empty",
    "gyration_radius_m": "about its centre of gravity; that of a uniform body if empty",
    "support_length_m": "length, front to back, of the table on whose middle it stands",
    "rolling_friction_mm": "what it loses as it rolls, in three dimensions: a length that, times "
    "its weight, is the moment against rolling; none if empty",
    "contour_friction_mm": "of a cylinder: a length that, times its weight and the rate at which "
    "its contact goes around the rim, is the power lost; none if empty",
    "drilling_friction_mm": "a length that, times its weight, is the moment against turning on the "
    "spot beyond that of its feet; none if empty",
    "facing_deg": "compass azimuth to which its front looks, degrees from north; if empty, it is "
    "turned in several ways to the motions",
    "castors": "none, free or locked; none if empty",
    "wall_gap_mm": "distance to the wall behind it, in millimetres; empty if there is none near",
    "wall_side": "the side on which that wall is, and to which straps go: back, front, left or "
    "right; back if empty",
    "strap": "a strap from the middle of that side to the wall, as top:slack=5mm,stiffness=50kN/m; "
    "several with a semicolon between; it needs the mass",
    "strap_strength_n": "force at which each strap breaks, newtons; it is taken as unbreakable if "
    "empty",
    "pad": "force that pulls off one of its feet that are glued down, newtons; none if empty",
    "edge_mm": "distance from its front to the edge of the shelf or table on which it stands; "
    "empty on a floor",
    "lip_mm": "height of the lip at that edge",
    "mass_kg": "mass of one; straps, pads and forces in newtons need it, and nothing else",
    "quantity": "how many there are; 1 if empty",
    "building": "which building it stands in, where there are several; may be empty",
    "latitude": "of the building, decimal degrees, for maps of shaking; may be empty",
    "longitude": "likewise",
    "floor": "label of the floor, as in the building's file; may be empty",
    "location": "room or place; may be empty",
    "x_m": "middle of its base in the plan of that room, to the right, metres; for shaketable room",
    "y_m": "likewise, upward",
    "wall": "number of the wall of that plan before which it stands: its back comes there, beside "
    "x_m and y_m; may be empty",
    "critical": "how much its function matters: yes, no or 1 to 5",
    "blocks_exit": "yes if it blocks a way out when it falls",
    "people_nearby": "yes if people stay where it would fall",
    "must_not_fall": "yes if it must not fall at all, whichever way",
    "anchored": "yes if it is fixed to the building; it is then listed and not simulated",
    "note": "anything else; may be empty",
}
_EXAMPLES = (
    {"name": "Bookcase", "depth_m": 0.32, "width_m": 0.9, "height_m": 1.8, "quantity": 8,
     "location": "corridor", "blocks_exit": "yes", "people_nearby": "yes"},
    {"name": "Bench-top analyser", "depth_m": 0.6, "width_m": 0.8, "height_m": 0.5,
     "cg_height_m": 0.2, "mass_kg": 45, "quantity": 2, "location": "laboratory", "critical": 4,
     "note": "on rubber feet"},
    {"name": "Oxygen cylinder", "depth_m": 0.23, "height_m": 1.64, "shape": "cylinder",
     "mass_kg": 65, "quantity": 2, "location": "ward", "must_not_fall": "yes"},
    {"name": "Crash cart", "depth_m": 0.5, "width_m": 0.7, "height_m": 1.1, "castors": "locked",
     "quantity": 3, "location": "emergency room", "critical": "yes"},
)  # fmt: skip

INVENTORY = Template("Inventory", _EXPLAINED, _EXAMPLES)
