"""The motion: ground acceleration under the support."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError, require_number, require_positive
from shaketable.origin import Origin
from shaketable.units import STANDARD_GRAVITY


def _samples(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """A read-only copy of a finite one-dimensional series."""
    try:
        series: NDArray[np.float64] = np.array(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"Motion.{name} must be a series of numbers: {error}") from None
    if series.ndim != 1 or series.size < 2:
        raise InputError(
            f"Motion.{name} must be one series of at least 2 samples, got shape {series.shape}"
        )
    bad = np.flatnonzero(~np.isfinite(series))
    if bad.size:
        raise InputError(
            f"Motion.{name} must be finite: sample {bad[0]} is {series[bad[0]]}"
            + (f", {bad.size} samples in all" if bad.size > 1 else "")
        )
    series.flags.writeable = False
    return series


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """Ground acceleration in the level frame, linear between samples.

    Args:
        horizontal: a_x [m/s²], shape (n,), n >= 2; positive toward +x.
        time_step: [s].
        vertical: a_y [m/s²], shape (n,), up positive; None means zero.
        name: what to call it in tables and messages.
        origin, vertical_origin: where the components come from, None if that is not known.

    Raises:
        InputError: series that are not finite, one-dimensional and of equal length, or a time
            step that is not positive.
    """

    horizontal: NDArray[np.float64]
    time_step: float
    _: KW_ONLY
    vertical: NDArray[np.float64] | None = None
    name: str = ""
    origin: Origin | None = None
    vertical_origin: Origin | None = None

    def __post_init__(self) -> None:
        require_positive("Motion.time_step [s]", self.time_step)
        object.__setattr__(self, "horizontal", _samples("horizontal", self.horizontal))
        if self.vertical is not None:
            vertical = _samples("vertical", self.vertical)
            if vertical.size != self.horizontal.size:
                raise InputError(
                    f"Motion.vertical has {vertical.size} samples and Motion.horizontal "
                    f"{self.horizontal.size}; they must be equal"
                )
            object.__setattr__(self, "vertical", vertical)

    @property
    def time(self) -> NDArray[np.float64]:
        """Time of each sample [s], shape (n,)."""
        return np.arange(self.horizontal.size, dtype=np.float64) * self.time_step

    @property
    def duration(self) -> float:
        """[s]"""
        return (self.horizontal.size - 1) * self.time_step

    @property
    def peak_ground_acceleration(self) -> float:
        """Largest |a_x| [m/s²]."""
        return float(np.abs(self.horizontal).max())

    def scaled(self, factor: float) -> Motion:
        """Both components times `factor` >= 0."""
        require_number("a scale factor", factor)
        if not (np.isfinite(factor) and factor >= 0.0):
            raise InputError(f"a scale factor must be finite and not negative, got {factor!r}")
        vertical = None if self.vertical is None else self.vertical * factor
        said = f"scaled by {factor:g}"
        return self.after(said, horizontal=self.horizontal * factor, vertical=vertical)

    def reversed(self) -> Motion:
        """The same motion with its horizontal component's sign changed (polarity -1)."""
        origin = (self.origin or Origin()).after("reversed")
        return replace(self, horizontal=-self.horizontal, origin=origin)

    def after(
        self, said: str, *, horizontal: NDArray[np.float64], vertical: NDArray[np.float64] | None
    ) -> Motion:
        """The motion after a step of processing of both components, which `said` puts in words."""
        above = None if vertical is None else (self.vertical_origin or Origin()).after(said)
        return replace(
            self,
            horizontal=horizontal,
            vertical=vertical,
            origin=(self.origin or Origin()).after(said),
            vertical_origin=above,
        )

    def _repr_html_(self) -> str:
        """For notebooks: the traces under one line of words."""
        from shaketable.drawing.files import as_html
        from shaketable.drawing.trace import plot_trace

        return as_html(plot_trace(self), repr(self))

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        vertical = "" if self.vertical is None else ", with vertical"
        return (
            f"Motion({name}{self.horizontal.size} samples of {self.time_step:.4g} s, "
            f"peak {self.peak_ground_acceleration / STANDARD_GRAVITY:.3g} g{vertical})"
        )
