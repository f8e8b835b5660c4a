"""How an object stands, and the ways in which it is turned to the motions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.solid import Solid
from shaketable.surroundings import Surroundings
from shaketable.tilting import TURNS

Ways = NDArray[np.float64]  # turns [rad], (motion, polarity, turn)


def turns_of(solid: Solid, symmetric: bool) -> NDArray[np.float64]:
    """The ways in which an object is turned to a motion [rad], where it is not known which is so.

    TURNS angles over half a turn, without those that would repeat another. Half a turn of an object
    and its support is the reversed motion, which is simulated as well. Where nothing but its base
    tells one side of it from another a square looks the same after a quarter of a turn, and a
    circle always.

    Args:
        solid: any.
        symmetric: whether it stands alone on a level support.
    """
    if symmetric and solid.round:
        return np.zeros(1)
    span = math.pi / 2 if symmetric and solid.square else math.pi
    return np.arange(TURNS) * span / TURNS


class Stood(NamedTuple):
    """An object on what it stands on.

    Attributes:
        item: the object.
        solid: what is simulated.
        tilt: of its support [rad], toward its front; negative toward its back.
        aside: the same toward its left, for a small tilt.
        around: what surrounds it, as it faces the front of its support.
        friction: of its feet, static and kinetic; that of the model if None.
        turned: by how much it is turned from where its list says that it faces [rad].
    """

    item: Item
    solid: Solid
    tilt: float = 0.0
    aside: float = 0.0
    around: Surroundings | None = None
    friction: float | None = None
    turned: float = 0.0

    @property
    def symmetric(self) -> bool:
        """Whether nothing but its base tells one side of it from another."""
        return self.tilt == self.aside == 0.0 and not self.around

    def turns(self, motions: Sequence[Motion]) -> NDArray[np.float64]:
        """Angles from each motion's horizontal component to its depth [rad], (motion, turn).

        One angle, if the azimuths of its front and of the motions are known; otherwise those of
        `turns_of`.
        """
        item = self.item
        azimuths = [motion.origin.azimuth if motion.origin else None for motion in motions]
        if item.facing is not None and None not in azimuths:
            # compass azimuths go clockwise; its x goes from the front to the back
            along = np.radians(np.array(azimuths, np.float64))
            turn = along - item.facing - self.turned - math.pi
            return np.remainder(turn, 2 * math.pi)[:, None]
        return np.tile(turns_of(self.solid, self.symmetric), (len(motions), 1))

    @property
    def polarities(self) -> tuple[float, ...]:
        """Of the motions: reversed, one does the same to a circle alone on a level support."""
        same = self.symmetric and self.solid.round
        return (1.0,) if same else (1.0, -1.0)

    def ways(self, motions: Sequence[Motion]) -> Ways:
        """All turns with which it meets each motion in each polarity."""
        turns = self.turns(motions)[:, None, :]
        return np.repeat(turns, len(self.polarities), axis=1)


def halves(ways: Ways) -> list[Ways]:
    """Every other turn, and the rest, if there is any."""
    return [ways] if ways.shape[2] % 2 else [ways[:, :, ::2], ways[:, :, 1::2]]


def in_turn(ways: Ways) -> list[Ways]:
    """One turn for each motion, another for the next; the turns after these; and so on for all.

    Each of them has every motion in all its polarities.
    """
    motions, _, turns = ways.shape
    number = np.arange(motions)
    return [ways[number, :, (number + k) % turns][:, :, None] for k in range(turns)]


def one_of_each(ways: Ways) -> Ways:
    """One way for each motion, another for the next; the interval of a share asks for no more runs.

    All are of the first polarity: half a turn more stands for the other.
    """
    motions, polarities, turns = ways.shape
    number = np.arange(motions)
    reversed_too = (number // turns) % polarities
    turned: Ways = ways[number, 0, number % turns] + math.pi * reversed_too
    return turned[:, None, None]
