"""One kind of object."""

from __future__ import annotations

from dataclasses import dataclass, replace

from shaketable.body import Body


@dataclass(frozen=True, kw_only=True)
class Item:
    """One kind of object in an inventory.

    Attributes:
        body: the body that is simulated for it.
        height: full height [m].
        direction: in which the body is simulated: "front to back" or "side to side", "" where the
            inventory does not tell.
        support_length: length of the support on the middle of which it stands, in the direction of
            the shaking [m]; None if it cannot walk off.
        quantity: number of such objects.
        floor: label of the floor of a building on which it stands, "" if none is given.
        location, note: free text.
    """

    body: Body
    height: float
    direction: str = ""
    support_length: float | None = None
    quantity: int = 1
    floor: str = ""
    location: str = ""
    note: str = ""

    @property
    def name(self) -> str:
        return self.body.name

    def with_base(self, width: float) -> Body:
        """The same object on a base of another width [m].

        It stands for feet or a plate under it: the centre of gravity keeps its height and its
        place between the corners, and the radius of gyration stays the same.
        """
        return replace(self.body, width=width, left=self.body.left / self.body.width * width)
