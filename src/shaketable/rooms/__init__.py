"""Rooms: what falls where, whom it hits, and whether the ways out stay free.

`room` is frozen data, `shapes` its polygons, `faults` what is wrong with a plan. `shaken` runs all
things under the same motions, `grounds` tells the cells that each covers then, and `judged` what
that means; `prepared` holds all of it, `found` tells it as `results`, of several `frictions` the
worst. `assessment` does this for a room, and `campaign.room_survey` for many, of which `survey`
tells; `changes` are what could be done, and `design` tries them. `once` is one shaking, to look at.
Everything in a plan is in metres, x to the right and y up; azimuths are the compass's, and
`plan_angle` alone converts them.
"""

from shaketable.rooms.assessment import assess_room
from shaketable.rooms.design import Harm, RoomDesign, Tried, design_room
from shaketable.rooms.faults import PlanFault, faults_of
from shaketable.rooms.once import RoomShaken, ThingShaken, shake_once
from shaketable.rooms.read import read_room
from shaketable.rooms.results import (
    PlaceResult,
    RoomAssessment,
    ThingResult,
    WayResult,
    WorstShaking,
)
from shaketable.rooms.room import Door, Hinge, Place, PlaceKind, Room, Swing, Thing
from shaketable.rooms.survey import RoomSurvey

__all__ = [
    "Door",
    "Harm",
    "Hinge",
    "Place",
    "PlaceKind",
    "PlaceResult",
    "PlanFault",
    "Room",
    "RoomAssessment",
    "RoomDesign",
    "RoomShaken",
    "RoomSurvey",
    "Swing",
    "Thing",
    "ThingResult",
    "ThingShaken",
    "Tried",
    "WayResult",
    "WorstShaking",
    "assess_room",
    "design_room",
    "faults_of",
    "read_room",
    "shake_once",
]
