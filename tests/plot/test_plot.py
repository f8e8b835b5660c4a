"""Pictures of one run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from PIL import Image

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Outcome,
    Phase,
    Response,
    Support,
    simulate,
)
from shaketable.drawing.film import _frames, _outline
from shaketable.drawing.history import BANDS, HATCHES


@pytest.fixture(scope="module")
def fall() -> Response:
    pulse = np.r_[np.zeros(20), np.full(60, 4.0), np.zeros(100)]
    motion = Motion(pulse, 0.01, vertical=pulse / 4, name="pulse")
    run = simulate(Body.rectangle(0.2, 1.0, name="shelf"), motion, Support(tilt=0.05))
    assert run.outcome is Outcome.DOWNHILL
    return run


def test_plot_labels_and_units(fall: Response) -> None:
    above, below = fall.plot()
    assert "[°]" in above.get_ylabel()
    assert "[g]" in below.get_ylabel()
    assert below.get_xlabel() == "time [s]"
    assert "shelf" in above.get_title()
    assert "downhill" in above.get_title()
    rotation = above.lines[0].get_ydata()
    assert rotation[:-1] == pytest.approx(np.degrees(fall.rotation))
    # a fall is seen to its end, toward -x
    assert rotation[-1] == -90.0
    assert above.lines[0].get_xdata()[-1] == fall.overturning_time
    assert above.get_ylim()[0] < -90.0
    vertical = below.lines[1].get_ydata()
    assert vertical == pytest.approx(fall.motion.vertical / 9.80665)


def test_on_a_level_support_nothing_is_downhill(fall: Response) -> None:
    level = simulate(fall.body, fall.motion.scaled(2.0))
    above, _ = level.plot()
    words = above.get_title() + " ".join(line.get_label() for line in above.lines)
    assert "hill" not in words
    assert "left (-x)" in words


def test_legends_stand_beside_the_data(fall: Response, slide: Response) -> None:
    for response in (fall, slide):
        above, _ = response.plot()
        above.get_figure().draw_without_rendering()
        legend, data = above.get_legend().get_window_extent(), above.get_window_extent()
        assert legend.x0 > data.x1


def test_phases_are_told_apart_in_grey() -> None:
    greys = sorted(sum(to_rgb(colour)[k] * part for k, part in enumerate((0.299, 0.587, 0.114)))
                   for _, colour in BANDS.values())  # fmt: skip
    hatches = set(HATCHES.values())
    assert min(np.diff(greys)) > 0.03  # some 8 of 256 greys, beside the hatches
    assert len(hatches) == len(BANDS)


def test_plot_draws_where_it_is_told(fall: Response) -> None:
    axes = Figure().subplots(2, 1)
    assert fall.plot(tuple(axes)) == tuple(axes)


def test_corners_stay_where_the_pivot_is(fall: Response) -> None:
    tilt, body = fall.support.tilt, fall.body
    leaning = int(np.argmin(fall.rotation))
    pose = np.r_[fall.position[leaning], fall.rotation[leaning]]
    x, y = _outline(fall, pose)[0]
    pivot = (-body.left * math.cos(tilt), -body.left * math.sin(tilt))
    assert (x, y) == pytest.approx(pivot, abs=1e-12)
    # clockwise is toward +x: a body that leans left has its top to the left
    upright = np.array([0.0, body.cg_height, 0.0])
    assert _outline(fall, pose)[2:].mean(axis=0)[0] < _outline(fall, upright)[2:].mean(axis=0)[0]


@pytest.fixture(scope="module")
def slide() -> Response:
    pulse = np.r_[np.zeros(20), np.full(40, 6.0), np.zeros(100)]
    motion = Motion(pulse, 0.01, vertical=-2.5 * pulse, name="pulse")
    run = simulate(Body.rectangle(0.3, 0.7), motion, model=General(static_friction=0.4))
    assert run.peak_slip > 0.1
    assert run.max_lift > 0.01
    return run


def test_bands_are_the_phases(slide: Response) -> None:
    above, _ = slide.plot()
    bands = {bar.get_label(): bar for bar in above.collections}
    kinds = {phase.name.split("_")[0] for phase in slide.phases}
    assert ("flight" in bands) == ("FLIGHT" in kinds)
    lengths = np.diff(np.append(slide.phase_times, slide.time[-1]))
    flying = sum(d for d, p in zip(lengths, slide.phases, strict=True) if p is Phase.FLIGHT)
    drawn = sum(np.ptp(path.vertices[:, 0]) for path in bands["flight"].get_paths())
    assert drawn == pytest.approx(flying)
    beside = above.get_figure().axes[-1]
    assert "slip [mm]" in beside.get_ylabel()
    assert beside.lines[0].get_ydata() == pytest.approx(1e3 * slide.slip)


def test_a_film_shows_sliding_and_jumping(slide: Response, tmp_path: Path) -> None:
    times, poses = _frames(slide)
    assert poses[-1, 0] == pytest.approx(slide.position[-1, 0], abs=1e-3)
    assert poses[:, 1].max() > slide.body.cg_height + 0.8 * slide.max_lift
    with Image.open(slide.animate(tmp_path / "slide.gif")) as film:
        assert film.n_frames == times.size


def test_film(fall: Response, tmp_path: Path) -> None:
    path = fall.animate(tmp_path / "fall.gif")
    with Image.open(path) as film:
        times, poses = _frames(fall)
        assert film.n_frames == times.size
    assert poses[-1, 2] == pytest.approx(-math.pi / 2)
    assert times[0] < 0.2 < times[1] + 0.2


@pytest.mark.parametrize("name", ["fall.avi", "fall"])
def test_film_formats(fall: Response, tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"\.gif, \.mp4"):
        fall.animate(tmp_path / name)


def test_mp4_needs_ffmpeg(fall: Response, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from matplotlib.animation import FFMpegWriter

    monkeypatch.setattr(FFMpegWriter, "isAvailable", lambda: False)
    with pytest.raises(InputError, match="ffmpeg"):
        fall.animate(tmp_path / "fall.mp4")
