"""Gravity in what an accelerometer records: a mean of about 1 g, which is no motion."""

from __future__ import annotations

import logging
from dataclasses import replace

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.text import RecordText
from shaketable.units import STANDARD_GRAVITY

log = logging.getLogger(__name__)

ABOUT_G = (0.9, 1.1)  # g: the mean of a sensor within 25 degrees of the vertical, with its offset


def without_gravity(text: RecordText, component: Component) -> Component:
    """A vertical component whose mean is 1 g less that mean, any other one as it is.

    Raises:
        InputError: such a mean in a component that its name does not call vertical.
    """
    mean = float(component.acceleration.mean())
    if not ABOUT_G[0] <= abs(mean) / STANDARD_GRAVITY <= ABOUT_G[1]:
        return component
    if not component.is_vertical:
        raise text.fault(
            tell(
                "column {column} has a mean of {mean:.3g} g: this is gravity, and the column is "
                "the vertical. Name it 'up', or delete it",
                column=quoted(component.code) if component.code else 1,
                mean=mean / STANDARD_GRAVITY,
            )
        )
    said = f"mean of {mean / STANDARD_GRAVITY:.4g} g, gravity, taken away"
    log.warning(
        "%s: column %s has a mean of %.4g g, gravity, which is taken away",
        text.path,
        quoted(component.code),
        mean / STANDARD_GRAVITY,
    )
    return replace(
        component,
        acceleration=component.acceleration - mean,
        processing=(*component.processing, said),
    )
