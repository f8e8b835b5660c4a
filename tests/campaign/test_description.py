"""Campaigns as TOML files: what they describe, and faults with their lines and keys."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import General, InputError
from shaketable.campaign.description import read_campaign
from shaketable.campaign.plan import Plan
from shaketable.campaign.simulations import Simulations
from shaketable.simulate.kinds import SPACE

ONE = "[bodies.grid]\nbase_m = 1\nheight_m = 1\n"
MOTIONS = '[motions]\nof = "fema-p695-near-field-pulse"\n'


def _one_for(text: str) -> str:
    """One body, in its plane, or a box where the text that follows gives its depth."""
    return ONE.replace("base_m", "width_m") if text.startswith("depth_m") else ONE


def read(tmp_path: Path, text: str) -> Plan:
    path = tmp_path / "campaign.toml"
    path.write_text(text)
    return plan_in(path)


def plan_in(path: Path) -> Plan:
    work = read_campaign(path)
    assert isinstance(work, Simulations)
    return work.plan


def test_a_grid_is_every_combination(tmp_path: Path) -> None:
    plan = read(
        tmp_path,
        "[bodies.grid]\nbase_m = {from = 0.2, to = 0.8, count = 3, logarithmic = true}\n"
        "height_m = [1.0, 2.0]\neccentricity = 0.4\n" + MOTIONS,
    )
    bodies = plan.ensemble.bodies
    assert [body.base for body in bodies] == pytest.approx([0.2, 0.2, 0.4, 0.4, 0.8, 0.8])
    assert [2 * body.cg_height for body in bodies] == pytest.approx([1.0, 2.0] * 3)
    assert bodies[0].left == pytest.approx(0.08)
    assert bodies[0].name == "base 0.2 height 1 eccentricity 0.4"
    assert len(plan.ensemble.motions) == 28


def test_a_sample_is_spread_and_seeded(tmp_path: Path) -> None:
    text = (
        "[bodies.sobol]\ncount = 64\nseed = {}\nbase_m = {{from = 0.2, to = 0.6}}\n"
        "height_m = {{from = 0.5, to = 2.0}}\nrestitution_factor = 0.9\n" + MOTIONS
    )
    widths = [np.array([b.base for b in read(tmp_path, text.format(seed)).ensemble.bodies])
              for seed in (1, 1, 2)]  # fmt: skip
    assert np.array_equal(widths[0], widths[1])
    assert not np.array_equal(widths[0], widths[2])
    # Sobol's points: one of 64 in each 64th of the range
    assert np.array_equal(np.sort((widths[0] - 0.2) / 0.4 * 64).astype(int), np.arange(64))


def test_an_inventory_and_everything_else(tmp_path: Path) -> None:
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,anchored\nshelf,0.3,0.9,1.8,\nbolted,0.3,0.3,1.0,yes\n"
    )
    plan = read(
        tmp_path,
        '[bodies]\ninventory = "rooms.csv"\n' + MOTIONS + "[shaking]\ntilts_deg = [0, 2]\n"
        'scales = 0.5\npolarities = [1]\n[model]\nname = "general"\nstatic_friction = 0.4\n'
        '[results]\nkeep = "summary"\nrecordings = true\n[plan]\nblock = 1000\n',
    )
    assert [body.base for body in plan.ensemble.bodies] == [0.3, 0.9]
    assert [body.name for body in plan.ensemble.bodies] == [
        "1: shelf, front to back",
        "1: shelf, side to side",
    ]
    assert plan.ensemble.model == General(static_friction=0.4)
    assert plan.ensemble.tilts == pytest.approx(np.radians([0.0, 2.0]))
    assert (plan.keep, plan.recordings, plan.ensemble.scales.tolist()) == ("summary", True, [0.5])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[bodies\n", r"campaign.toml: not a TOML file \(.*line 1"),
        ("[body]\nx = 1\n", "line 1, body: unknown; accepted: bodies, motions"),
        ("bodies = 3\n", r"line 1, bodies: must be a table, \[bodies\]"),
        (MOTIONS, "bodies: give one of inventory, grid, sobol; found none"),
        ("[bodies]\ngrids = 3\n" + MOTIONS, "line 2, bodies.grids: unknown; accepted: inventory"),
        ("[bodies.grid]\nbase_m = 1\n" + MOTIONS, "line 1, bodies.grid: height_m is missing"),
        (
            "[bodies.grid]\nbase_m = 1\nheight_m = {from = 2, to = 1, count = 3}\n" + MOTIONS,
            r"line 3, bodies.grid.height_m: expected from, to, in order",
        ),
        (
            "[bodies.grid]\nbase_m = 1\nheight_m = {from = 1, to = 2}\n" + MOTIONS,
            "height_m: expected a count of 1 or more, found None",
        ),
        ("[bodies.grid]\nbase_m = -1\nheight_m = 1\n" + MOTIONS, "base -1 height 1: .*positive"),
        ("[bodies.sobol]\ncount = 0\n" + MOTIONS, "bodies.sobol.count: expected a whole number"),
        ('[bodies]\ninventory = "gone.csv"\n' + MOTIONS, "bodies.inventory: .*gone.csv: no such"),
        (ONE, "motions.of: give suites, folders or files"),
        (
            ONE + '[motions]\nof = ["gone"]\n',
            "motions.of: .*neither a file, a folder nor a suite",
        ),
        (
            ONE + MOTIONS + '[model]\nname = "rock"\n',
            "line 7, model.name: unknown 'rock'; accepted: rocking, general",
        ),
        (
            ONE + MOTIONS + "[model]\nstatic_friction = 1\n",
            "static_friction: the model 'rocking' has no such parameter",
        ),
        (
            ONE + MOTIONS + '[results]\nkeep = "some"\n',
            "keep= must be one of",
        ),
        (
            ONE + '[motions]\nof = ["near-field-pulse", "fema-p695"]\n',
            "motions.of: the same motion several times: .* and 23 more",
        ),
        ("[bodies]\ngrid = {}\n" + MOTIONS, "bodies.grid: base_m is missing"),
        (ONE + MOTIONS + "[plan]\nreport = true\n", "plan.report: is for an inventory"),
        (ONE + MOTIONS + "[results]\nrecordings = true\n", 'results.recordings: is for keep = "s'),
        (
            ONE + MOTIONS + "[results]\nkeep = 'all'\n[plan]\nreport = true\n",
            "line .*, results: a report keeps what it needs",
        ),
        (
            ONE + MOTIONS + '[shaking]\nscales = "a"\n',
            "line 7, shaking.scales: expected a number or a list",
        ),
    ],
)
def test_faults_name_line_and_key(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"[bodies.grid]\nbase_m = 1{400 * '0'}\nheight_m = 1\n" + MOTIONS, "base_m"),
        (ONE + MOTIONS + f"[model]\nrestitution = 1{400 * '0'}\n", "model.restitution"),
    ],
)
def test_an_integer_that_no_float_can_be_is_a_fault(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path, text)


def test_what_falls_by_itself_is_told_or_left_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    bodies = "[bodies.grid]\nbase_m = [0.02, 0.3]\nheight_m = 1.0\n"
    shaking = MOTIONS + "[shaking]\ntilts_deg = [0, 2]\n"
    said = "bodies: 1 of 2 bodies fall by themselves on one of the tilts: base 0.02 height 1;"
    with pytest.raises(InputError, match=said):
        read(tmp_path, bodies + shaking)
    plan = read(tmp_path, "[bodies]\nonly_standing = true\n" + bodies + shaking)
    assert [body.base for body in plan.ensemble.bodies] == [0.3]
    assert "left out: 1 of 2 bodies fall by themselves" in caplog.text


def test_castors_are_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,height_m,castors\ncart,0.5,1.0,free\nbox,0.5,1.0,\n"
    )
    read(tmp_path, '[bodies]\ninventory = "rooms.csv"\n' + MOTIONS)
    assert "1 objects on castors are simulated as if they did not roll: cart" in caplog.text


EXAMPLES = Path(__file__).parents[2] / "examples"


def test_the_examples_are_read() -> None:
    assert plan_in(EXAMPLES / "campaign.toml").simulations == 36 * 44 * 2 * 2 * 2
    assert plan_in(EXAMPLES / "campaign-inventory.toml").recordings


def test_the_page_shows_the_example() -> None:
    page = (EXAMPLES.parent / "docs" / "how_to" / "campaigns.md").read_text(encoding="utf-8")
    example = (EXAMPLES / "campaign-inventory.toml").read_text(encoding="utf-8")
    assert example[example.index("[bodies]") :] in page


def test_solids(tmp_path: Path) -> None:
    shaking = "[shaking]\ntilts_deg = [0, 2]\nazimuth_deg = 90\norientations_deg = [0, 45]\n"
    sizes = "depth_m = [0.2, 0.3]\nheight_m = 1\n"
    plan = read(
        tmp_path, f"[bodies.grid]\n{sizes}width_m = 0.5\neccentricity = 0.4\n{MOTIONS}{shaking}"
    )
    ensemble = plan.ensemble
    assert ensemble.kind is SPACE
    assert [solid.extent for solid in ensemble.bodies] == [(0.2, 0.5), (0.3, 0.5)]
    assert ensemble.bodies[0].corners[:, 0].min() == pytest.approx(-0.08)
    assert len(ensemble.motions) == 14  # pairs
    assert all(motion.transverse is not None for motion in ensemble.motions)
    assert ensemble.azimuth == pytest.approx(np.pi / 2)
    assert ensemble.orientations == pytest.approx([0.0, np.pi / 4])
    assert ensemble.model == General()
    text = f'[bodies.sobol]\ncount = 2\nshape = "cylinder"\n{MOTIONS}pairs = false\n'
    sample = text.replace("count", "base_m = 0.3\nheight_m = {from = 1, to = 2}\ncount", 1)
    bottles = read(tmp_path, sample).ensemble
    assert [solid.diameter for solid in bottles.bodies] == [0.3, 0.3]
    assert bottles.bodies[0].name.startswith("cylinder base 0.3 height 1")
    assert len(bottles.motions) == 28


def test_an_inventory_as_solids(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,castors,shape\nshelf,0.3,0.9,1.8,,\nflat,0.1,0.9,1.8,,\n"
        "deep,0.3,,1.8,,\ncart,0.5,0.6,1.0,free,\nvase,0.3,,1.0,,cylinder\n"
    )
    plan = read(
        tmp_path,
        '[bodies]\ninventory = "rooms.csv"\nsolids = true\nonly_standing = true\n' + MOTIONS
        + "[shaking]\ntilts_deg = 5\n",
    )  # fmt: skip
    # the flat one falls by itself at atan(0.1 / 1.8) = 3.2 degrees
    assert [solid.name for solid in plan.ensemble.bodies] == ["1: shelf", "4: cart", "5: vase"]
    assert plan.ensemble.bodies[1].castors == (True,) * 4
    assert "left out: 1 of 5 objects, whose depth or width is not known" in caplog.text
    assert "left out: 1 of 4 bodies fall by themselves on one of the tilts: 2: flat" in caplog.text


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('shape = "ball"\n', "line 4, bodies.grid.shape: expected box or cylinder, found 'ball'"),
        ('shape = "box"\n', "depth_m is missing: a box has depth_m"),
        ("width_m = 1\n", "width_m: of a box, beside depth_m; in a plane the one size along"),
        ("depth_m = 1\nbase_m = 1\n", "base_m: a box in three dimensions has none"),
        ('shape = "cylinder"\ndepth_m = 1\n', "depth_m: a cylinder in three dimensions has none"),
        ("depth_m = 1\nrestitution_factor = 0.9\n", "restitution_factor: a box in three dimen"),
        ("depth_m = -1\n", "depth -1: size_x"),
        ("[shaking]\nazimuth_deg = 90\n", "shaking.azimuth_deg: is for solids"),
        (f"{MOTIONS}pairs = true\n", "motions.pairs: is for solids, or for a report"),
        ('depth_m = 1\n[model]\nname = "rocking"\n', "a Solid needs General"),
        ("[bodies]\nsolids = true\n", "bodies.solids: is for an inventory"),
    ],
)
def test_faults_of_solids(tmp_path: Path, text: str, says: str) -> None:
    text = text + ONE if text.startswith("[bodies]") else _one_for(text) + text
    with pytest.raises(InputError) as caught:
        read(tmp_path, text if "[motions]" in text else text + MOTIONS)
    assert says in str(caught.value)


STRAPS = '[surroundings]\nstraps = ["top:slack=5mm,stiffness=100kN/m", "0.5m:stiffness=50N/mm"]\n'


def test_straps_hold_each_solid_at_its_own_top(tmp_path: Path) -> None:
    grid = "[bodies.grid]\ndepth_m = 0.4\nheight_m = [1.0, 1.8]\nwidth_m = 0.6\n"
    turned = "[shaking]\norientations_deg = 90\n"
    ensemble = read(tmp_path, grid + MOTIONS + turned + STRAPS + "mass_kg = 80\n").ensemble
    assert [solid.mass for solid in ensemble.bodies] == [80.0, 80.0]
    for k, height in enumerate((1.0, 1.8)):
        around = ensemble.around(k)
        assert around is not None
        top, low = around.straps
        assert top.point == pytest.approx((0.2, 0.0, height))
        assert top.anchor == pytest.approx((0.0, 0.25, height))  # 50 mm behind, as it is turned
        assert (top.slack, top.stiffness) == (0.005, 100e3)
        assert (low.point[2], low.stiffness) == (0.5, 50e3)
    free = read(tmp_path, grid + MOTIONS).ensemble
    assert ensemble.held_field == "held_up"
    assert not free.held_field
    assert free.bodies[0].mass is None


def test_a_wall_stands_beside_each_solid(tmp_path: Path) -> None:
    """Behind the side toward +x, turned with it; straps end on it. Without them no mass counts."""
    grid = "[bodies.grid]\ndepth_m = 0.4\nheight_m = [1.0, 1.8]\nwidth_m = 0.6\n"
    turned = "[shaking]\norientations_deg = 90\n"
    wall = "[surroundings]\nwall_gap_mm = 10\nwall_restitution = 0.3\n"
    ensemble = read(tmp_path, grid + MOTIONS + turned + wall).ensemble
    for k in range(2):
        around = ensemble.around(k)
        assert around is not None
        (beside,) = around.walls
        assert (beside.gap, beside.friction, beside.restitution) == (0.01, 0.3, 0.3)
        assert beside.azimuth == pytest.approx(math.pi / 2)
    both = wall + "wall_friction = 0.5\nmass_kg = 80\n" + STRAPS.partition("\n")[2]
    around = read(tmp_path, grid + MOTIONS + both).ensemble.around(1)
    assert around is not None
    assert around.walls[0].friction == 0.5
    assert around.straps[0].anchor == pytest.approx((0.21, 0.0, 1.8))
    with pytest.raises(InputError, match=r"Wall\.gap \[m\]"):
        read(tmp_path, grid + MOTIONS + "[surroundings]\nwall_gap_mm = -1\n")


def test_planar_bodies_are_surrounded_in_the_general_model(tmp_path: Path) -> None:
    """A wall behind, a strap to it, an edge in front and glue; each body at its own size."""
    grid = "[bodies.grid]\nbase_m = [0.3, 0.4]\nheight_m = 1.2\n"
    around = (
        '[model]\nname = "general"\nstatic_friction = 0.5\n[surroundings]\nwall_gap_mm = 20\n'
        'wall_friction = 0.2\nstraps = ["top:stiffness=20kN/m"]\nmass_kg = 40\nedge_mm = 30\n'
        "lip_mm = 5\npad_n = 50\n"
    )
    ensemble = read(tmp_path, grid + MOTIONS + around).ensemble
    for k, width in enumerate((0.3, 0.4)):
        told = ensemble.around(k)
        assert told is not None
        assert told.walls[0].gap == pytest.approx(0.02)
        assert told.walls[0].vertical
        assert told.straps[0].point == pytest.approx((width / 2, 1.2))
        assert told.straps[0].anchor == pytest.approx((width / 2 + 0.02, 1.2))
        assert told.edge is not None
        assert told.edge.at == pytest.approx(width / 2 + 0.03)
        assert math.cos(told.edge.azimuth) == -1.0
        assert told.edge.lip == pytest.approx(0.005)
        assert told.pad is not None
        assert told.pad.pull_off == 50.0
        assert ensemble.bodies[k].mass == 40.0
    leaves_rocking = grid + MOTIONS + "[surroundings]\nwall_gap_mm = 0\n"
    (tmp_path / "rooms.csv").write_text("name,depth_m,width_m,height_m\nshelf,0.3,0.9,1.8\n")
    assert not read(tmp_path, leaves_rocking).ensemble.around(0).walls[0].vertical  # type: ignore[union-attr]
    with pytest.raises(InputError, match="surrounded as solids: solids = true"):
        read(tmp_path, '[bodies]\ninventory = "rooms.csv"\n' + MOTIONS + STRAPS)


def test_an_inventory_surrounds_its_own_objects(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """As solids turned with them, or in the plane in the general model."""
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,mass_kg,wall_gap_mm,strap,lip_mm,edge_mm\n"
        "alone,0.5,0.6,1.2,,,,,\nshelf,0.3,0.9,1.8,120,10,top:stiffness=50kN/m,,\n"
        "jar,0.1,0.1,0.3,,,,5,20\n"
    )
    listed = '[bodies]\ninventory = "rooms.csv"\n'
    turned = "[shaking]\norientations_deg = 90\n"
    solids = read(tmp_path, listed + "solids = true\n" + MOTIONS + turned).ensemble
    assert [solid.mass for solid in solids.bodies] == [None, 120.0, None]
    assert solids.around(0) is None
    held, edged = solids.around(1), solids.around(2)
    assert held is not None
    assert held.walls[0].azimuth == pytest.approx(math.pi / 2)
    assert held.straps[0].anchor == pytest.approx((0.0, 0.16, 1.8))
    assert edged is not None
    assert edged.edge is not None
    assert edged.edge.lip == 0.005
    general = '[model]\nname = "general"\nstatic_friction = 0.5\n'
    plane = read(tmp_path, listed + MOTIONS + general).ensemble
    names = [body.name for body in plane.bodies]
    own = {name: plane.around(k) for k, name in enumerate(names)}
    assert [bool(own[name]) for name in names if "shelf" in name] == [True, False]
    jar = next(own[name] for name in names if "jar" in name)
    assert jar is not None
    assert jar.edge is not None
    assert jar.edge.lip == 0.005
    with pytest.raises(InputError, match="which are of the general model"):
        read(tmp_path, listed + MOTIONS)
    with pytest.raises(InputError, match="walls, straps or edges of its own: leave this out"):
        read(tmp_path, listed + "solids = true\n" + MOTIONS + STRAPS)


def test_straps_of_an_inventory_know_its_masses(tmp_path: Path) -> None:
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,mass_kg\nshelf,0.3,0.9,1.8,120\nrack,0.5,0.6,1.2,\n"
    )
    listed = '[bodies]\ninventory = "rooms.csv"\nsolids = true\n' + MOTIONS
    ensemble = read(tmp_path, listed + STRAPS + "mass_kg = 70\n").ensemble
    assert [solid.mass for solid in ensemble.bodies] == [120.0, 70.0]
    assert [solid.mass for solid in read(tmp_path, listed).ensemble.bodies] == [None, None]
    with pytest.raises(InputError, match="give mass_kg: no mass is known of 2: rack"):
        read(tmp_path, listed + STRAPS)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            "depth_m = 1\n[surroundings]\nmass_kg = 5\n",
            "surroundings: give straps, wall_gap_mm, edge_mm or pad_n",
        ),
        ("depth_m = 1\n[surroundings]\nstrap = []\n", "unknown; accepted: straps, mass_kg"),
        ("depth_m = 1\n[surroundings]\nstraps = [1]\n", "expected texts, found [1]"),
        (f"depth_m = 1\n{STRAPS}", "line 5, surroundings: give mass_kg"),
        (
            f"depth_m = 1\n{STRAPS}mass_kg = 0\n",
            "line 5, surroundings: Solid.mass [kg] must be a positive",
        ),
        (
            f"{STRAPS}mass_kg = 5\n",
            "in the rocking model a planar body has one wall and nothing else",
        ),
        (
            'depth_m = 1\n[surroundings]\nstraps = ["2m:stiffness=1kN/m"]\nmass_kg = 5\n',
            "width 1 height 1 depth 1, strap 1: its point (0.5, 0.0, 2.0) [m] lies outside",
        ),
        (
            'depth_m = 1\n[surroundings]\nstraps = ["top:stiffness=1kN"]\nmass_kg = 5\n',
            "of a strap stiffness is a number with one of the units N/m",
        ),
        (
            f"depth_m = 1\n[shaking]\norientations_deg = [0, 45]\n{STRAPS}mass_kg = 5\n",
            "shaking.orientations_deg: in surroundings one: these do not turn",
        ),
    ],
)
def test_faults_of_straps(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, _one_for(text) + text + MOTIONS)
    assert says in str(caught.value)


def test_a_report_takes_straps_from_its_list(tmp_path: Path) -> None:
    (tmp_path / "rooms.csv").write_text("name,depth_m,width_m,height_m\nshelf,0.3,0.9,1.8\n")
    listed = '[bodies]\ninventory = "rooms.csv"\n' + MOTIONS + STRAPS
    with pytest.raises(
        InputError, match="surroundings: a report takes them from the columns of its list"
    ):
        read(tmp_path, listed + "[plan]\nreport = true\n")
