"""The shapes of objects: what a row may say of them, and the solids that are simulated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from shaketable.inertia import box_inertia
from shaketable.inventory.item import BaseShape, Castors, Item
from shaketable.inventory.vocabulary import words_of
from shaketable.language import tell
from shaketable.solid import Solid

SHAPES = {word: BaseShape(meaning) for word, meaning in words_of("shapes").items()}


def against_shape(
    numbers: Mapping[str, float], shape: BaseShape | None
) -> Iterator[tuple[str, str]]:
    """What a row's numbers cannot be beside the shape that it names: which, and why."""
    depth, width = numbers.get("depth"), numbers.get("width")
    if shape in (BaseShape.BOX, BaseShape.FEET) and "diameter" in numbers:
        message = tell(
            "found {shape}, with a diameter: give depth and width, or cylinder", shape=shape
        )
        yield "shape", message
    if shape is not BaseShape.CYLINDER:
        if "contour_friction" in numbers and "diameter" not in numbers:
            yield "contour_friction", tell("is of the rim of a cylinder")
        return
    if depth is not None and width is not None and depth != width:
        message = tell(
            "found cylinder, with a depth of {depth:g} m and a width of {width:g} m: give one "
            "diameter, or box",
            depth=depth,
            width=width,
        )
        yield "shape", message
    eccentricity = numbers.get("eccentricity", 0.5)
    if eccentricity != 0.5:
        message = tell(
            "of a cylinder it is {middle:g}, found {eccentricity:g}",
            middle=0.5,
            eccentricity=eccentricity,
        )
        yield "eccentricity", message


def solid_of(item: Item, rolling_resistance: float) -> Solid | None:
    """The solid that stands for an item: x from its front to its back, y to its left.

    Its radii of gyration about x and y are those of its planar bodies. About its axis it is that of
    a homogeneous box of its base, or the nearest to it that a body with those two can have.

    Args:
        item: what stands on castors is on four of them, in the corners of its base.
        rolling_resistance: of castors that are free.

    Returns:
        None where its base is not known: its width or depth, or a circle's off-centre mass.
    """
    body, across = item.body, item.sideways
    if across is None or not item.depth_known:
        return None
    on_feet = item.rolls or item.shape is BaseShape.FEET
    if item.shape is BaseShape.CYLINDER and not on_feet:
        if body.left != body.right:
            return None
        return Solid.cylinder(
            body.base,
            item.height,
            cg_height=body.cg_height,
            rolling_friction=item.rolling_friction,
            contour_friction=item.contour_friction,
            drilling_friction=item.drilling_friction,
            name=item.name,
            mass=item.mass,
        )
    front, back, left, right = body.left, body.right, across.left, across.right
    corners = [(-front, -right), (back, -right), (back, left), (-front, left)]
    about_x, about_y = across.gyration_radius**2, body.gyration_radius**2
    about_z = float(box_inertia(body.base, across.base, item.height)[2, 2])
    about_z = min(max(about_z, abs(about_x - about_y)), about_x + about_y)
    inertia = np.diag([about_x, about_y, about_z])
    if not on_feet:
        return Solid.polygon(
            corners,
            item.height,
            cg_height=body.cg_height,
            inertia=inertia,
            rolling_friction=item.rolling_friction,
            drilling_friction=item.drilling_friction,
            name=item.name,
            mass=item.mass,
        )
    return Solid.on_feet(
        corners,
        item.height,
        cg_height=body.cg_height,
        inertia=inertia,
        castors=(item.castors is Castors.FREE,) * len(corners),
        rolling_resistance=rolling_resistance,
        rolling_friction=item.rolling_friction,
        drilling_friction=item.drilling_friction,
        name=item.name,
        mass=item.mass,
    )
