"""The solid: a rigid body in three dimensions that stands on its base."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import require_size
from shaketable.errors import (
    InputError,
    keep_floats,
    require_not_negative,
    require_number,
    require_positive,
)
from shaketable.footprint import convex_hull, nearest_side, require_convex, require_rim
from shaketable.inertia import box_inertia, inertia_tensor, prism_inertia

#: Of free castors on a hard floor; assumed, no source.
ROLLING_RESISTANCE = 0.02
MOST_CORNERS = 64
FEET = (3, 8)

NOT_NEGATIVE = (
    "rolling_resistance", "rolling_friction", "drilling_friction", "contour_friction", "inner_ring",
    "rise",
)  # fmt: skip
FLOATS = ("cg_height", "diameter", "height", "mass", *NOT_NEGATIVE)


@dataclass(frozen=True, eq=False, repr=False)
class Solid:
    """A rigid body on a convex base, or on feet (theory, section 11).

    Its frame has its origin at the centre of gravity, z upward along its axis, and the base in
    the plane z = -cg_height. Its mass cancels, but where a strap holds it.

    `Solid.box`, `Solid.cylinder`, `Solid.polygon` and `Solid.on_feet` make the usual ones.

    Args:
        points: corners of the base, or feet, from the foot of the centre of gravity [m], shape
            (m, 2); None for a circle.
        cg_height: height h of the centre of gravity above the base [m].
        inertia: per unit mass about the centre of gravity [m²], symmetric, shape (3, 3).
        diameter: of a circular base, whose centre is the foot of the centre of gravity [m].
        feet: whether contact is at the points alone; otherwise they are the corners of a base.
        castors: for each foot, whether it is a swivelling wheel.
        rolling_resistance: of a castor, in place of friction, in every horizontal direction.
        rolling_friction: length that times the pressure bounds the moment against rolling [m].
        drilling_friction: the same against turning about the support's normal [m].
        contour_friction: of a circular base: length that, times the pressure and the rate at which
            the contact goes around the rim, is the power lost [m] (Leine 2009).
        inner_ring: of a base that is not on feet: distance of further contact points within it, one
            for each corner, from the foot of the centre of gravity, in parts of the corner's. With
            corners alone a base that lies flat turns as if all pressure were in them. The torsion
            of uniform pressure has a circle with 1/3 and a square with 0.08. [0: none]
        high_points: of a circular base: azimuths [rad] of 3 to 8 points of the rim on which it
            stands, since no rim is flat. Their sides enclose the foot of the centre of gravity.
        rise: height of the high points over the rest of the rim [m]; `cg_height` counts from them.
        height: of the whole body, for pictures [m]; 2 cg_height if not given.
        name: what to call it in tables and messages.
        mass: [kg], which what holds a body asks for, and nothing else.

    Raises:
        InputError: a base that is not convex or has repeated corners, fewer than 3 or more than 64
            of them, or of feet or high points more than 8; a foot of the centre of gravity that is
            not inside the base; an inertia that no body can have; a size that is not positive or
            not between 1e-6 and 1e6 m.
    """

    points: NDArray[np.float64] | None
    cg_height: float
    inertia: NDArray[np.float64]
    _: KW_ONLY
    diameter: float | None = None
    feet: bool = False
    castors: tuple[bool, ...] = ()
    rolling_resistance: float = ROLLING_RESISTANCE
    rolling_friction: float = 0.0
    drilling_friction: float = 0.0
    contour_friction: float = 0.0
    inner_ring: float = 0.0
    high_points: tuple[float, ...] = ()
    rise: float = 0.0
    height: float | None = None
    name: str = ""
    mass: float | None = None

    def __post_init__(self) -> None:
        require_size("Solid.cg_height [m]", self.cg_height)
        object.__setattr__(self, "inertia", inertia_tensor(self.inertia))
        for field in NOT_NEGATIVE:
            require_not_negative(f"Solid.{field}", getattr(self, field))
        if self.height is None:
            object.__setattr__(self, "height", 2.0 * self.cg_height)
        require_size("Solid.height [m]", self.height or 0.0)
        if self.mass is not None:
            require_positive("Solid.mass [kg]", self.mass)
        object.__setattr__(self, "castors", tuple(bool(castor) for castor in self.castors))
        if (self.points is None) == (self.diameter is None):
            raise InputError("a Solid has either points or a diameter, and not both")
        if self.diameter is not None:
            require_size("Solid.diameter [m]", self.diameter)
            if self.castors:
                raise InputError("Solid.castors are feet; a circular base has none")
            self._require_high_points()
        else:
            object.__setattr__(self, "points", self._points())
            if len(self.high_points) or self.rise > 0.0:
                raise InputError("Solid.high_points are of the rim of a circular base")
            if self.contour_friction > 0.0:
                raise InputError(
                    "Solid.contour_friction is of the rim of a circular base; one on points loses "
                    "energy as it rolls from corner to corner"
                )
        if self.inner_ring >= 1.0 or (self.inner_ring > 0.0 and self.feet):
            raise InputError(
                "Solid.inner_ring must lie in [0, 1) and is of a base that is not on feet, got "
                f"{self.inner_ring!r}"
            )
        if self.inner_ring > 0.0 and len(self.corners) > MOST_CORNERS // 2:
            raise InputError(
                f"a Solid with an inner ring has at most {MOST_CORNERS // 2} corners, got "
                f"{len(self.corners)}"
            )
        keep_floats(self, *FLOATS)

    def _require_high_points(self) -> None:
        """Sort the high points of a rim, and check that it stands on them."""
        for azimuth in self.high_points:
            require_number("an azimuth of Solid.high_points [rad]", azimuth)
            if not math.isfinite(azimuth):
                raise InputError(f"an azimuth of Solid.high_points [rad] is {azimuth!r}")
        azimuths = sorted(float(azimuth) % (2 * math.pi) for azimuth in self.high_points)
        object.__setattr__(self, "high_points", tuple(azimuths))
        if bool(azimuths) != (self.rise > 0.0):
            raise InputError(
                f"a rim on high points has both their azimuths and their rise: got {len(azimuths)} "
                f"azimuths and a rise of {self.rise!r} m"
            )
        if not azimuths:
            return
        require_rim(azimuths)
        require_size("Solid.rise [m]", self.rise)
        if self.rise >= self.cg_height:
            raise InputError(
                f"Solid.rise [m] must be below cg_height {self.cg_height!r}, got {self.rise!r}"
            )
        if self.inner_ring > 0.0 or self.contour_friction > 0.0:
            raise InputError(
                "Solid.inner_ring and contour_friction are of a rim that lies on the support all "
                "around; one on high points has neither"
            )

    def _points(self) -> NDArray[np.float64]:
        """The contact points, the corners of the base counterclockwise and first."""
        what = "feet" if self.feet else "corners"
        points = np.array(self.points, np.float64)
        if points.ndim != 2 or points.shape[1:] != (2,) or not np.isfinite(points).all():
            raise InputError(f"Solid.points must be finite pairs (x, y), got shape {points.shape}")
        low, high = FEET if self.feet else (3, MOST_CORNERS)
        if not low <= len(points) <= high:
            raise InputError(f"a Solid has {low} to {high} {what}, got {len(points)}")
        reach = float(np.hypot(*points.T).max())
        require_size(f"the distance of the farthest of the {what} [m]", reach)
        if self.castors and not (self.feet and len(self.castors) == len(points)):
            raise InputError(
                f"Solid.castors must tell of each foot whether it is one: {len(self.castors)} "
                f"given for {len(points) if self.feet else 'no'} feet"
            )
        points = points if self.feet else require_convex(points)
        hull = convex_hull(points)
        sides = np.roll(points[hull], -1, axis=0) - points[hull]
        inward = sides[:, 1] * points[hull, 0] - sides[:, 0] * points[hull, 1]
        if not (inward > 0.0).all():
            raise InputError(
                "the foot of the centre of gravity, (0, 0), must lie inside the base: side "
                f"{int(np.argmin(inward)) + 1} of {len(hull)} passes it on the wrong side or "
                f"through it; {what}: {points.round(6).tolist()}"
            )
        inside = [k for k in range(len(points)) if k not in set(hull)]
        order = [*hull, *inside]
        if self.castors:
            object.__setattr__(self, "castors", tuple(self.castors[k] for k in order))
        points = points[order]
        points.flags.writeable = False
        return points

    @classmethod
    def box(
        cls,
        size_x: float,
        size_y: float,
        height: float,
        *,
        cg_height: float | None = None,
        eccentricity: tuple[float, float] = (0.5, 0.5),
        rolling_friction: float = 0.0,
        drilling_friction: float = 0.0,
        inner_ring: float = 0.0,
        name: str = "",
        mass: float | None = None,
    ) -> Solid:
        """A box with the inertia of a homogeneous one.

        Args:
            size_x, size_y, height: full sizes [m].
            cg_height: h [m]; half the height if not given.
            eccentricity: (ν_x, ν_y): the foot of the centre of gravity lies at ν_x size_x and
                ν_y size_y from the corner of least x and y. Neither it nor `cg_height` changes
                the inertia, as in `Body.rectangle`.
            rolling_friction, drilling_friction, inner_ring, name, mass: as for any solid.

        Raises:
            InputError: as for any solid, or an eccentricity outside (0, 1).
        """
        for word, size in (("size_x", size_x), ("size_y", size_y), ("height", height)):
            require_size(f"{word} [m]", size)
        shares = tuple(eccentricity)
        if len(shares) != 2:
            raise InputError(f"eccentricity must be two numbers (x, y), got {eccentricity!r}")
        for word, share in zip("xy", shares, strict=True):
            require_number(f"eccentricity along {word}", share)
            if not 0.0 < share < 1.0:
                raise InputError(
                    f"eccentricity along {word} (0.5 is symmetric) must lie between 0 and 1, "
                    f"got {share!r}"
                )
        x, y = np.array([0.0, size_x, size_x, 0.0]), np.array([0.0, 0.0, size_y, size_y])
        return cls(
            np.column_stack([x - shares[0] * size_x, y - shares[1] * size_y]),
            height / 2 if cg_height is None else cg_height,
            box_inertia(size_x, size_y, height),
            rolling_friction=rolling_friction,
            drilling_friction=drilling_friction,
            inner_ring=inner_ring,
            height=height,
            name=name,
            mass=mass,
        )

    @classmethod
    def cylinder(
        cls,
        diameter: float,
        height: float,
        *,
        cg_height: float | None = None,
        rolling_friction: float = 0.0,
        contour_friction: float = 0.0,
        drilling_friction: float = 0.0,
        inner_ring: float = 0.0,
        high_points: Sequence[float] = (),
        rise: float = 0.0,
        name: str = "",
        mass: float | None = None,
    ) -> Solid:
        """An upright cylinder with the inertia of a homogeneous one.

        Args:
            diameter, height: full sizes [m].
            cg_height: h [m]; half the height if not given.
            rolling_friction, contour_friction, drilling_friction: as for any solid [m].
            inner_ring, high_points, rise, name, mass: as for any solid.

        Raises:
            InputError: as for any solid.
        """
        require_size("diameter [m]", diameter)
        require_size("height [m]", height)
        radius = diameter / 2
        across = (3 * radius**2 + height**2) / 12
        return cls(
            None,
            height / 2 if cg_height is None else cg_height,
            np.diag([across, across, radius**2 / 2]),
            diameter=diameter,
            rolling_friction=rolling_friction,
            contour_friction=contour_friction,
            drilling_friction=drilling_friction,
            inner_ring=inner_ring,
            high_points=tuple(high_points),
            rise=rise,
            height=height,
            name=name,
            mass=mass,
        )

    @classmethod
    def polygon(
        cls,
        corners: ArrayLike,
        height: float,
        *,
        cg_height: float | None = None,
        inertia: ArrayLike | None = None,
        rolling_friction: float = 0.0,
        drilling_friction: float = 0.0,
        inner_ring: float = 0.0,
        name: str = "",
        mass: float | None = None,
    ) -> Solid:
        """A prism.

        Args:
            corners: of its base, in order in either sense, from the foot of the centre of gravity
                [m], shape (m, 2), 3 <= m <= 64.
            height: [m].
            cg_height: h [m]; half the height if not given.
            inertia: per unit mass [m²], (3, 3); the homogeneous prism's about its own centroid if
                not given.
            rolling_friction, drilling_friction, inner_ring, name, mass: as for any solid.

        Raises:
            InputError: as for any solid.
        """
        require_size("height [m]", height)
        base = _pairs("corners", corners)
        return cls(
            base,
            height / 2 if cg_height is None else cg_height,
            np.asarray(prism_inertia(base, height) if inertia is None else inertia),
            rolling_friction=rolling_friction,
            drilling_friction=drilling_friction,
            inner_ring=inner_ring,
            height=height,
            name=name,
            mass=mass,
        )

    @classmethod
    def on_feet(
        cls,
        points: ArrayLike,
        height: float,
        *,
        cg_height: float | None = None,
        inertia: ArrayLike | None = None,
        castors: Sequence[bool] = (),
        rolling_resistance: float = ROLLING_RESISTANCE,
        rolling_friction: float = 0.0,
        drilling_friction: float = 0.0,
        name: str = "",
        mass: float | None = None,
    ) -> Solid:
        """A body on 3 to 8 feet.

        Args:
            points: the feet from the foot of the centre of gravity [m], shape (m, 2).
            height: of the whole body above the floor [m].
            cg_height: h [m]; half the height if not given.
            inertia: per unit mass [m²], (3, 3); if not given, that of the homogeneous box of this
                height around the feet.
            castors: for each foot, whether it is a swivelling wheel, with `rolling_resistance` in
                place of friction; a braked one is a foot.
            rolling_resistance: dimensionless.
            rolling_friction, drilling_friction, name: as for any solid.

        Raises:
            InputError: as for any solid.
        """
        require_size("height [m]", height)
        feet = _pairs("points", points)
        span_x, span_y = np.ptp(feet, axis=0).tolist()
        around = box_inertia(span_x, span_y, height)
        return cls(
            feet,
            height / 2 if cg_height is None else cg_height,
            around if inertia is None else np.asarray(inertia),
            feet=True,
            castors=tuple(castors),
            rolling_resistance=rolling_resistance,
            rolling_friction=rolling_friction,
            drilling_friction=drilling_friction,
            height=height,
            name=name,
            mass=mass,
        )

    @property
    def round(self) -> bool:
        """Whether it stands on a circle: turned about its axis, it stands as before."""
        return self.diameter is not None and not self.high_points

    @property
    def square(self) -> bool:
        """Whether it stands as before once it is turned by a quarter about its axis."""
        if self.points is None:
            return self.round
        corners = self.points[:, 0] + 1j * self.points[:, 1]
        apart = np.abs(1j * corners[:, None] - corners[None, :]).min(axis=1)
        alike = bool((apart <= 1e-9 * np.abs(corners).max()).all())
        inertia = self.inertia
        return alike and math.isclose(inertia[0, 0], inertia[1, 1], rel_tol=1e-9)

    @property
    def contacts(self) -> NDArray[np.float64]:
        """Contact points, corners of the base counterclockwise and first; (0, 2) if it is round."""
        if self.points is not None:
            return self.points
        azimuths = np.asarray(self.high_points, np.float64)
        radius = (self.diameter or 0.0) / 2
        return radius * np.column_stack([np.cos(azimuths), np.sin(azimuths)])

    @property
    def corners(self) -> NDArray[np.float64]:
        """Corners of the base, counterclockwise, (m, 2) [m]; none if it is round."""
        contacts = self.contacts
        return contacts[: len(convex_hull(contacts))] if len(contacts) else contacts

    def reach_toward(self, azimuth: float) -> float:
        """How far its base reaches toward an azimuth of its own from the foot [rad] → [m]."""
        if self.diameter is not None:
            return self.diameter / 2
        toward = np.array([math.cos(azimuth), math.sin(azimuth)])
        return float((self.corners @ toward).max())

    @property
    def inscribed(self) -> float:
        """Distance of the foot of the centre of gravity from the nearest side of the base [m].

        Of a circle its radius, on high points too: over the sides between these it tips on to its
        rim, and falls over the rim.
        """
        return nearest_side(self.corners) if self.diameter is None else self.diameter / 2

    @property
    def least_slenderness(self) -> float:
        """Least tilt at which it falls by itself, in whatever direction [rad]."""
        return math.atan2(self.inscribed, self.cg_height - self.rise)

    @property
    def extent(self) -> tuple[float, float]:
        """Sizes of the base along x and y [m]."""
        if self.diameter is not None:
            return self.diameter, self.diameter
        size_x, size_y = np.ptp(self.corners, axis=0).tolist()
        return size_x, size_y

    def renamed(self, name: str) -> Solid:
        return replace(self, name=name)

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        if self.diameter is not None:
            base = f"circle of {self.diameter:.4g} m"
            if self.high_points:
                base += f" on {len(self.high_points)} points {self.rise:.4g} m high"
        elif self.feet:
            base = f"{len(self.contacts)} feet"
        else:
            base = f"{len(self.corners)} corners"
        x, y, z = np.sqrt(np.diag(self.inertia))
        mass = "" if self.mass is None else f", mass={self.mass:.4g} kg"
        return (
            f"Solid({name}{base}, inscribed {self.inscribed:.4g} m, cg_height="
            f"{self.cg_height:.4g} m, gyration radii {x:.4g}, {y:.4g}, {z:.4g} m{mass})"
        )


def _pairs(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        points = np.array(values, np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be pairs of numbers (x, y) [m]: {error}") from None
    if points.ndim != 2 or points.shape[1:] != (2,) or len(points) < 3:
        raise InputError(f"{name} must be three pairs (x, y) [m] or more, got shape {points.shape}")
    return points
