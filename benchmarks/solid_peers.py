"""`python -m benchmarks.solid_peers`: solids in MuJoCo and Drake beside this package.

Boxes on level and tilted supports under pulses in three components, without restitution. The truth
is the tests' time-stepping (Moreau 1988) where it has converged; beside it stand the errors of the
peak nutation in parts of that peak, and the times of one run on one core.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from tests.support.moreau import march

from shaketable import General, Motion, Solid, Support, simulate
from shaketable.units import STANDARD_GRAVITY

CASES = 12
STEP, SECONDS, PULSE = 0.01, 1.2, 0.5
COARSE, FINE = 300, 1200  # steps a sample of the truth, which has to be the same with both
SAME = 2e-3  # of the peak
LEAST = 0.01  # rad: smaller peaks are not compared
MUJOCO_STEPS = (2e-5, 2e-4)
DRAKE_STEPS = (2e-5, 2e-4)


class Case(NamedTuple):
    """A box, how it is shaken, and its peak nutation [rad]."""

    solid: Solid
    motion: Motion
    support: Support
    friction: float
    force: NDArray[np.float64]  # apparent gravity on the support [m/s²], (sample, 3)
    peak: float


def cases() -> Iterator[Case]:
    """The first so many random ones that stay standing and on which the truth has converged."""
    seed, found = 0, 0
    while found < CASES:
        seed += 1
        rng = np.random.default_rng(seed)
        size, slender = rng.uniform(0.15, 0.5, 2), rng.uniform(2.0, 4.0)
        height = slender * size.min()
        solid = Solid.box(*size, height)
        friction = rng.uniform(0.3, 0.9)
        tilt, azimuth = rng.choice([0.0, 0.05]), rng.uniform(-math.pi, math.pi)
        t = np.arange(round(SECONDS / STEP) + 1) * STEP
        push = np.where(t < PULSE, np.sin(2 * math.pi * t / PULSE), 0.0)
        strong = rng.uniform(1.0, 2.0) * STANDARD_GRAVITY / slender
        toward = rng.uniform(-math.pi, math.pi)
        motion = Motion(
            strong * math.cos(toward) * push, STEP, vertical=0.2 * strong * push,
            transverse=strong * math.sin(toward) * push,
        )  # fmt: skip
        axis = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
        ground = np.column_stack([motion.horizontal, motion.transverse, motion.vertical])
        lean = Rotation.from_rotvec(tilt * axis).inv()
        force = np.asarray(lean.apply(-ground - [0.0, 0.0, STANDARD_GRAVITY]))
        corners = np.column_stack([solid.corners, np.full(4, -solid.cg_height)])
        coarse, fine = (
            march(
                corners, solid.inertia, force, STEP, friction=friction, restitution=0.0,
                parts=parts, orientation=0.0,
            )
            for parts in (COARSE, FINE)
        )  # fmt: skip
        if fine.fell or fine.peak < LEAST or abs(coarse.peak - fine.peak) > SAME * fine.peak:
            continue
        found += 1
        support = Support(tilt=float(tilt), azimuth=float(azimuth))
        yield Case(solid, motion, support, float(friction), force, float(fine.peak))


def ours(case: Case) -> float:
    run = simulate(
        case.solid, case.motion, case.support, model=General(static_friction=case.friction)
    )
    return float(run.nutation[: case.motion.horizontal.size].max())


def nutation(w: float, x: float, y: float, z: float) -> float:
    return math.acos(min(1.0, max(-1.0, 1.0 - 2.0 * (x * x + y * y))))


def mujoco(case: Case, step: float) -> float:
    """A box on a plane with contacts as hard as the step allows, pushed by apparent gravity."""
    import mujoco as mj

    (a, b), h = case.solid.extent, case.solid.cg_height
    contact = f'friction="{case.friction} 0 0" solref="{4 * step} 1" condim="3"'
    spread = " ".join(str(each) for each in np.diag(case.solid.inertia))
    model = mj.MjModel.from_xml_string(f"""
      <mujoco><option timestep="{step}" integrator="implicitfast" cone="elliptic" impratio="10"/>
      <worldbody><geom type="plane" size="50 50 1" {contact}/>
      <body pos="0 0 {h}"><freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="{spread}"/>
      <geom type="box" size="{a / 2} {b / 2} {h}" {contact}/></body></worldbody></mujoco>""")
    data = mj.MjData(model)
    count = round(SECONDS / step)
    at = np.arange(count) * step
    known = np.arange(len(case.force)) * STEP
    force = np.column_stack([np.interp(at, known, each) for each in case.force.T])
    peak = 0.0
    for k in range(count):
        model.opt.gravity[:] = force[k]
        mj.mj_step(model, data)
        peak = max(peak, nutation(*data.qpos[3:7]))
    return peak


def drake(case: Case, step: float) -> float:
    """Four small spheres at the corners of a box, SAP with lagged regularisation."""
    from pydrake.common.value import Value
    from pydrake.geometry import HalfSpace, Sphere
    from pydrake.math import RigidTransform
    from pydrake.multibody.math import SpatialForce
    from pydrake.multibody.plant import (
        AddMultibodyPlantSceneGraph,
        CoulombFriction,
        DiscreteContactApproximation,
        ExternallyAppliedSpatialForce,
    )
    from pydrake.multibody.tree import SpatialInertia, UnitInertia
    from pydrake.systems.analysis import Simulator
    from pydrake.systems.framework import DiagramBuilder, LeafSystem

    small = 1e-3
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=step)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kLagged)
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
    spread = np.diag(case.solid.inertia)
    body = plant.AddRigidBody("box", SpatialInertia(1.0, np.zeros(3), UnitInertia(*spread)))
    grip = CoulombFriction(case.friction, case.friction)
    plant.RegisterCollisionGeometry(
        plant.world_body(), RigidTransform(), HalfSpace(), "ground", grip
    )
    h = case.solid.cg_height
    for k, (x, y) in enumerate(case.solid.corners):
        place = RigidTransform([x, y, -h + small])
        plant.RegisterCollisionGeometry(body, place, Sphere(small), f"corner {k}", grip)
    plant.Finalize()
    known = np.arange(len(case.force)) * STEP

    class Pull(LeafSystem):  # type: ignore[misc]
        def __init__(self) -> None:
            LeafSystem.__init__(self)
            self.DeclareAbstractOutputPort(
                "pull", lambda: Value([ExternallyAppliedSpatialForce()]), self.write
            )

        def write(self, context, output) -> None:  # type: ignore[no-untyped-def]
            one = ExternallyAppliedSpatialForce()
            one.body_index = body.index()
            one.p_BoBq_B = np.zeros(3)
            t = context.get_time()
            f = np.array([np.interp(t, known, each) for each in case.force.T])
            one.F_Bq_W = SpatialForce(np.zeros(3), f)
            output.set_value([one])

    pull = builder.AddSystem(Pull())
    port = plant.get_applied_spatial_force_input_port()
    builder.Connect(pull.get_output_port(0), port)
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, body, RigidTransform([0.0, 0.0, h]))
    simulator.Initialize()
    peak = 0.0
    for k in range(1, 4 * round(SECONDS / STEP) + 1):
        simulator.AdvanceTo(k * STEP / 4)
        turn = plant.EvalBodyPoseInWorld(context, body).rotation().matrix()
        peak = max(peak, math.acos(min(1.0, max(-1.0, turn[2, 2]))))
    return peak


def tell(name: str, chosen: list[Case], run: Callable[[Case], float], alone: float) -> float:
    """Print a row; returns the time of one run [s]."""
    run(chosen[0])  # compiles, loads
    start = time.perf_counter()
    peaks = np.array([run(case) for case in chosen])
    each = (time.perf_counter() - start) / len(chosen)
    off = np.abs(peaks / [case.peak for case in chosen] - 1.0)
    slower = each / alone if alone else 1.0
    print(
        f"| {name} | {1e3 * each:,.2f} | {slower:,.0f} | {np.median(off):.1e} | {off.max():.1e} |",
        flush=True,
    )
    return each


def main() -> None:
    chosen = list(cases())
    print("| software | ms a run | times slower | median error | largest |")
    print("|---|---:|---:|---:|---:|")
    alone = tell("shaketable, `simulate`", chosen, ours, 0.0)
    for step in MUJOCO_STEPS:
        tell(f"MuJoCo, {1e6 * step:g} μs", chosen, lambda case, s=step: mujoco(case, s), alone)
    for step in DRAKE_STEPS:
        tell(f"Drake, {1e6 * step:g} μs", chosen, lambda case, s=step: drake(case, s), alone)


if __name__ == "__main__":
    main()
