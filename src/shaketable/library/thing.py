"""The things of a library: kinds of the catalogue of common things, each in a stated size."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from shaketable.errors import InputError, named, quoted, require_positive
from shaketable.inventory.catalogue import CommonThing, Range, catalogue
from shaketable.inventory.item import BaseShape


class Size(StrEnum):
    """Which of the usual sizes of its kind a thing has."""

    SLENDER = "slender"  # the smallest base and the largest height
    MIDDLE = "middle"  # the middle of each range
    STOUT = "stout"  # the largest base and the smallest height


@dataclass(frozen=True, kw_only=True)
class LibraryThing:
    """A kind of the catalogue in one size.

    Args:
        kind: its key in `catalogue()`.
        size: which of the sizes that are usual for its kind.
        scale: factor on all lengths, for the same shape in another size.
        lengths: depth, width and height [m] of its own, in place of those of its size.
        label: what it is then called, after its kind.

    Raises:
        InputError: a kind that the catalogue has not got, lengths without a label, or one that is
            not positive.
    """

    kind: str
    size: Size = Size.MIDDLE
    scale: float = 1.0
    lengths: tuple[float, float, float] | None = None
    label: str = ""

    def __post_init__(self) -> None:
        for length in self.lengths or ():
            require_positive("a length of a thing [m]", length)
        if bool(self.lengths) != bool(self.label):
            raise InputError(f"{self.kind}: give lengths and a label, or neither")
        require_positive("the scale of a thing", self.scale)
        if self.kind not in catalogue():
            near = [key for key in catalogue() if self.kind.split(" ")[0] in key]
            raise InputError(
                f"the catalogue has no {quoted(self.kind)}; near it are "
                f"{named(near or list(catalogue()), 5)}"
            )

    @property
    def name(self) -> str:
        """Such as "bookcase slender", or "bookcase middle x0.7" where it is scaled."""
        scaled = "" if self.scale == 1.0 else f" x{self.scale:g}"
        return f"{self.kind} {self.label or self.size}{scaled}"

    @property
    def common(self) -> CommonThing:
        """Its kind."""
        return catalogue()[self.kind]

    @property
    def rolls(self) -> bool:
        """Whether it stands on castors that are free."""
        return self.common.castors == "free"

    @property
    def on_feet(self) -> bool:
        """Whether it stands on four feet or castors in the corners of its base."""
        return bool(self.common.castors) or self.common.shape is BaseShape.FEET

    @property
    def round(self) -> bool:
        """Whether it is a cylinder."""
        return self.common.shape is BaseShape.CYLINDER and not self.on_feet

    @property
    def depth(self) -> float:
        """From its front to its back [m]; the diameter of a cylinder."""
        return self.scale * self._of(self.common.depth, 0, base=True)

    @property
    def width(self) -> float:
        """From side to side [m]; the diameter of a cylinder."""
        return self.depth if self.round else self.scale * self._of(self.common.width, 1, base=True)

    @property
    def height(self) -> float:
        """[m]."""
        return self.scale * self._of(self.common.height, 2, base=False)

    @property
    def mass(self) -> float:
        """The middle of what is usual for its kind [kg]; nothing in a library depends on it."""
        return (self.common.mass.least + self.common.mass.most) / 2

    def _of(self, usual: Range, number: int, *, base: bool) -> float:
        if self.lengths is not None:
            return self.lengths[number]
        if self.size is Size.MIDDLE:
            return (usual.least + usual.most) / 2
        return usual.least if (self.size is Size.SLENDER) == base else usual.most
