"""`shaketable simulate` in three dimensions."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    Solid,
    Strap,
    Support,
    Surroundings,
    Wall,
    read_motion,
    simulate,
)
from tests.support.command import refused, shaketable
from tests.support.record_files import write_at2

SIZE = ("--base-m", 0.3, "--height-m", 1.2)
BOX = ("--depth-m", 0.3, "--width-m", 0.5, "--height-m", 1.2)


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """East, north and up beside one another; returns the eastern one."""
    folder = tmp_path_factory.mktemp("records")
    t = 0.01 * np.arange(200)
    for name, code, size, rate in (
        ("E", "090", 0.6, 7.0),
        ("N", "000", 0.5, 5.0),
        ("UP", "UP", 0.1, 9),
    ):
        write_at2(folder, f"RSN1_A-{name}.AT2", code, size * np.sin(rate * t))
    return folder / "RSN1_A-E.AT2"


def test_it_is_what_simulate_gives(record: Path) -> None:
    run = shaketable(
        "simulate", *BOX, "--record", record, "--tilt-deg", 2, "--azimuth-deg",
        30, "--orientation-deg", 10, "--static-friction", 0.5, "--components", 3, "--json",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    known = simulate(
        Solid.box(0.3, 0.5, 1.2),
        read_motion(record, components=3),
        Support(tilt=np.radians(2.0), azimuth=np.radians(30.0)),
        model=General(static_friction=0.5),
        orientation=np.radians(10.0),
    )
    told = json.loads(run.stdout)
    assert told["outcome"] == known.outcome.name.lower()
    assert told["peak_rotation_rad"] == known.peak_rotation
    assert [told["displacement_x_m"], told["displacement_y_m"]] == [
        known.displacement_x,
        known.displacement_y,
    ]
    assert told["pivot_contacts_m"] == known.body.contacts[list(known.pivot_contacts)].tolist()


@pytest.mark.parametrize(
    ("option", "field"),
    [
        ("--rolling-friction-m", "rolling_friction"),
        ("--contour-friction-m", "contour_friction"),
        ("--drilling-friction-m", "drilling_friction"),
    ],
)
def test_losses_are_those_of_the_solid(record: Path, option: str, field: str) -> None:
    run = shaketable(
        "simulate", *SIZE, "--shape", "cylinder", "--record", record, option, 0.003, "--json",
        "--static-friction", 0.4,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    model, motion = General(static_friction=0.4), read_motion(record, components=2)
    known, without = (
        simulate(solid, motion, model=model)
        for solid in (Solid.cylinder(0.3, 1.2, **{field: 0.003}), Solid.cylinder(0.3, 1.2))
    )
    told = json.loads(run.stdout)
    assert told["peak_rotation_rad"] == known.peak_rotation
    assert told["yaw_rad"] == known.yaw != without.yaw


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((*SIZE, "--rolling-friction-m", 0.001), "only in three dimensions"),
        ((*BOX, "--contour-friction-m", 0.001), "--shape cylinder"),
        ((*BOX, "--drilling-friction-m", -1), "must be 0 or more"),
    ],
)
def test_losses_that_do_not_go_together(record: Path, given: tuple[object, ...], said: str) -> None:
    assert said in refused("simulate", "--record", record, *given)


def test_a_cylinder_in_words_and_pictures(record: Path, tmp_path: Path) -> None:
    run = shaketable(
        "simulate", *SIZE, "--shape", "cylinder", "--record", record, "--scale", 1.5,
        "--plot", tmp_path / "a.png", "--animate", tmp_path / "a.gif",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    said = "cylinder 0.3 m × 1.2 m under RSN1_A-E: overturns toward "
    assert run.stdout.startswith(said)
    assert (tmp_path / "a.png").stat().st_size > 10_000
    assert (tmp_path / "a.gif").stat().st_size > 10_000
    standing = shaketable(
        "simulate", *SIZE, "--shape", "cylinder", "--record", record, "--scale", 0.01
    )
    assert "stands; it does not lean" in standing.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (BOX[:2] + SIZE[2:], "--depth-m: a box has --depth-m and --width-m; in a plane"),
        (BOX[2:], "--width-m: a box has --depth-m and --width-m; in a plane the one size"),
        (SIZE[2:], "give --base-m, its size along the shaking; or --depth-m and --width-m"),
        (SIZE[:2] + BOX, "--base-m: a box has --depth-m and --width-m"),
        (("--shape", "cylinder", *SIZE[2:]), "--shape cylinder: the one size of a cylinder"),
        ((*SIZE, "--shape", "box"), "--shape box: a box has --depth-m and --width-m"),
        (
            (*BOX, "--shape", "cylinder"),
            "--depth-m and --width-m: the one size of a cylinder's base is its diameter, --base-m",
        ),
        ((*SIZE, "--shape", "cylinder", "--eccentricity", 0.4), "must be 0.5"),
        ((*SIZE, "--azimuth-deg", 30), "--azimuth-deg: only in three dimensions"),
        ((*BOX, "--model", "rocking"), "knows one edge"),
        ((*BOX[:2], "--width-m", -1, *BOX[4:]), "size_y [m]"),
        ((*BOX, "--components", 5), "must be 1, 2 or 3"),
        ((*BOX, "--tilt-deg", 20), "falls by itself"),
        ((*BOX, "--animate", "a.obj"), ".gif, .glb, .mp4"),
    ],
)
def test_what_cannot_be(record: Path, arguments: tuple[object, ...], said: str) -> None:
    assert said in refused("simulate", "--record", record, *arguments)


def test_a_record_that_is_alone(record: Path, tmp_path: Path) -> None:
    alone = write_at2(tmp_path, "alone.AT2", "090", np.ones(10))
    said = refused("simulate", *BOX, "--record", alone)
    assert "take one component alone" in said
    run = shaketable("simulate", *BOX, "--record", alone, "--components", 1, "--scale", 0.01)
    assert "stands" in run.stdout


HELD = (*BOX, "--static-friction", 0.5, "--mass-kg", 80)


def test_straps_are_those_of_python(record: Path) -> None:
    """At the top and lower on the side toward +x; lengths, forces and stiffness in their units."""
    run = shaketable(
        "simulate", *HELD, "--record", record, "--json",
        "--strap", "top:slack=5mm,stiffness=20kN/m,damping=1kNs/m,strength=0.9kN",
        "--strap", "80cm:stiffness=15N/mm,pretension=20N,anchor=0.4m/0m/0.9m",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    straps = (
        Strap(point=(0.15, 0, 1.2), anchor=(0.2, 0, 1.2), stiffness=20e3, slack=0.005,
              damping=1e3, strength=900.0),
        Strap(point=(0.15, 0, 0.8), anchor=(0.4, 0, 0.9), stiffness=15e3, pretension=20.0),
    )  # fmt: skip
    known = simulate(
        Solid.box(0.3, 0.5, 1.2, mass=80.0),
        read_motion(record, components=2),
        model=General(static_friction=0.5),
        surroundings=Surroundings(straps=straps),
    )
    told = json.loads(run.stdout)
    assert told["strap_force_n"] == list(known.strap_force)
    assert told["held_up"] == known.held_up
    assert [each is None for each in told["strap_broke_at_s"]] == [
        np.isnan(each) for each in known.strap_broke_at
    ]


def test_a_wall_is_that_of_python(record: Path) -> None:
    """Behind the side toward +x; the strap ends on it."""
    run = shaketable(
        "simulate", *HELD, "--record", record, "--json", "--wall-gap-mm", 4,
        "--wall-friction", 0.2, "--wall-restitution", 0.6, "--strap", "top:stiffness=20kN/m",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    wall = Wall(gap=0.004, friction=0.2, restitution=0.6)
    strap = Strap(point=(0.15, 0, 1.2), anchor=(0.154, 0, 1.2), stiffness=20e3)
    known = simulate(
        Solid.box(0.3, 0.5, 1.2, mass=80.0),
        read_motion(record, components=2),
        model=General(static_friction=0.5),
        surroundings=Surroundings(walls=(wall,), straps=(strap,)),
    )
    told = json.loads(run.stdout)
    assert known.impacts > 0
    assert told["impacts"] == known.impacts
    assert told["strap_force_n"] == list(known.strap_force)
    assert told["held_up"] == known.held_up


def test_a_planar_body_stands_against_its_wall(record: Path) -> None:
    run = shaketable("simulate", *SIZE, "--record", record, "--json", "--tilt-deg", 2,
                     "--wall-gap-mm", 0, "--wall-restitution", 0.5)  # fmt: skip
    assert run.returncode == 0, run.stderr
    wall = Wall(vertical=False, restitution=0.5)
    known = simulate(
        Body.rectangle(0.3, 1.2), read_motion(record), Support(tilt=math.radians(2)),
        surroundings=Surroundings(walls=(wall,)),
    )  # fmt: skip
    told = json.loads(run.stdout)
    assert told["peak_rotation_rad"] == known.peak_rotation
    assert told["impacts"] == known.impacts
    for given, says in (
        (("--wall-gap-mm", 5), "without a gap, got 0.005 m"),
        (
            ("--wall-restitution", 0.5),
            "--wall-restitution: friction or restitution of a wall without its gap",
        ),
        (("--wall-friction", 0.5), "--wall-friction: friction or restitution of a wall without"),
        (("--strap", "top:stiffness=1kN/m", "--mass-kg", 50), "one wall and nothing else beside"),
        (("--lip-mm", 5), "--lip-mm: a lip without an edge"),
        (("--pad-n", 5), "--pad-n: newtons need a mass; give --mass-kg"),
    ):
        wrong = shaketable("simulate", *SIZE, "--record", record, *given)
        assert wrong.returncode == 2
        assert says in " ".join(wrong.stderr.split())


def test_what_straps_did_is_said(record: Path) -> None:
    held = shaketable("simulate", *HELD, "--record", record,
                      "--strap", "top:stiffness=20kN/m")  # fmt: skip
    assert "its strap bears up to" in held.stdout
    assert "of the weight" in held.stdout
    weak = shaketable("simulate", *HELD, "--record", record,
                      "--strap", "top:stiffness=20kN/m,strength=100N")  # fmt: skip
    assert "its strap breaks at" in weak.stdout
    assert "under 100 N" in weak.stdout


def test_a_strap_goes_straight_behind_a_turned_box(record: Path) -> None:
    """The wall is behind the object, however that is turned on its support."""
    turned = shaketable("simulate", *HELD, "--orientation-deg", 30, "--record", record,
                        "--json", "--strap", "top:stiffness=20kN/m")  # fmt: skip
    behind = (0.2 * math.cos(math.pi / 6), 0.2 * math.sin(math.pi / 6), 1.2)
    known = simulate(
        Solid.box(0.3, 0.5, 1.2, mass=80.0),
        read_motion(record, components=2),
        model=General(static_friction=0.5),
        orientation=math.pi / 6,
        surroundings=Surroundings(
            straps=(Strap(point=(0.15, 0, 1.2), anchor=behind, stiffness=20e3),)
        ),
    )
    assert known.strap_force[0] > 0.0
    told = json.loads(turned.stdout)["strap_force_n"]
    assert told == pytest.approx(list(known.strap_force), rel=1e-6)  # the anchor to round-off


@pytest.mark.parametrize(
    ("strap", "says"),
    [
        ("top", "--strap: a strap is written like top:slack=5mm,stiffness=100kN/m"),
        ("top:slack=5,stiffness=1kN/m", "slack is a number with one of the units mm, cm, m"),
        ("top:stiffness=5kN", "stiffness is a number with one of the units N/m, kN/m, N/mm"),
        ("top:slack=5mm", "has no stiffness, such as stiffness=100kN/m"),
        ("top:stifness=5kN/m", "has no 'stifness'; accepted: slack, stiffness"),
        ("middle:stiffness=5kN/m", "the height is a number with one of the units"),
        ("2m:stiffness=5kN/m", "lies outside the body"),
        ("top:stiffness=5kN/m,anchor=1m/2m", "anchor has three lengths X/Y/Z"),
        ("top:stiffness=5kN/m,pretension=5N,strength=4N", "above the pretension"),
    ],
)
def test_straps_that_cannot_be(record: Path, strap: str, says: str) -> None:
    assert says in refused("simulate", *HELD, "--record", record, "--strap", strap)


def test_a_strap_without_a_mass_or_in_the_rocking_model(record: Path) -> None:
    strap = ("--strap", "top:stiffness=20kN/m", "--record", record)
    assert "need a mass; give --mass-kg" in refused("simulate", *BOX, *strap)
    heavy = (*SIZE, "--mass-kg", 50, *strap)
    assert "--model general, takes walls, straps" in refused("simulate", *heavy)
