"""A case in Drake, on a support at rest under apparent gravity."""

from __future__ import annotations

import math

import numpy as np

from benchmarks.moving_support.cases import Answers, Case

STIFFNESS = 1e8  # N/m


def run(case: Case, step: float) -> Answers:
    """Four small spheres at the corners of a box of 1 kg, SAP with lagged regularisation.

    Contacts are of 1e8 N/m and relax within a step; the defaults are of 1e6 N/m and 0.1 s.
    """
    from pydrake.common.value import Value
    from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, Sphere
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
    hard = ProximityProperties()
    grip = CoulombFriction(case.friction, case.friction)
    AddContactMaterial(point_stiffness=STIFFNESS, friction=grip, properties=hard)
    hard.AddProperty("material", "relaxation_time", step)
    plant.RegisterCollisionGeometry(
        plant.world_body(), RigidTransform(), HalfSpace(), "ground", hard
    )
    h = case.solid.cg_height
    for k, (x, y) in enumerate(case.solid.corners):
        place = RigidTransform([x, y, -h + small])
        plant.RegisterCollisionGeometry(body, place, Sphere(small), f"corner {k}", hard)
    plant.Finalize()
    known = np.arange(len(case.force)) * case.step

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
    for k in range(1, 4 * (len(case.acceleration) - 1) + 1):
        simulator.AdvanceTo(k * case.step / 4)
        turn = plant.EvalBodyPoseInWorld(context, body).rotation().matrix()
        peak = max(peak, math.atan2(math.hypot(turn[0, 2], turn[1, 2]), turn[2, 2]))
        if peak > math.pi / 2:
            return Answers(math.nan, math.pi / 2, falls=True)
    pose = plant.EvalBodyPoseInWorld(context, body)
    away = pose.translation() - h * pose.rotation().matrix()[:, 2]
    return Answers(float(np.hypot(away[0], away[1])), peak, falls=False)
