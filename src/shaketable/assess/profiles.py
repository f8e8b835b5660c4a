"""An object as the planar simulation sees it: front to back, and side to side."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from shaketable.body import Body
from shaketable.inventory import Item


class Direction(StrEnum):
    """The direction of the shaking, seen by somebody who looks at the object's front."""

    FRONT_TO_BACK = "front to back"  # -x is toward the front
    SIDE_TO_SIDE = "side to side"  # -x is to the left


@dataclass(frozen=True, kw_only=True)
class Profile:
    """One direction of an object.

    Attributes:
        item: the object.
        direction: of the shaking.
        body: what is simulated.
        tilt: β [rad] of what it stands on, in this direction.
        support_length: length of that in this direction [m], None if it is not known.
        alike: whether the other direction is the same body, and not simulated for itself.
    """

    item: Item
    direction: Direction
    body: Body
    tilt: float = 0.0
    support_length: float | None = None
    alike: bool = False

    @property
    def symmetric(self) -> bool:
        """Whether as many fall to both sides, as every motion counts as recorded and reversed."""
        return self.tilt == 0.0 and self.body.left == self.body.right


def profiles_of(item: Item, tilt: float) -> list[Profile]:
    """The directions of an item that are simulated.

    A support's tilt [rad] is front to back; what rolls is not put on a tilted support.
    """
    tilt = 0.0 if item.rolls else tilt
    alike = item.sideways == item.body and tilt == 0.0 and item.support_length is None
    profiles = [
        Profile(
            item=item,
            direction=Direction.FRONT_TO_BACK,
            body=item.body,
            tilt=tilt,
            support_length=item.support_length,
            alike=alike,
        )
    ]
    if item.sideways is not None and not alike:
        profiles.append(Profile(item=item, direction=Direction.SIDE_TO_SIDE, body=item.sideways))
    return profiles
