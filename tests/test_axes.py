"""Every door takes one thing in one way: its depth lies on x, its back is toward +x.

The thing has no two sizes alike, stands with its centre of gravity nearer to its front, and has a
wall behind it. What each door makes of it is compared in its own frame.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from shaketable import Body, General, Motion, Solid, Surroundings, Wall, simulate, suite
from shaketable.campaign.description import read_campaign
from shaketable.campaign.simulations import Simulations
from shaketable.inventory import read_inventory, solid_of
from shaketable.inventory.directions import directed
from shaketable.rooms.read import read_room
from shaketable.rooms.shaken import at_walls
from shaketable.web.beside import around
from shaketable.web.questions import Beside, Thing, Upright
from shaketable.web.space import _solid
from shaketable.web.work import _body
from tests.support.command import shaketable

DEPTH, WIDTH, HEIGHT, SHARE, GAP = 0.31, 0.83, 1.62, 0.4, 0.012
FRONT, BACK = -SHARE * DEPTH, (1.0 - SHARE) * DEPTH
MIDDLE = -0.5 * DEPTH, 0.5 * DEPTH
SIZES = f"depth_m = {DEPTH}\nwidth_m = {WIDTH}\nheight_m = {HEIGHT}\n"
RECORDED = '[motions]\nof = ["fema-p695-near-field-pulse"]\n[model]\nname = "general"\n'
BEHIND = f"[surroundings]\nwall_gap_mm = {1000 * GAP}\n"
Placed = tuple[Solid, Surroundings | None]


def python(folder: Path) -> Placed:
    del folder
    solid = Solid.box(DEPTH, WIDTH, HEIGHT, eccentricity=(SHARE, 0.5))
    return solid, Surroundings(walls=(Wall(gap=GAP),))


def of_list(folder: Path) -> Placed:
    path = folder / "list.csv"
    path.write_text(
        "name,depth_m,width_m,height_m,eccentricity,wall_gap_mm\n"
        f"case,{DEPTH},{WIDTH},{HEIGHT},{SHARE},{1000 * GAP}\n"
    )
    (item,) = read_inventory(path)
    solid = solid_of(item, 0.0)
    assert solid is not None
    return solid, item.surroundings


def of_campaign(folder: Path) -> Placed:
    path = folder / "campaign.toml"
    path.write_text(f"[bodies.grid]\n{SIZES}eccentricity = {SHARE}\n{RECORDED}{BEHIND}")
    work = read_campaign(path)
    assert isinstance(work, Simulations)
    return work.plan.ensemble.bodies[0], work.plan.ensemble.around(0)


def of_page(folder: Path) -> Placed:
    """Its centre of gravity is above the middle: the page asks for no other place in space."""
    del folder
    beside = Beside(wall_gap_mm=1000 * GAP)
    solid = _solid(Upright(depth_m=DEPTH, width_m=WIDTH, height_m=HEIGHT))
    return solid, around(beside, solid)


def of_room(folder: Path) -> Placed:
    """It looks south, with its back to the northern wall."""
    path = folder / "room.toml"
    path.write_text(
        "outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]\n[[door]]\nat_m = [2, 0]\n"
        f'[[thing]]\nname = "case"\nat_m = [2, {3.0 - GAP - DEPTH / 2}]\nfacing_deg = 180\n{SIZES}'
    )
    room = read_room(path)
    item = at_walls(room, room.things[0])
    solid = solid_of(item, 0.0)
    assert solid is not None
    return solid, item.surroundings


@pytest.mark.parametrize(
    ("door", "ends"),
    [
        (python, (FRONT, BACK)),
        (of_list, (FRONT, BACK)),
        (of_campaign, (FRONT, BACK)),
        (of_page, MIDDLE),
        (of_room, MIDDLE),
    ],
)
def test_every_door_lays_the_depth_on_x(
    door: Callable[[Path], Placed], ends: tuple[float, float], tmp_path: Path
) -> None:
    solid, beside = door(tmp_path)
    along, across = solid.corners.T
    assert (along.min(), along.max()) == pytest.approx(ends)
    assert (across.min(), across.max()) == pytest.approx((-WIDTH / 2, WIDTH / 2))
    assert beside is not None
    wall = min(beside.walls, key=lambda each: each.gap)  # a room has others, farther away
    assert (wall.azimuth, wall.gap) == pytest.approx((0.0, GAP), abs=1e-12)  # it stands behind


def test_the_command_lays_the_depth_on_x() -> None:
    """Its result is that of the thing in Python, to the bit."""
    given = {
        "--depth-m": DEPTH, "--width-m": WIDTH, "--height-m": HEIGHT, "--eccentricity": SHARE,
        "--wall-gap-mm": 1000 * GAP, "--static-friction": 0.5,
    }  # fmt: skip
    run = shaketable("simulate", *(word for pair in given.items() for word in pair), "--json")
    assert run.returncode == 0, run.stderr
    told = json.loads(run.stdout)
    solid, beside = python(Path())
    known = simulate(solid, _both(), model=General(static_friction=0.5), surroundings=beside)
    assert told["peak_rotation_rad"] == known.peak_rotation
    assert told["impacts"] == known.impacts > 10


def test_in_the_plane_the_base_is_the_size_along_the_shaking(tmp_path: Path) -> None:
    """Its front is toward -x: seen from the side, at the left."""
    of_list(tmp_path)
    (way, *_) = directed(list(enumerate(read_inventory(tmp_path / "list.csv"), 1)))
    path = tmp_path / "plane.toml"
    sizes = f"base_m = {DEPTH}\nheight_m = {HEIGHT}\neccentricity = {SHARE}\n"
    path.write_text(f"[bodies.grid]\n{sizes}{RECORDED}static_friction = 0.5\n{BEHIND}")
    work = read_campaign(path)
    assert isinstance(work, Simulations)
    grid = work.plan.ensemble
    page = _body(Thing(base_m=DEPTH, height_m=HEIGHT, eccentricity=SHARE))
    plain = Body.rectangle(DEPTH, HEIGHT, eccentricity=SHARE)
    for body in (plain, way.body, grid.bodies[0], page):
        assert (-body.left, body.right) == pytest.approx((FRONT, BACK))
    for beside in (way.surroundings, grid.around(0), around(Beside(wall_gap_mm=12.0), page)):
        assert beside is not None
        (wall,) = beside.walls
        assert (wall.azimuth, wall.gap) == pytest.approx((0.0, GAP), abs=1e-12)
    given = ("--base-m", DEPTH, "--height-m", HEIGHT, "--eccentricity", SHARE, "--json")
    told = json.loads(shaketable("simulate", *given).stdout)
    assert told["peak_rotation_rad"] == simulate(plain, _one()).peak_rotation


@pytest.mark.parametrize(
    "command",
    ["criteria --pga-g 0.3 --pgv-cm-s 40", "initial-modes --static-friction 0.4", "simulate",
     "fragility --out out", "ida --out out", "overturning-spectrum --out out", "tilt --tilt-deg 2"],
)  # fmt: skip
def test_a_width_alone_is_told_of_the_base(command: str, tmp_path: Path) -> None:
    run = shaketable(*command.split(), "--width-m", 0.3, "--height-m", 1.8, cwd=tmp_path)
    assert run.returncode == 2
    assert "in a plane the one size along the shaking is --base-m" in " ".join(run.stderr.split())
    assert not list(tmp_path.iterdir())


def test_only_what_has_a_base_tells_of_it(tmp_path: Path) -> None:
    run = shaketable("assess", "--width-m", 0.3, cwd=tmp_path)
    assert run.returncode == 2
    assert "--base-m" not in run.stderr


def _both() -> Motion:
    pairs = suite("fema-p695", pairs=True)
    return next(each for each in pairs if each.name == "NORTHR/MUL009")


def _one() -> Motion:
    return next(each for each in suite("fema-p695") if each.name == "NORTHR/MUL009")
