"""Pictures of one run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from shaketable import Body, InputError, Motion, Outcome, Response, Support, simulate
from shaketable.plot import _corners, _frames


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
    assert rotation == pytest.approx(np.degrees(fall.rotation))
    vertical = below.lines[1].get_ydata()
    assert vertical == pytest.approx(fall.motion.vertical / 9.80665)


def test_plot_draws_where_it_is_told(fall: Response) -> None:
    axes = Figure().subplots(2, 1)
    assert fall.plot(tuple(axes)) == tuple(axes)


def test_corners_stay_where_the_pivot_is(fall: Response) -> None:
    tilt, body = fall.support.tilt, fall.body
    for theta, corner, pivot in ((0.2, 1, body.right), (-0.2, 0, -body.left)):
        x, y = _corners(fall, theta)[corner]
        assert (x, y) == pytest.approx((pivot * math.cos(tilt), pivot * math.sin(tilt)))
    # clockwise is toward +x: a body that leans right has its top to the right
    top = _corners(fall, 0.2)[2:].mean(axis=0)
    assert top[0] > _corners(fall, 0.0)[2:].mean(axis=0)[0]


def test_film(fall: Response, tmp_path: Path) -> None:
    path = fall.animate(tmp_path / "fall.gif")
    with Image.open(path) as film:
        times, angles = _frames(fall)
        assert film.n_frames == times.size
    assert angles[-1] == pytest.approx(-math.pi / 2)
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
