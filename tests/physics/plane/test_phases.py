"""The table of phases, and thousands of transitions against it."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.time_stepping import time_stepping

from shaketable import General, Motion, Phase, Support
from shaketable.engine.body_tables import BODY, BOUNCE_SPEED, SETTLE_SPEED
from shaketable.engine.endings import Ending
from shaketable.engine.general_one import Scratch, Trace, move_one
from shaketable.engine.one_loop import PlanarSummary
from shaketable.models.engine_input import refined, substeps
from shaketable.physics.plane import codes
from shaketable.physics.plane.extremes import Log
from shaketable.physics.plane.phase_series import ROWS, TERMS
from shaketable.physics.plane.phases import TABLE, Guard
from tests.support.builders import G, block
from tests.support.pulses import Case, random_pulse

ROOM = 20_000


def run(
    case: Case, ends: tuple[float, float] = (BOUNCE_SPEED, SETTLE_SPEED)
) -> tuple[PlanarSummary, float, Log]:
    """One body through the engine: what became of it, its slip at the end, and its log.

    The thresholds at which Zeno sequences end are given.
    """
    table = case.model.tabulate([case.body], np.array([case.support.tilt]))
    row = table.bodies[0].copy()
    row[BODY.bounce_speed], row[BODY.settle_speed] = ends
    parts = int(substeps(table.blocks, case.motion)[0])
    shaking = refined(case.motion, parts)
    trace = Trace(*np.empty((8, ROOM)))
    log = Log(*np.empty((2, ROOM)), *np.empty((2, ROOM), np.int8))
    summary = np.empty(len(PlanarSummary._fields))
    move_one(shaking, row, 0.0, Scratch(trace, log, np.zeros((ROWS, TERMS))), summary)
    end = PlanarSummary(*summary.tolist())
    return end, float(trace.slip[int(end.samples) - 1]), log


def shaken(rng: np.random.Generator, case: Case) -> Case:
    """The case under two seconds of noise instead of its pulse: more phases."""
    noise = rng.normal(size=(2, 201)) * np.array([[0.6], [0.7 * rng.integers(2)]]) * G
    return case._replace(motion=Motion(noise[0], 0.01, vertical=noise[1]))


def test_transitions_are_those_of_the_table() -> None:
    rng = np.random.default_rng(11)
    seen: dict[tuple[Phase, Guard], set[Phase]] = {}
    for k in range(600):
        case = random_pulse(rng, kinetic=True)
        if k % 2:
            case = shaken(rng, case)
        end, _, log = run(case)
        assert int(end.ending) != Ending.UNRESOLVED
        changes = min(int(end.changes), ROOM)
        for n in range(1, changes):
            before, after = Phase(log.phases[n - 1]), Phase(log.phases[n])
            guard = list(TABLE[before])[log.guards[n]]
            assert after in TABLE[before][guard], f"{before.name} -{guard.name}-> {after.name}"
            seen.setdefault((before, guard), set()).add(after)
    assert {phase for phase, _ in seen} == set(Phase)
    # what a jam needs is steeper than these bodies and frictions have
    rows = {(phase, guard) for phase in Phase for guard in TABLE[phase]}
    assert {guard for _, guard in rows - set(seen)} <= {Guard.JAM}


def test_a_corner_that_jams_is_stopped_by_an_impulse() -> None:
    # A corner drags uphill, the body tips on, and the denominator of Boroschek and Iruretagoyena
    # (2006) eq. 9 goes to zero (Painlevé). The time-stepping knows nothing of it: its impulses are
    # finite anyway.
    one = np.ones(101)
    motion = Motion(-2.26 * G * one, 0.002, vertical=-0.98 * G * one)
    case = Case(block(1.0, 3.0), motion, Support(), General(static_friction=2.2))
    end, slip, log = run(case)
    assert log.phases[0] == Phase.SLIDE_ROCK_RIGHT_UPHILL
    assert list(TABLE[Phase.SLIDE_ROCK_RIGHT_UPHILL])[log.guards[1]] is Guard.JAM
    assert log.phases[1] == Phase.FLIGHT  # the impulse throws it into the air
    expected = time_stepping(case, end=3.0)
    assert end.direction == expected.outcome == 0
    assert end.peak == pytest.approx(expected.peak, rel=0.02)
    assert end.lift == pytest.approx(expected.lift, rel=0.02)
    assert slip == pytest.approx(expected.slip, rel=0.02)


def test_verdicts_do_not_hang_on_the_ends_of_sequences() -> None:
    # bounces and rocking while sliding are followed ten times longer, and ten times less
    rng = np.random.default_rng(12)
    ends = np.array([BOUNCE_SPEED, SETTLE_SPEED])
    counts = np.zeros(3)
    for _ in range(200):
        case = random_pulse(rng, kinetic=True)
        runs = [run(case, tuple(factor * ends))[:2] for factor in (1.0, 0.1, 10.0)]
        counts += [end.impacts for end, _ in runs]
        (usual, usual_slip), *others = runs
        for other, slip in others:
            assert other.direction == usual.direction
            # a landing at 1e-3 m/s that does not bounce lifts nothing by 5e-8 m; what it changes
            # of the speeds, 1e-3 of some m/s, peaks and slips later on feel by a tenth of that
            assert other.peak == pytest.approx(usual.peak, abs=1e-4)
            assert other.lift == pytest.approx(usual.lift, abs=1e-5)
            if not other.direction:
                assert slip == pytest.approx(usual_slip, rel=1e-3, abs=1e-4)
    assert counts[1] > 1.2 * counts[0]
    assert counts[0] > 1.2 * counts[2]


def test_codes_say_what_the_names_say() -> None:
    contacts = {"RIGHT": codes.RIGHT, "LEFT": codes.LEFT}
    for phase in Phase:
        words = phase.name.split("_")
        contact = next((contacts[word] for word in words if word in contacts), codes.BOTH)
        contact = codes.NO_CONTACT if phase is Phase.FLIGHT else contact
        slip = {"UPHILL": 1.0, "DOWNHILL": -1.0}.get(words[-1], 0.0)
        assert codes.contact_of(int(phase)) == contact
        assert codes.slip_of(int(phase)) == slip
        assert codes.phase_of(contact, slip) == phase
        for place, guard in enumerate(TABLE[phase]):
            assert codes.guard_at(int(phase), place) == guard
            assert codes.is_landing(int(phase), place) == (
                guard in (Guard.GAP_RIGHT, Guard.GAP_LEFT, Guard.LANDING)
            )


def test_the_table_names_every_phase_and_guard() -> None:
    assert set(TABLE) == set(Phase)
    assert {guard for row in TABLE.values() for guard in row} == set(Guard)
    for phase, row in TABLE.items():
        for guard, successors in row.items():
            assert successors, f"{phase.name} {guard.name} leads nowhere"


def test_a_run_names_its_phases() -> None:
    case = random_pulse(np.random.default_rng(3))
    response = case.run()
    assert response.phase_times[0] == 0.0
    assert (np.diff(response.phase_times) >= 0.0).all()
    assert len(response.phases) == response.phase_times.size
