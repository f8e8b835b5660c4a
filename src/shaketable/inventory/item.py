"""One kind of object."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from shaketable.body import Body
from shaketable.language import tell
from shaketable.surroundings import Surroundings


class Castors(StrEnum):
    """What an object stands on, as far as it rolls."""

    NONE = "none"
    FREE = "free"
    LOCKED = "locked"
    SOME = "some"  # whether they are locked is not known
    UNKNOWN = "unknown"  # its name or note mentions castors, and the column castors is empty


class BaseShape(StrEnum):
    """What an object stands on, seen from above."""

    BOX = "box"  # a rectangle, its depth by its width
    CYLINDER = "cylinder"  # a circle
    FEET = "feet"  # four feet, in the corners of its depth by its width


class Assumed(NamedTuple):
    """A number of an object that nobody gave: of a range that is usual for such things.

    Attributes:
        what: depth, width, diameter, height, cg_height or mass.
        value: that is taken [m, kg].
        least, most: of the range.
    """

    what: str
    value: float
    least: float
    most: float


@dataclass(frozen=True, kw_only=True)
class Item:
    """One kind of object in an inventory.

    Attributes:
        body: the body that is simulated front to back; its -x side is the front.
        height: full height [m].
        sideways: the body that is simulated side to side, its -x side to the left of somebody who
            looks at the front; None where the width of the object is not known.
        depth_known: whether the base of `body` is known to be the depth; False where an inventory
            gives a width alone.
        support_length: length of the support on the middle of which it stands, front to back [m];
            None if it cannot walk off.
        shape: of its base; planar bodies do not know it.
        rolling_friction, contour_friction, drilling_friction: what its solid loses as it rolls and
            turns [m], as in `Solid`; planar bodies do not know them.
        facing: azimuth to which its front looks, clockwise from north [rad]; None if not known.
        surroundings: what its solid stands beside and what holds it, where it faces the front of
            its support: x goes from its front to its back, y to its left. Planar bodies are
            simulated without. None if nothing is given.
        castors: what it rolls on, if it does.
        mass: [kg], None if it is not known; forces, straps and pads need it, and nothing else.
        quantity: number of such objects.
        cost: of one of them if it is lost, in a currency of the list's own; None if not known.
        building: which it stands in, "" if none is given.
        site: longitude and latitude of the building [degrees], None if they are not given.
        floor: label of the floor of a building on which it stands, "" if none is given.
        location, note: free text; the location may be the name of a room.
        position: of the middle of its base in the plan of its room, x to the right and y up [m];
            None if it is not given.
        wall: number of the wall of its room's plan before which it stands, "" if none is given.
        critical: how much its function matters, 0 (not at all) to 5.
        blocks_exit: whether it blocks a way out when it falls.
        people_nearby: whether people stay where it would fall.
        must_not_fall: whether it must not fall at all, whichever way.
        anchored: whether it is fixed to the building; then it is listed and not simulated.
        hangs: whether its name, note or location says that it hangs or is fixed, and no column
            says it; then it is asked about and not simulated.
        stands_on: the furniture on which it stands, as its list says it; "" for the floor. It is
            simulated as if it stood on the floor, and gets no class.
        lock_known: whether it is known that its castors are locked, or free; if not, the worse of
            both was taken.
        may_be_round: whether its name is that of something round and its shape is not said: then
            nothing good is said of it, as what is round falls more often.
        row: where it stands in its inventory, as messages about the file count: a line or a row;
            0 where it was not read from one.
        unread: headers of columns that may say castors, anchors or a shape of it, and are not
            understood: nothing good is said of it before they are.
        assumed: numbers that were taken from the catalogue of common things.
        assumed_as: key of that thing in `catalogue()`, "" where nothing was taken.
    """

    body: Body
    height: float
    sideways: Body | None = None
    depth_known: bool = True
    support_length: float | None = None
    shape: BaseShape = BaseShape.BOX
    rolling_friction: float = 0.0
    contour_friction: float = 0.0
    drilling_friction: float = 0.0
    facing: float | None = None
    surroundings: Surroundings | None = None
    castors: Castors = Castors.NONE
    mass: float | None = None
    quantity: int = 1
    cost: float | None = None
    building: str = ""
    site: tuple[float, float] | None = None
    floor: str = ""
    location: str = ""
    position: tuple[float, float] | None = None
    wall: str = ""
    note: str = ""
    critical: int = 0
    blocks_exit: bool = False
    people_nearby: bool = False
    must_not_fall: bool = False
    anchored: bool = False
    hangs: bool = False
    stands_on: str = ""
    lock_known: bool = True
    may_be_round: bool = False
    row: int = 0
    unread: tuple[str, ...] = ()
    assumed: tuple[Assumed, ...] = ()
    assumed_as: str = ""

    @property
    def name(self) -> str:
        return self.body.name

    def called(self, number: int) -> str:
        """What it is called where names may be alike: "row 7: Bookcase", as its file counts.

        Args:
            number: to call it by if it was not read from a file.
        """
        if self.row:
            return tell("row {row}: {name}", row=self.row, name=self.name)
        return f"{number}: {self.name}"

    @property
    def rolls(self) -> bool:
        """Whether it is known to stand on castors, free, locked or either."""
        return self.castors in (Castors.FREE, Castors.LOCKED, Castors.SOME)

    @property
    def loose(self) -> bool:
        """Whether it can move: it is neither anchored nor hangs, as far as its list says."""
        return not (self.anchored or self.hangs)
