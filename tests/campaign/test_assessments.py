"""Assessments in blocks: what `assess` finds at once, kept and gone on with."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from shaketable import InputError, Motion, SimulationError, assess, open_campaign, run_campaign
from shaketable.assess import Assessment, Walls
from shaketable.assess.carried import kick_of
from shaketable.campaign import assessments
from shaketable.campaign.as_json import from_json, to_json
from shaketable.campaign.assessments import Assessments, read_assessment
from shaketable.campaign.blocks import site_of
from shaketable.campaign.description import read_campaign
from shaketable.campaign.kinds import work_of
from shaketable.campaign.objects import Objects
from shaketable.campaign.run import run
from shaketable.campaign.status import estimate, status_of
from shaketable.inventory import Item, read_inventory
from shaketable.models import Rocking
from shaketable.surroundings import Surroundings, Wall
from tests.support.command import refused, shaketable

pytest.importorskip("zarr", reason="the extra campaign is not installed: pip install '.[campaign]'")

HOSPITAL = Path(__file__).parents[2] / "examples" / "hospital.csv"


@pytest.fixture
def work(p695: list[Motion]) -> Assessments:
    """Seven kinds of object in blocks of three, some on castors."""
    items: list[Item] = [item for item in read_inventory(HOSPITAL) if not item.anchored]
    given = {"motions": p695[:30], "scale": 1.0, "tilt": 0.0, "model": Rocking()}
    return Assessments(items=items[8:15], **given, items_per_block=3)


def read(place: Path) -> tuple[Assessment, Assessments]:
    """What a store holds, and the work that it kept."""
    objects = Objects(place)
    kept = work_of(objects)
    assert isinstance(kept, Assessments)
    return read_assessment(kept, objects), kept


def test_blocks_are_what_is_found_at_once(work: Assessments, tmp_path: Path) -> None:
    run(work, tmp_path, progress=False)
    found, _ = read(tmp_path)
    once = assess(work.items, work.motions, progress=False)
    pd.testing.assert_frame_equal(found.table, once.table)
    assert [one.number for one in found.results] == [1, 2, 3, 4, 5, 6, 7]
    assert found.floors[0].motions == once.floors[0].motions
    assert repr(found.results[0].curves) == repr(once.results[0].curves)
    again = from_json(to_json(once.results[0]))
    assert again.profile == once.results[0].profile


def test_what_things_stand_on_and_at_is_known_of_the_whole_list(
    work: Assessments, tmp_path: Path
) -> None:
    """In whatever block what carries it is, and what stands at a wall."""
    box, cupboard = work.items[0], work.items[3]
    around = Surroundings(walls=(Wall(gap=0.02),))
    items = [replace(box, stands_on=f"on {cupboard.name}"), replace(cupboard, surroundings=around)]
    run(replace(work, items=items, items_per_block=1), tmp_path, progress=False)
    found, _ = read(tmp_path)
    assert found.results[0].kick == kick_of(*items)
    assert found.walls is Walls.EACH


def test_only_what_is_missing_is_done(
    work: Assessments, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(work, tmp_path, progress=False)
    blocks = sorted((tmp_path / "results" / "items").iterdir())
    assert len(blocks) == 3
    blocks[0].unlink()
    blocks[1].write_bytes(blocks[1].read_bytes()[:-9])
    with pytest.raises(SimulationError, match=r"00000000\.json\.z has no bytes, .* were written"):
        read(tmp_path)
    told = status_of(Objects(tmp_path))
    assert (told.damaged, told.blocks_done, told.count_done, told.count) == (2, 1, 1, 7)
    done: list[int] = []
    do = Assessments.do
    monkeypatch.setattr(
        Assessments,
        "do",
        lambda self, number, progress: done.append(number) or do(self, number, progress),
    )
    run(work, tmp_path, progress=False)
    assert done == [0, 1]
    (tmp_path / "campaign" / "done" / "00000001.json").unlink()
    with pytest.raises(InputError, match="2 of 3 blocks are done"):
        read(tmp_path)
    run(work, tmp_path, progress=False)
    assert done == [0, 1, 1]
    blocks[2].write_bytes(bytes(len(blocks[2].read_bytes())))
    with pytest.raises(SimulationError, match=r"00000002\.json\.z is damaged"):
        read(tmp_path)


def test_other_inputs_are_refused(work: Assessments, tmp_path: Path) -> None:
    run(work, tmp_path, progress=False)
    other = replace(work, items=work.items[:6], scale=2.0)
    with pytest.raises(InputError, match=r"\(items: 7 → 6; scale: 1\.0 → 2\.0\); go on with what"):
        run(other, tmp_path, progress=False)


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_workers_find_the_same(work: Assessments, tmp_path: Path) -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    from shaketable.campaign.cluster import local

    with local(2) as client:
        run(work, tmp_path / "there", client=client, progress=False)
    run(work, tmp_path / "here", progress=False)
    found, once = (read(tmp_path / name)[0] for name in ("there", "here"))
    told = [json.dumps([to_json(one) for one in each.results]) for each in (found, once)]
    assert told[0] == told[1]
    with pytest.raises(InputError, match="another campaign"):
        run(replace(work, scale=2.0), tmp_path / "there", progress=False)


def test_a_worker_with_other_code_is_refused(
    work: Assessments, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(work, tmp_path, progress=False)
    real = assessments.environment("**/*.py")
    changed = {**real, "shaketable's code": "other"}
    monkeypatch.setattr(assessments, "environment", lambda *patterns: changed)
    with pytest.raises(SimulationError, match="has shaketable's code other in place of"):
        site_of(str(tmp_path), "a beginning")


def test_a_report_is_no_dataset(work: Assessments, tmp_path: Path) -> None:
    run(work, tmp_path, progress=False)
    with pytest.raises(
        InputError, match=r"holds objects that were assessed.*campaign collect writes"
    ):
        open_campaign(tmp_path)


def test_what_it_would_take(work: Assessments, tmp_path: Path) -> None:
    """Bytes are those before compression, and told to be more than they are."""
    told = estimate(work)
    assert (told.counted, told.blocks, told.count) == ("objects", 3, 7)
    assert told.seconds > 0.0
    kept = [work.do(number, False).values for number in range(work.blocks)]
    assert 0.3 * told.size < len(json.dumps(kept)) < told.size


def test_from_the_command_line(tmp_path: Path) -> None:
    """The tables are those of `assess`; the page is whole."""
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,quantity\nshelf,0.3,0.9,1.8,4\nbox,0.5,0.5,0.6,2\n"
    )
    (tmp_path / "c.toml").write_text(
        '[bodies]\ninventory = "rooms.csv"\n[motions]\nof = "near-field-pulse"\n'
        "[plan]\nreport = true\n"
    )
    dry = shaketable("campaign", "run", "c.toml", "--dry-run", cwd=tmp_path)
    assert "objects           2 in 1 blocks" in dry.stdout
    run = shaketable("campaign", "run", "c.toml", "--store", "s", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "objects           2 of 2\n" in run.stdout
    collect = shaketable("campaign", "collect", "s", "--out", "out", cwd=tmp_path)
    assert collect.returncode == 0, collect.stderr
    shaketable(
        "assess",
        "rooms.csv",
        "--planar",
        "--motions",
        "near-field-pulse",
        "--out",
        "once",
        cwd=tmp_path,
    )
    tables = [pd.read_csv(tmp_path / name / "results.csv") for name in ("out", "once")]
    pd.testing.assert_frame_equal(*tables)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "What to do first" in page
    assert "28 motions (near-field-pulse)" in page
    assert hashlib.sha256((tmp_path / "rooms.csv").read_bytes()).hexdigest() in page
    assert "Shaken by 28 motions (near-field-pulse)" in collect.stdout
    said = refused("campaign", "run", "c.toml", "--store", "s", "--device", "cuda", cwd=tmp_path)
    assert "c.toml: plan.report: a report is made on the CPU" in said


def test_in_three_dimensions(work: Assessments, tmp_path: Path) -> None:
    run(replace(work, in_pairs=True), tmp_path, progress=False)
    found, kept = read(tmp_path)
    assert kept.in_pairs
    once = assess(work.items, kept.shaking, leading=0, progress=False)
    assert len(once.solids) == len(work.items)
    pd.testing.assert_frame_equal(found.table, once.table)
    assert found.pairs == once.pairs
    with pytest.raises(InputError, match="pairs: True → False"):
        run(work, tmp_path, progress=False)


def test_other_work_than_a_store_holds_is_refused(
    work: Assessments, small: dict[str, Any], tmp_path: Path
) -> None:
    run(work, tmp_path / "a", progress=False)
    with pytest.raises(InputError, match=r"\(assessments → simulations\); give another store"):
        run_campaign(**small, store=tmp_path / "a")
    run_campaign(**small, store=tmp_path / "s")
    with pytest.raises(InputError, match=r"\(simulations → assessments\); give another store"):
        run(work, tmp_path / "s", progress=False)


REPORT = '[bodies]\ninventory = "rooms.csv"\n[motions]\nof = "near-field-pulse"\n'


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ("[shaking]\ntilts_deg = [95]\n", r"Support.tilt \[rad\] must lie in"),
        ("[shaking]\ntilts_deg = [20]\n", "shelf.*falls by itself"),
        ("[shaking]\nscales = [1e10]\n", "scale must be at most 1e"),
        ("pairs = true\n[model]\nrestitution = 0.9\n", "solids know General"),
    ],
)
def test_what_no_block_could_take_is_refused_at_once(more: str, says: str, tmp_path: Path) -> None:
    (tmp_path / "rooms.csv").write_text("name,depth_m,width_m,height_m\nshelf,0.3,0.9,1.8\n")
    (tmp_path / "c.toml").write_text(REPORT + more + "[plan]\nreport = true\n")
    with pytest.raises(InputError, match=says):
        read_campaign(tmp_path / "c.toml")


def test_what_a_tilt_does_is_told_before_the_run(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "rooms.csv").write_text("name,depth_m,width_m,height_m\nbox,0.5,0.5,0.6\n")
    (tmp_path / "c.toml").write_text(
        f'{REPORT}[shaking]\ntilts_deg = [8]\n[model]\nname = "general"\nstatic_friction = 0.1\n'
        "[plan]\nreport = true\n"
    )
    read_campaign(tmp_path / "c.toml")
    assert "slides by itself" in caplog.text
