"""A case in MuJoCo, with the support's motion given in three ways."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.moving_support.cases import Answers, Case
from shaketable.units import STANDARD_GRAVITY

#: What drives the box: apparent gravity on a support at rest; a table of a joint each way whose
#: place and speed are set at every step; a mocap body, whose place is.
WAYS = ("apparent gravity", "driven joints", "mocap")
HEAVY = 1e4  # kg: a table that a box of 1 kg hardly moves within one step


def model_of(case: Case, step: float, way: str) -> Any:
    """The box on a table; contacts have a time constant of 4 steps, and defaults in all else.

    The table's surface has no mass, so that the force on the table of HEAVY moves it.
    """
    import mujoco as mj

    (a, b, height), h = case.size, case.solid.cg_height
    contact = f'friction="{case.friction} 0 0" solref="{4 * step} 1" condim="3"'
    spread = " ".join(str(each) for each in np.diag(case.solid.inertia))
    axis = f"{-math.sin(case.azimuth)} {math.cos(case.azimuth)} 0 {math.degrees(case.tilt)}"
    top = f'<geom type="box" size="20 20 1" pos="0 0 -1" mass="0" {contact}/>'
    if way == "apparent gravity":
        table, lean = f'<geom type="plane" size="50 50 1" {contact}/>', ""
    elif way == "mocap":
        table, lean = f'<body mocap="true" axisangle="{axis}">{top}</body>', axis
    else:
        joints = "".join(
            f'<joint type="slide" axis="{each}"/>' for each in ("1 0 0", "0 1 0", "0 0 1")
        )
        inertia = f'<inertial pos="0 0 0" mass="{HEAVY}" diaginertia="1 1 1"/>'
        tilted = f'<body axisangle="{axis}">{top}</body>'
        table, lean = f"<body>{joints}{inertia}{tilted}</body>", axis
    turned = f'axisangle="{lean}"' if lean else ""
    place = _up(case) * h if lean else np.array([0.0, 0.0, h])
    return mj.MjModel.from_xml_string(f"""
      <mujoco><option timestep="{step}" integrator="implicitfast" cone="elliptic" impratio="10"
        tolerance="1e-14" gravity="0 0 {-STANDARD_GRAVITY}"/>
      <worldbody>{table}
      <body name="box" pos="{place[0]} {place[1]} {place[2]}" {turned}><freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="{spread}"/>
      <geom type="box" size="{a / 2} {b / 2} {height / 2}" {contact}/></body></worldbody>
      </mujoco>""")


def run(case: Case, step: float, way: str) -> Answers:
    import mujoco as mj

    model = model_of(case, step, way)
    data = mj.MjData(model)
    count = round(case.seconds / step)
    at, known = np.arange(count + 1) * step, np.arange(len(case.acceleration)) * case.step
    box = model.body("box").id
    h = case.solid.cg_height
    up = np.array([0.0, 0.0, 1.0]) if way == WAYS[0] else _up(case)
    force = np.column_stack([np.interp(at, known, each) for each in case.force.T])
    speed = _speed(case, at, known)
    # as MuJoCo steps: a place by the speed at the end of the step
    moved = np.vstack([np.zeros(3), np.cumsum(speed[1:] * step, axis=0)])
    pushed = np.diff(speed, axis=0) / step
    mj.mj_forward(model, data)
    peak, begun = 0.0, _base(data.body(box), h)
    for k in range(count):
        if way == WAYS[0]:
            model.opt.gravity[:] = force[k]
        elif way == WAYS[1]:
            data.qpos[:3], data.qvel[:3] = moved[k], speed[k]
            data.qfrc_applied[:3] = HEAVY * (pushed[k] + [0.0, 0.0, STANDARD_GRAVITY])
        else:
            data.mocap_pos[0] = moved[k]
        mj.mj_step(model, data)
        peak = max(peak, between(data.body(box).xmat.reshape(3, 3)[:, 2], up))
        if peak > math.pi / 2:
            return Answers(math.nan, math.pi / 2, falls=True)
    mj.mj_forward(model, data)
    away = _base(data.body(box), h) - begun - (0.0 if way == WAYS[0] else moved[count])
    return Answers(float(np.linalg.norm(away - (away @ up) * up)), peak, falls=False)


def _base(body: Any, h: float) -> NDArray[np.float64]:
    """Where the middle of the base is."""
    return np.asarray(body.xpos - h * body.xmat.reshape(3, 3)[:, 2])


def between(axis: NDArray[np.float64], up: NDArray[np.float64]) -> float:
    """The angle between two unit vectors, exact where it is small; quick, for every step asks."""
    (x, y, z), (a, b, c) = axis.tolist(), up.tolist()
    across = math.hypot(y * c - z * b, z * a - x * c, x * b - y * a)
    return math.atan2(across, x * a + y * b + z * c)


def _up(case: Case) -> NDArray[np.float64]:
    """The support's normal."""
    lean = math.sin(case.tilt)
    return np.array(
        [lean * math.cos(case.azimuth), lean * math.sin(case.azimuth), math.cos(case.tilt)]
    )


def _speed(case: Case, at: NDArray[np.float64], known: NDArray[np.float64]) -> NDArray[np.float64]:
    """The support's velocity, exact for accelerations that are linear between samples."""
    a, h = case.acceleration, case.step
    speed = np.vstack([np.zeros(3), np.cumsum((a[1:] + a[:-1]) * h / 2, axis=0)])
    k = np.minimum((at / h + 1e-9).astype(int), len(a) - 2)
    t = (at - known[k])[:, None]
    return np.asarray(speed[k] + a[k] * t + (a[k + 1] - a[k]) / h * t**2 / 2)
