"""The body: a planar rigid object that stands on its base."""

from __future__ import annotations

import math
from dataclasses import dataclass

from shaketable.errors import InputError, keep_floats, require_number, require_positive

SIZES = (1e-6, 1e6)  # m: with squares of others, arithmetic would overflow or lose its digits


@dataclass(frozen=True, kw_only=True, repr=False)
class Body:
    """A rigid body that moves in a vertical plane (theory, section 1).

    Its mass cancels, but where a strap or glue holds it.

    Args:
        base: B, its size along the shaking [m].
        cg_height: height h of the centre of gravity above the base [m].
        left: distance b_L from the left corner, the one toward -x, to the foot of the centre of
            gravity [m]; `base / 2` is a symmetric body.
        gyration_radius: radius of gyration i about the centre of gravity [m].
        restitution_factor: multiplies the angular velocity that a rocking impact leaves, in
            (0, 1]; if given, it takes precedence over the model's.
        name: what to call it in tables and messages.
        mass: [kg], which what holds a body asks for, and nothing else.
        height: of the whole body [m], for walls, straps and edges; 2 cg_height if not given.

    Raises:
        InputError: a size that is not positive or not between 1e-6 and 1e6 m, a height that is not
            above the centre of gravity, a foot of the centre
            of gravity that is not strictly between the corners, or a factor outside its range.
    """

    base: float
    cg_height: float
    left: float
    gyration_radius: float
    restitution_factor: float | None = None
    name: str = ""
    mass: float | None = None
    height: float | None = None

    def __post_init__(self) -> None:
        require_size("Body.base [m]", self.base)
        require_size("Body.cg_height [m]", self.cg_height)
        require_size("Body.gyration_radius [m]", self.gyration_radius)
        require_number("Body.left [m]", self.left)
        if not 0.0 < self.left < self.base:
            raise InputError(
                "Body.left [m], the centre of gravity's distance from the left corner, must lie "
                f"inside the base, between 0 and {self.base!r}, got {self.left!r}"
            )
        if self.restitution_factor is not None:
            require_factor("Body.restitution_factor", self.restitution_factor)
        if self.mass is not None:
            require_positive("Body.mass [kg]", self.mass)
        if self.height is not None:
            require_size("Body.height [m]", self.height)
            if not self.height > self.cg_height:
                raise InputError(
                    f"Body.height [m] must be above the centre of gravity at {self.cg_height!r}, "
                    f"got {self.height!r}"
                )
        keep_floats(
            self, "base", "cg_height", "left", "gyration_radius", "restitution_factor", "mass",
            "height",
        )  # fmt: skip

    @classmethod
    def rectangle(
        cls,
        base: float,
        height: float,
        *,
        eccentricity: float = 0.5,
        restitution_factor: float | None = None,
        name: str = "",
        mass: float | None = None,
    ) -> Body:
        """A rectangle of the given full sizes [m], its radius of gyration as if homogeneous.

        Args:
            base: B, along the shaking [m].
            height: H [m]; the centre of gravity lies at H/2.
            eccentricity: ν1 = b_L / B in (0, 1); 0.5 is symmetric. It moves the foot of the
                centre of gravity and leaves i² = (B² + H²)/12 as it is, as in Boroschek and Romo
                (2004).
            restitution_factor, name, mass: as for any body.

        Raises:
            InputError: as for any body, or ν1 outside (0, 1).
        """
        require_size("base [m]", base)
        require_size("height [m]", height)
        require_number("eccentricity", eccentricity)
        if not 0.0 < eccentricity < 1.0:
            raise InputError(
                "eccentricity (b_L / base, 0.5 is symmetric) must lie between 0 and 1, "
                f"got {eccentricity!r}"
            )
        return cls(
            base=base,
            cg_height=height / 2,
            left=eccentricity * base,
            gyration_radius=math.sqrt((base**2 + height**2) / 12),
            restitution_factor=restitution_factor,
            name=name,
            mass=mass,
        )

    @property
    def right(self) -> float:
        """Distance b_R of the centre of gravity's foot from the right corner [m]."""
        return self.base - self.left

    @property
    def whole_height(self) -> float:
        """`height`, or 2 cg_height [m]."""
        return 2.0 * self.cg_height if self.height is None else self.height

    @property
    def slenderness_right(self) -> float:
        """α_R = atan(b_R / h) [rad]."""
        return math.atan2(self.right, self.cg_height)

    @property
    def slenderness_left(self) -> float:
        """α_L = atan(b_L / h) [rad]."""
        return math.atan2(self.left, self.cg_height)

    @property
    def standing_range(self) -> tuple[float, float]:
        """Tilts [rad] between which it stands by itself: -α_R, toward +x, and α_L, toward -x."""
        return -self.slenderness_right, self.slenderness_left

    def __repr__(self) -> str:
        foot = "" if self.left == self.base / 2 else f", left={self.left:.4g} m"
        factor = "" if self.restitution_factor is None else f", factor {self.restitution_factor:g}"
        factor += "" if self.mass is None else f", mass={self.mass:.4g} kg"
        factor += "" if self.height is None else f", height={self.height:.4g} m"
        name = f"{self.name!r}, " if self.name else ""
        return (
            f"Body({name}base={self.base:.4g} m, cg_height={self.cg_height:.4g} m{foot}, "
            f"gyration_radius={self.gyration_radius:.4g} m{factor})"
        )


def require_size(name: str, size: float) -> None:
    """InputError unless a body can have this size [m]."""
    require_positive(name, size)
    low, high = SIZES
    if not low <= size <= high:
        raise InputError(f"{name} must lie between {low:g} and {high:g} m, got {size!r}")


def require_factor(name: str, factor: float) -> None:
    """InputError unless a restitution factor lies in (0, 1]."""
    require_number(name, factor)
    if not 0.0 < factor <= 1.0:
        raise InputError(
            f"{name}, the share of an impact's angular velocity that is left, must lie in (0, 1], "
            f"got {factor!r}"
        )
