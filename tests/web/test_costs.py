"""What a question costs a worker, whatever is in it."""

from __future__ import annotations

import logging
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shaketable.errors import InputError
from shaketable.records.plausible import LOUDEST
from shaketable.web import budget, limits, shaking, space, work
from shaketable.web.questions import (
    Beside,
    LookAtMotion,
    Many,
    ManyInSpace,
    Pulse,
    Shake,
    ShakeInSpace,
    Thing,
    Uploaded,
    Upright,
)
from tests.support.questions import ends_of, question

ANSWERED_BY: dict[type, Callable[..., Any]] = {
    Shake: work.shake,
    Many: work.many,
    ShakeInSpace: space.shake,
    ManyInSpace: space.many,
    LookAtMotion: shaking.look,
}
#: Seconds of a processor that a question may cost past its budget: the four runs at hand. A run
#: has some second for a usual record and five for the longest that is taken; with a margin for
#: machines half as fast as the two cores on which the limits were chosen.
PAST = 8.0


@pytest.fixture(scope="module")
def warm() -> None:
    """Compiled before it is timed."""
    thing, pulse = {"base_m": 0.3, "height_m": 1.8}, Pulse(period_s=0.5, peak_g=0.3)
    for friction in (None, 0.5):
        work.many(Many(thing=Thing(**thing, friction=friction)))
        work.shake(Shake(thing=Thing(**thing, friction=friction), shaking=pulse))
    beside = Thing(**thing, beside=Beside(wall_gap_mm=10))
    work.shake(Shake(thing=beside, shaking=pulse))
    box = Upright(depth_m=0.3, width_m=0.3, height_m=1.8)
    space.many(ManyInSpace(thing=box, scale=0.1, curve=False))
    space.shake(ShakeInSpace(thing=box, shaking=pulse))


def cost(asked: Any, seconds: float) -> tuple[float, str]:
    """Seconds of the processor, and how it ended."""
    begun = time.process_time()
    try:
        budget.answer(ANSWERED_BY[type(asked)], (asked,), {}, seconds, None)
        end = "answered"
    except budget.TooLongError:
        end = "ended"
    except InputError:
        end = "refused"
    return time.process_time() - begun, end


@pytest.mark.usefixtures("warm")
@pytest.mark.parametrize("seed", range(3))
def test_no_question_costs_more_than_it_may(seed: int, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.CRITICAL)
    costs, ends = [], set()
    for k in range(20):
        asked = question(np.random.default_rng([seed, k]))
        seconds, end = cost(asked, 0.3)
        costs.append(seconds)
        ends.add(end)
    assert max(costs) < 0.3 + PAST
    assert {"answered", "ended"} <= ends


@pytest.mark.usefixtures("warm")
@pytest.mark.parametrize(
    "sizes", [{"depth_m": 0.3, "width_m": 0.3}, {"shape": "cylinder", "base_m": 0.3}]
)
def test_the_least_friction_is_stopped(
    sizes: dict[str, object], caplog: pytest.LogCaptureFixture
) -> None:
    """It took a worker minutes where the friction was 1e-308, and over one where it was 0.1."""
    caplog.set_level(logging.CRITICAL)
    thing = Upright.model_validate({**sizes, "height_m": 1.8, "friction": limits.LEAST_FRICTION})
    seconds, end = cost(ManyInSpace(thing=thing), 1.0)
    assert end == "ended"
    assert seconds < 1.0 + PAST
    with pytest.raises(ValueError, match="friction"):
        Upright(depth_m=0.3, width_m=0.3, height_m=1.8, friction=1e-308)


@pytest.mark.usefixtures("warm")
@pytest.mark.parametrize(
    ("step", "samples", "cg_share", "eccentricity", "tilt"),
    [(0.18, 3000, 0.01, 0.61, 30.0), (0.009, 60_000, 0.27, 0.08, 0.0), (0.9, 2, 0.11, 0.99, 0.0)],
)
def test_what_is_small_and_thrown_about_ends(
    step: float, samples: int, cg_share: float, eccentricity: float, tilt: float,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    """Dice that flew or slid for an hour after their motion took 23 s and 2 GB."""
    caplog.set_level(logging.CRITICAL)
    thing = Thing(
        base_m=0.005, height_m=0.005, cg_share=cg_share, eccentricity=eccentricity, tilt_deg=tilt,
        friction=0.02,
    )  # fmt: skip
    strong = np.random.default_rng(1).uniform(-LOUDEST, LOUDEST, samples)
    strong = strong if samples > 2 else np.full(2, LOUDEST)
    asked = Shake(
        thing=thing, shaking=Uploaded(time_step_s=step, acceleration=strong.tolist()), scale=1.0
    )
    seconds, _ = cost(asked, 10.0)
    assert seconds < PAST  # some second where the limits were chosen


def test_scaled_motions_are_as_strong_as_uploaded_ones_at_most() -> None:
    uploaded = Uploaded(time_step_s=0.01, acceleration=[0.0, -60.0, 0.0])
    for kind, given in (
        (Shake, {"thing": {"base_m": 0.3, "height_m": 1.8}}),
        (ShakeInSpace, {"thing": {"depth_m": 0.3, "width_m": 0.3, "height_m": 1.8}}),
        (LookAtMotion, {}),
    ):
        kind(**given, shaking=uploaded, scale=16.0)  # type: ignore[arg-type]
        with pytest.raises(ValueError, match=r"the motion would reach 104 g; at most 100 g"):
            kind(**given, shaking=uploaded, scale=17.0)  # type: ignore[arg-type]


def test_too_many_steps_are_refused() -> None:
    """Eccentric and low: 2,200 rad/s at 100 g, of which a step takes a tenth of a radian."""
    thing = Thing(base_m=0.02, height_m=0.005, cg_share=0.01, eccentricity=0.99)
    asked = Uploaded(time_step_s=0.01, acceleration=[LOUDEST] * limits.MOST_SAMPLES)
    with pytest.raises(InputError, match=r"takes [\d,]+ steps .* at most 1,000,000"):
        work.shake(Shake(thing=thing, shaking=asked))


def test_needles_and_too_much_friction_are_refused() -> None:
    pulse = Pulse(period_s=0.5, peak_g=0.3)
    needle = Upright(depth_m=0.005, width_m=0.005, height_m=1.1)
    with pytest.raises(InputError, match="at most 200 times"):
        space.shake(ShakeInSpace(thing=needle, shaking=pulse))
    stuck = Upright(depth_m=0.2, width_m=0.2, height_m=1.0, rolling_friction_mm=50.0)
    with pytest.raises(InputError, match=r"at most 0\.2 of the base, 40 mm"):
        space.shake(ShakeInSpace(thing=stuck, shaking=pulse))
    sheet = Thing(base_m=10.0, height_m=0.04)
    with pytest.raises(InputError, match="at most 200 times"):
        work.shake(Shake(thing=sheet, shaking=pulse))


def test_the_page_offers_what_is_taken() -> None:
    """Its fields end where those of the questions do."""
    text = (Path(work.__file__).parent / "static" / "state.js").read_text(encoding="utf-8")
    offered = {
        name: (float(least), float(most))
        for name, least, most in re.findall(r"(\w+): \{ least: ([-\d.]+), most: ([\d.]+)", text)
    }
    asked = {**Thing.model_fields, **Upright.model_fields, **Beside.model_fields}
    taken = {name: ends_of(asked[name]) for name in offered if name in asked}
    assert len(taken) >= 14
    assert {name: offered[name] for name in taken} == taken
