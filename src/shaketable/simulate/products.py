"""What full products have in common, of planar bodies or of solids, and how one is chosen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, Protocol, Self, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import numbers
from shaketable.simulate.product import DOWNHILL, Falls, Product
from shaketable.simulate.solid_product import SolidProduct
from shaketable.solid import Solid

if TYPE_CHECKING:
    import xarray as xr


class AnyProduct(Protocol):
    """A `Product` or a `SolidProduct`."""

    @property
    def dimensions(self) -> tuple[str, ...]: ...
    @property
    def bodies(self) -> Sequence[Any]: ...
    @property
    def motions(self) -> Sequence[Motion]: ...
    @property
    def tilts(self) -> NDArray[np.float64]: ...
    @property
    def scales(self) -> NDArray[np.float64]: ...
    @property
    def polarities(self) -> NDArray[np.float64]: ...
    @property
    def model(self) -> Model: ...
    @property
    def shape(self) -> Any: ...
    @property
    def repeats(self) -> int: ...
    def require_device(self, device: str) -> None: ...
    def require_standing(self) -> None: ...
    def some(self, bodies: Sequence[int], motions: Sequence[int]) -> Self: ...
    def run(
        self,
        keep: Callable[[Any], None],
        threads: int | None,
        progress: Progress,
        device: str = ...,
    ) -> Counter[float]: ...
    def warn_of(self, endings: Counter[float]) -> None: ...
    def members(self) -> Any: ...
    def dataset(self, members: Any) -> xr.Dataset: ...
    def coordinates(self) -> dict[str, Any]: ...
    def falls_of(self, part: Any) -> Falls: ...


def product_of(
    bodies: Sequence[Body] | Sequence[Solid],
    motions: Iterable[Motion],
    *,
    tilts: ArrayLike,
    scales: ArrayLike,
    polarities: ArrayLike,
    azimuth: float,
    orientations: ArrayLike,
    model: Model | str | None,
) -> AnyProduct:
    """What a user asks for, as for `simulate_many`; whether bodies stand is not looked at.

    Raises:
        InputError: what `simulate_many` says, but for a body that falls by itself.
    """
    if are_solids(bodies):
        return SolidProduct.of(
            cast("Sequence[Solid]", bodies),
            motions,
            tilts=tilts,
            azimuth=azimuth,
            scales=scales,
            polarities=polarities,
            orientations=orientations,
            model=model,
        )
    require_plane(azimuth, orientations)
    return Product.of(cast("Sequence[Body]", bodies), motions, tilts, scales, polarities, model)


def are_solids(bodies: object) -> bool:
    """Whether one of them is a Solid; then all of them have to be."""
    return isinstance(bodies, Sequence) and any(isinstance(body, Solid) for body in bodies)


def require_plane(azimuth: ArrayLike, orientations: ArrayLike) -> None:
    """InputError unless planar bodies are asked for in their plane."""
    if np.any(numbers("azimuth", azimuth) != DOWNHILL):
        raise InputError(
            f"azimuth= is of Solids; planar bodies fall toward -x, azimuth π, got {azimuth!r}: "
            "give a negative tilt for +x"
        )
    if np.any(numbers("orientations", orientations)):
        raise InputError("orientations= is of Solids; planar bodies have one plane")
