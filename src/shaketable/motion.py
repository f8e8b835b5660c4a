"""The motion: ground acceleration under the support."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError, keep_floats, require_number, require_positive
from shaketable.origin import Origin
from shaketable.units import STANDARD_GRAVITY


def _samples(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """A read-only copy of a finite one-dimensional series."""
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "biuf":  # text and complex numbers would be converted
            raise TypeError(f"{given.dtype} cannot be")
        series: NDArray[np.float64] = np.array(given, dtype=np.float64)
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


def _after(origin: Origin | None, said: str, series: NDArray[np.float64] | None) -> Origin | None:
    """The origin of a component after a step, None of one that is not there."""
    return None if series is None else (origin or Origin()).after(said)


def _turned(origin: Origin | None, said: str) -> Origin:
    """The origin of a component that is a mixture of two, and of neither azimuth any more."""
    return replace((origin or Origin()).after(said), azimuth=None)


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """Ground acceleration in the level frame, linear between samples.

    Args:
        horizontal: a_x [m/s²], shape (n,), n >= 2; positive toward +x.
        time_step: [s].
        vertical: a_y [m/s²], shape (n,), up positive; None means zero.
        transverse: the second horizontal component [m/s²], shape (n,), positive toward +y, which
            is to the left of +x seen from above; None means zero. What lives in one plane feels
            none of it.
        name: what to call it in tables and messages.
        origin, vertical_origin, transverse_origin: where the components come from, None if that is
            not known.

    Raises:
        InputError: series that are not finite, one-dimensional and of equal length, or a time
            step that is not positive.
    """

    horizontal: NDArray[np.float64]
    time_step: float
    _: KW_ONLY
    vertical: NDArray[np.float64] | None = None
    transverse: NDArray[np.float64] | None = None
    name: str = ""
    origin: Origin | None = None
    vertical_origin: Origin | None = None
    transverse_origin: Origin | None = None

    def __post_init__(self) -> None:
        require_positive("Motion.time_step [s]", self.time_step)
        keep_floats(self, "time_step")
        object.__setattr__(self, "horizontal", _samples("horizontal", self.horizontal))
        for name in ("vertical", "transverse"):
            given = getattr(self, name)
            if given is None:
                continue
            series = _samples(name, given)
            if series.size != self.horizontal.size:
                raise InputError(
                    f"Motion.{name} has {series.size} samples and Motion.horizontal "
                    f"{self.horizontal.size}; they must be equal"
                )
            object.__setattr__(self, name, series)

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
        """All components times `factor` >= 0."""
        require_number("a scale factor", factor)
        if not (np.isfinite(factor) and factor >= 0.0):
            raise InputError(f"a scale factor must be finite and not negative, got {factor!r}")
        with np.errstate(over="ignore"):  # an infinite acceleration is refused with a word
            return self.changed(lambda series: series * factor, f"scaled by {factor:g}")

    def reversed(self) -> Motion:
        """The same motion with its horizontal components' signs changed (polarity -1)."""
        said = "reversed"
        return replace(
            self,
            horizontal=-self.horizontal,
            transverse=None if self.transverse is None else -self.transverse,
            origin=(self.origin or Origin()).after(said),
            transverse_origin=_after(self.transverse_origin, said, self.transverse),
        )

    def components(self) -> tuple[Motion, ...]:
        """Each horizontal component by itself with the vertical one, as planar bodies take them."""
        alone = replace(self, transverse=None, transverse_origin=None)
        if self.transverse is None:
            return (alone,)
        across = replace(
            alone,
            horizontal=self.transverse,
            origin=self.transverse_origin,
            name=f"{self.name} across" if self.name else "",
        )
        return alone, across

    def rotated(self, angle: float) -> Motion:
        """The motion with its horizontal pair turned counterclockwise, seen from above.

        (a_x cos - a_y sin, a_x sin + a_y cos); a transverse component that is None is zero.

        Args:
            angle: [rad].
        """
        require_number("angle", angle)
        if not math.isfinite(angle):
            raise InputError(f"an angle must be finite, got {angle!r}")
        c, s = math.cos(angle), math.sin(angle)
        x = self.horizontal
        y = np.zeros_like(x) if self.transverse is None else self.transverse
        said = f"turned by {math.degrees(angle):g}° from above, with the component across it"
        return replace(
            self,
            horizontal=c * x - s * y,
            transverse=s * x + c * y,
            origin=_turned(self.origin, said),
            transverse_origin=_turned(self.transverse_origin, said),
        )

    def changed(
        self, change: Callable[[NDArray[np.float64]], NDArray[np.float64]], said: str
    ) -> Motion:
        """The motion with every component changed in the same way, which `said` puts in words."""
        vertical = None if self.vertical is None else change(self.vertical)
        transverse = None if self.transverse is None else change(self.transverse)
        return self.after(
            said, horizontal=change(self.horizontal), vertical=vertical, transverse=transverse
        )

    def after(
        self,
        said: str,
        *,
        horizontal: NDArray[np.float64],
        vertical: NDArray[np.float64] | None,
        transverse: NDArray[np.float64] | None,
    ) -> Motion:
        """The motion after a step of processing of its components, which `said` puts in words."""
        return replace(
            self,
            horizontal=horizontal,
            vertical=vertical,
            transverse=transverse,
            origin=(self.origin or Origin()).after(said),
            vertical_origin=_after(self.vertical_origin, said, vertical),
            transverse_origin=_after(self.transverse_origin, said, transverse),
        )

    def _repr_html_(self) -> str:
        """For notebooks: the traces under one line of words."""
        from shaketable.drawing.files import as_html
        from shaketable.drawing.trace import plot_trace

        return as_html(plot_trace(self), repr(self))

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        beside = {"vertical": self.vertical, "transverse": self.transverse}
        held = [which for which, series in beside.items() if series is not None]
        others = f", with {' and '.join(held)}" if held else ""
        return (
            f"Motion({name}{self.horizontal.size} samples of {self.time_step:.4g} s, "
            f"peak {self.peak_ground_acceleration / STANDARD_GRAVITY:.3g} g{others})"
        )
