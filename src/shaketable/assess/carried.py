"""What furniture that rocks does to what stands on it, at each of its landings.

Furniture of half base b and restitution e that lands with the angular speed |ω| gives the top of it
the velocities |ω| (1 - e) z along and |ω| (1 + e) b upward (at its middle; z is the height of its
top). Of an object at rest there, of half base b_o and with its centre of gravity at h, the impulse
along is to that normal as P_x to P_y, P_x = (1 - e) (z + h), P_y = (1 + e) b: below a friction of
P_x / P_y it slides. It rocks where (1 - e) (i² + h (z + h)) > b_o P_y. Neither depends on |ω|
(theory, section 13).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from shaketable.body import Body
from shaketable.inventory import Item


class Kick(NamedTuple):
    """What the landings of a piece of furniture do to an object at rest on its top.

    Attributes:
        carrier: name of the furniture.
        friction: below which the object slides.
        slenderness: half base over height of the centre of gravity below which a homogeneous
            object of its height rocks; infinite where every one does.
        own: of the object, in the direction in which it is more slender.
    """

    carrier: str
    friction: float
    slenderness: float
    own: float

    @property
    def rocks(self) -> bool:
        """Whether the object rocks."""
        return self.own < self.slenderness


def kick_of(item: Item, carrier: Item) -> Kick:
    """The kick that an object gets on the middle of the top of its carrier.

    Args:
        item: the object.
        carrier: homogeneous furniture on the floor, which rocks over its shorter side.
    """
    base = min(_sides(carrier), key=lambda body: body.base)
    b, r2 = base.base / 2, base.gyration_radius**2 + base.cg_height**2
    e = (r2 - b * b) / (r2 + b * b)
    side = min(_sides(item), key=lambda body: min(body.left, body.right))
    h, along = side.cg_height, (1.0 - e) * (carrier.height + side.cg_height)
    normal = (1.0 + e) * b
    # (1 - e) [(b_o² + h²) / 3 + h (z + h)] = b_o P_y
    root = normal**2 - 4.0 * (1.0 - e) / 3.0 * ((1.0 - e) * h * h / 3.0 + h * along)
    least = (normal - math.sqrt(root)) * 1.5 / (1.0 - e) if root > 0.0 else math.inf
    return Kick(carrier.name, along / normal, least / h, min(side.left, side.right) / h)


def kick_among(item: Item, items: Sequence[Item]) -> Kick | None:
    """What the furniture does to an item on which it stands, where that is in a list."""
    carrier = carrier_of(item, items) if item.stands_on else None
    return kick_of(item, carrier) if carrier else None


def carrier_of(item: Item, items: Sequence[Item]) -> Item | None:
    """The one item of a list whose name says on what an object stands; None if none or several do.

    It must stand on the floor itself, and not roll away.
    """
    said = item.stands_on.casefold()
    found = [
        each
        for each in items
        if each is not item
        and not each.stands_on
        and each.loose
        and not each.rolls
        and each.name.casefold() in said
    ]
    longest = max((len(each.name) for each in found), default=0)
    named = {each.name: each for each in found if len(each.name) == longest}
    return next(iter(named.values())) if len(named) == 1 else None


def _sides(item: Item) -> list[Body]:
    """Its bodies front to back, and side to side where that is known."""
    return [item.body, *([item.sideways] if item.sideways else [])]
