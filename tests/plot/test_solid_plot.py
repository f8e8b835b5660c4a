"""Pictures, films and scenes of a solid's run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from shaketable import (
    General,
    InputError,
    Motion,
    Outcome,
    Solid,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
)
from shaketable.drawing.perspective import camera_at, shadows, visible
from shaketable.drawing.solid_film import _draw_plate, _told
from shaketable.drawing.solid_frames import planes_of, poses_of, pulls_of, tilting
from shaketable.drawing.solid_mesh import prisms_of
from shaketable.solid_response import SolidResponse


@pytest.fixture(scope="module")
def fall() -> SolidResponse:
    pulse = np.r_[np.zeros(20), np.full(60, 4.0), np.zeros(100)]
    motion = Motion(pulse, 0.01, transverse=-pulse, vertical=pulse / 4, name="pulse")
    support = Support(tilt=0.05, azimuth=1.0)
    solid = Solid.box(0.2, 0.3, 1.0, name="shelf")
    run = simulate(solid, motion, support, model=General(static_friction=0.6), orientation=0.3)
    assert run.outcome is not Outcome.STANDING
    return run


@pytest.fixture(scope="module")
def held() -> SolidResponse:
    """A shelf whose first strap breaks and whose second holds it."""
    pulse = np.r_[np.full(50, 5.0), np.zeros(100)]
    shelf = Solid.box(0.32, 0.8, 1.8, mass=100.0, name="shelf")
    straps = tuple(
        Strap(
            point=(-0.16, y, 1.8),
            anchor=(-0.46, y, 1.8),
            stiffness=50e3,
            damping=2e3,
            strength=strength,
        )
        for y, strength in ((-0.2, 60.0), (0.2, math.inf))
    )
    run = simulate(
        shelf,
        Motion(-pulse, 0.01, transverse=np.zeros(150)),
        model=General(static_friction=0.6),
        surroundings=Surroundings(straps=straps),
    )
    assert run.outcome is Outcome.STANDING
    return run


def test_the_plot_has_labels_and_units(fall: SolidResponse) -> None:
    above, middle, below = fall.plot()
    assert "[°]" in above.get_ylabel()
    assert "[mm]" in middle.get_ylabel()
    assert "[g]" in below.get_ylabel()
    assert below.get_xlabel() == "time [s]"
    toward = f"overturns toward {math.degrees(fall.fall_azimuth):.0f}°"
    assert f"shelf on pulse, tilt 2.86° toward 57.3°: {toward}" in above.get_title()
    assert above.lines[0].get_ydata() == pytest.approx(np.degrees(fall.nutation))
    assert [line.get_label() for line in below.lines] == ["along x", "along y", "vertical"]
    words = " ".join(text.get_text() for text in above.texts)
    assert f"toward {math.degrees(fall.fall_azimuth):.0f}°" in words
    assert "<img" in fall._repr_html_()


def test_the_plot_shows_the_forces_of_straps(held: SolidResponse, fall: SolidResponse) -> None:
    forces = held.plot()[0].figure.axes[2]
    assert forces.get_ylabel() == "strap [N]"
    names = [line.get_label() for line in forces.lines]
    assert names == ["strap 1", "strap 1 breaks", "strap 2"]
    assert forces.lines[0].get_ydata() == pytest.approx(held.strap_forces[:, 0])
    assert forces.lines[1].get_xdata()[0] == held.strap_broke_at[0]
    assert forces.lines[2].get_ydata() == pytest.approx(held.strap_forces[:, 1])
    assert len(fall.plot()[0].figure.axes) == 3  # none without straps


def test_every_moment_of_the_fall_has_a_band(fall: SolidResponse) -> None:
    """From when it leaves its base on it rolls, rocks, slips or flies."""
    above, _, _ = fall.plot()
    spans = np.vstack(
        [path.get_extents().intervalx for band in above.collections for path in band.get_paths()]
    )
    covered = sum(np.diff(spans, axis=1).ravel())
    begins = fall.time[next(k for k, each in enumerate(fall.contact) if each.name != "BASE")]
    assert covered == pytest.approx(fall.time[-1] - begins, abs=0.02)


def test_a_jump_is_a_flight() -> None:
    """Thrown up by the support it touches nothing; that is no slip."""
    up = np.r_[np.full(20, 15.0), np.full(20, -30.0), np.zeros(60)]
    still = np.zeros(100)
    run = simulate(Solid.box(0.3, 0.3, 0.6), Motion(still, 0.01, vertical=up, transverse=still))
    above, _, _ = run.plot()
    assert run.max_lift > 0.01
    assert [band.get_label() for band in above.collections] == ["in flight"]


def test_meshes_are_closed_and_point_outward() -> None:
    """By Gauss' theorem the faces enclose the volume of the prism."""
    triangle = [[0.3, 0.0], [-0.1, 0.2], [-0.1, -0.2]]
    feet = [[0.2, 0.1], [-0.2, 0.1], [-0.2, -0.1], [0.2, -0.1]]
    for solid, volume in (
        (Solid.box(0.2, 0.3, 1.0), 0.06),
        (Solid.polygon(triangle, 0.5), 0.08 * 0.5),
        (Solid.cylinder(0.2, 1.0), math.pi * 0.01),
        (Solid.on_feet(feet, 1.0), 0.08 * 0.92 + 4 * 0.016**2 * 0.08),
    ):
        found = 0.0
        for part in prisms_of(solid):
            for face in part.faces:
                corners = part.vertices[face]
                for k in range(1, len(corners) - 1):
                    found += corners[0] @ np.cross(corners[k], corners[k + 1]) / 6
        assert found == pytest.approx(volume, rel=3e-3)  # 48 corners lack 0.3 % of a circle


def test_poses_follow_the_run(fall: SolidResponse) -> None:
    poses = poses_of(fall, 25, 750, 10)
    assert np.diff(poses.time) == pytest.approx(0.04)
    assert poses.position[-1] == pytest.approx(fall.position[-1])
    assert np.abs(poses.quaternions[-1] @ fall.quaternions[-1]) == pytest.approx(1.0)
    assert ((poses.quaternions[1:] * poses.quaternions[:-1]).sum(axis=1) > 0.0).all()
    k = np.searchsorted(fall.time, 0.6)
    near = np.abs(poses.time - fall.time[k]).argmin()
    assert poses.position[near] == pytest.approx(fall.position[k], abs=0.03)


def test_the_plate_leans_downhill() -> None:
    """Downhill on the support is down in the world."""
    support = Support(tilt=0.2, azimuth=1.0)
    downhill = tilting(support) @ [math.cos(1.0), math.sin(1.0), 0.0]
    assert downhill[2] == pytest.approx(-math.sin(0.2))


def test_the_eye_sees_what_faces_it() -> None:
    """Of a box in the middle three faces; all of the body is in the picture, above its shadow."""
    (part,) = prisms_of(Solid.box(0.4, 0.4, 0.8))
    camera = camera_at(np.array([0.0, 0.0, 0.3]), 1.0)
    upright, flat = np.eye(3), np.eye(3)
    seen = visible([part], np.array([0.0, 0.0, 0.4]), upright, flat, camera)
    assert len(seen) == 3
    lowest = min(face.outline[:, 1].min() for face in seen)
    (shadow,) = shadows([part], np.array([0.0, 0.0, 0.4]), upright, flat)
    assert shadow[:, 2] == pytest.approx(0.0)
    assert camera.project(shadow)[:, 1].min() == pytest.approx(lowest)  # they meet at the base
    # what is higher is higher in the picture, and what is farther is smaller
    up, far = camera.project(np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 0.3]]))
    assert up[1] > far[1]


def test_the_whole_way_is_in_the_picture(fall: SolidResponse) -> None:
    from matplotlib.figure import Figure

    poses = poses_of(fall, 25, 750, 10)
    scene = Figure().subplots()
    plate = tilting(fall.support)
    parts = prisms_of(fall.body)
    camera = _draw_plate(fall, parts, poses, plate, scene)
    turns = Rotation.from_quat(poses.quaternions).as_matrix()
    for position, turn in zip(poses.position, turns, strict=True):
        for face in visible(parts, position, turn, plate, camera):
            for low, high, values in (
                (*scene.get_xlim(), face.outline[:, 0]),
                (*scene.get_ylim(), face.outline[:, 1]),
            ):
                assert low <= values.min()
                assert values.max() <= high


def test_a_film_moves(fall: SolidResponse, tmp_path: Path) -> None:
    path = fall.animate(tmp_path / "fall.gif")
    with Image.open(path) as film:
        assert film.n_frames == len(poses_of(fall, 25, 750, 10).time)
        first = np.asarray(film.convert("RGB")).astype(int)
        film.seek(film.n_frames - 1)
        last = np.asarray(film.convert("RGB")).astype(int)
    changed = np.abs(first - last).max(axis=2) > 60
    assert 0.01 < changed.mean() < 0.4


def test_a_scene_holds_the_run(fall: SolidResponse, tmp_path: Path) -> None:
    """The level frame is y upward in glTF; the solid's way there is that of the response."""
    gltf = pytest.importorskip("pygltflib", reason="the extra gltf is not installed")
    made = gltf.GLTF2().load(str(fall.animate(tmp_path / "fall.glb")))
    assert [node.name for node in made.nodes] == ["level ground", "support", "shelf"]
    data = made.binary_blob()

    def values(number: int) -> np.ndarray:
        accessor = made.accessors[number]
        view = made.bufferViews[accessor.bufferView]
        part = data[view.byteOffset : view.byteOffset + view.byteLength]
        return np.frombuffer(part, np.float32).reshape(accessor.count, -1)

    (animation,) = made.animations
    time, position, turn = (
        values(animation.samplers[0].input),
        *(values(sampler.output) for sampler in animation.samplers),
    )
    assert np.diff(time[:, 0]) == pytest.approx(1 / 60, abs=1e-5)
    assert position[-1] == pytest.approx(fall.position[-1], abs=1e-6)
    assert abs(turn[-1] @ fall.quaternions[-1]) == pytest.approx(1.0, abs=1e-6)
    normal = Rotation.from_quat(made.nodes[0].rotation).apply([0.0, 0.0, 1.0])
    assert normal == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)
    corners = values(made.meshes[made.nodes[2].mesh].primitives[0].attributes.POSITION)
    assert corners.max(axis=0) == pytest.approx([0.1, 0.15, 0.5])
    assert len(corners) == 3 * 12  # triangles of a box


def test_straps_are_in_the_film(held: SolidResponse, tmp_path: Path) -> None:
    """Each goes from its point of the body to its anchor, and is gone when it broke."""
    poses = poses_of(held, 25, 750, 10)
    weak, firm = pulls_of(held, poses)
    assert weak.point[0] == pytest.approx([-0.16, -0.2, 1.8])
    assert weak.anchor == pytest.approx([-0.46, -0.2, 1.8])
    assert weak.whole.sum() == (poses.time < held.strap_broke_at[0]).sum() < len(poses.time)
    assert firm.whole.all()
    assert firm.force == pytest.approx(np.interp(poses.time, held.time, held.strap_forces[:, 1]))
    taut = firm.force.argmax()
    assert np.linalg.norm(firm.point[taut] - firm.anchor) > 0.3
    assert _told([weak, firm], taut) == f"   straps broken, {firm.force[taut]:,.0f} N"
    assert _told([firm], taut) == f"   strap {firm.force[taut]:,.0f} N"
    with Image.open(held.animate(tmp_path / "held.gif")) as film:
        reds = []
        for number in (0, int(taut)):
            film.seek(number)
            red, green, blue = np.moveaxis(np.asarray(film.convert("RGB")).astype(int), 2, 0)
            reds.append(((red > 180) & (green < 90) & (blue < 90)).sum())
    assert reds[1] > reds[0] + 20  # the strap that bears is red; the time's mark is too


def test_straps_are_in_the_scene(held: SolidResponse, tmp_path: Path) -> None:
    """A bar of one metre along z becomes the way from the anchor to the point of the body."""
    gltf = pytest.importorskip("pygltflib", reason="the extra gltf is not installed")
    made = gltf.GLTF2().load(str(held.animate(tmp_path / "held.glb")))
    assert [node.name for node in made.nodes[2:]] == ["shelf", "strap 1", "strap 2"]
    assert made.nodes[1].children == [2, 3, 4]
    data = made.binary_blob()
    pulls = pulls_of(held, poses_of(held, 60, 36_000, 1.0))
    (animation,) = made.animations
    for number, pull in enumerate(pulls, 3):
        assert made.nodes[number].translation == pytest.approx(pull.anchor)
        ways = {}
        for channel in animation.channels:
            if channel.target.node == number:
                accessor = made.accessors[animation.samplers[channel.sampler].output]
                view = made.bufferViews[accessor.bufferView]
                part = data[view.byteOffset : view.byteOffset + view.byteLength]
                ways[channel.target.path] = np.frombuffer(part, np.float32).reshape(
                    accessor.count, -1
                )
        assert ways["scale"].any(axis=1).tolist() == pull.whole.tolist()
        along = Rotation.from_quat(ways["rotation"]).apply(ways["scale"] * [0.0, 0.0, 1.0])
        expected = np.where(pull.whole[:, None], pull.point - pull.anchor, 0.0)
        assert along == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("name", ["fall.obj", "fall"])
def test_other_endings_are_refused(fall: SolidResponse, tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"\.gif, \.glb, \.mp4"):
        fall.animate(tmp_path / name)


@pytest.mark.parametrize("vertical", [True, False])
def test_walls_stand_at_their_gap_from_the_body(vertical: bool, tmp_path: Path) -> None:
    """Of all corners at the start the nearest is a gap away; a vertical wall is so in the level."""
    quiet = Motion(np.zeros(30), 0.01, name="quiet")
    wall = Wall(azimuth=0.4, gap=0.07, vertical=vertical)
    run = simulate(
        Solid.box(0.2, 0.3, 1.0, name="shelf"), quiet, Support(tilt=0.05, azimuth=1.0),
        model=General(static_friction=0.6), orientation=0.3,
        surroundings=Surroundings(walls=(wall,)),
    )  # fmt: skip
    (plane,) = planes_of(run)
    corners = np.array([[x, y, z] for x in (-0.1, 0.1) for y in (-0.15, 0.15) for z in (-0.5, 0.5)])
    places = run.rotation[0].apply(corners) + run.position[0]
    gaps = (plane.foot - places) @ plane.axes[:, 0]
    assert gaps.min() == pytest.approx(0.07, abs=1e-12)
    assert plane.foot[2] == pytest.approx(0.0, abs=1e-12)
    assert plane.axes.T @ plane.axes == pytest.approx(np.eye(3), abs=1e-12)
    level = tilting(run.support) @ plane.axes[:, 0]
    assert bool(abs(level[2]) < 1e-12) is vertical
    film, scene = run.animate(tmp_path / "shelf.gif"), run.animate(tmp_path / "shelf.glb")
    assert film.stat().st_size > 1000
    from pygltflib import GLTF2

    names = [node.name for node in GLTF2().load_binary(str(scene)).nodes]
    assert "wall 1" in names
