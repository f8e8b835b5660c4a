"""Bodies, motions and kernels' views of them that several tests build."""

from __future__ import annotations

import math

import numpy as np

from shaketable import Body, General, Motion
from shaketable.engine.body_tables import BODY, read_body
from shaketable.physics.plane.contact import ContactBody

G = 9.80665

# Boroschek and Iruretagoyena (2006), table I: width and height [m].
TABLE_1 = [
    (0.04, 0.20),
    (0.05, 0.20),
    (0.06, 0.20),
    (0.10, 0.50),
    (0.13, 0.50),
    (0.15, 0.50),
    (0.18, 0.50),
    (0.20, 1.00),
    (0.25, 1.00),
    (0.30, 1.00),
    (0.30, 1.50),
    (0.38, 1.50),
]


def block(alpha: float, p: float) -> Body:
    """The rectangle with α [rad] = atan(b/h) and the frequency parameter p [rad/s]."""
    r = 3 * G / (4 * p * p)
    return Body.rectangle(2 * r * math.sin(alpha), 2 * r * math.cos(alpha))


def sampled(function, duration: float, time_step: float) -> Motion:
    """A motion from a function of time [s] in m/s²; the last sample falls on `duration`."""
    count = round(duration / time_step)
    step = duration / count
    return Motion(function(np.arange(count + 1) * step), step)


def contact_body(
    body: Body, model: General | None = None, tilt: float = 0.0, bounce_speed: float | None = None
) -> ContactBody:
    """The body on its support as the kernels of the general model see it."""
    rows = (model or General()).tabulate([body], np.array([tilt])).bodies
    seen = read_body(rows[0], 0, BODY)
    return seen if bounce_speed is None else seen._replace(bounce_speed=bounce_speed)


def mirrored(body: Body) -> Body:
    """The body with left and right exchanged."""
    return Body(
        base=body.base,
        cg_height=body.cg_height,
        left=body.right,
        gyration_radius=body.gyration_radius,
        name=body.name,
    )


#: What a report tells of the run that it is of.
RUN: dict[str, object] = {
    "inventory": {"path": "things.csv", "sha256": "0"},
    "motions": {"description": "24 motions", "sources": []},
    "scaling": "",
    "messages": [],
    "finished": "now",
    "command": "shaketable assess",
    "versions": {"shaketable": "0"},
}
