"""A room that was shaken: its page, its tables and its plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pandas as pd

from shaketable.assess import Share
from shaketable.drawing.files import figure_of
from shaketable.language import number, spoken, tell
from shaketable.plot.room import plot_room
from shaketable.report.html import pages
from shaketable.report.results_folder import Picture, write_folder
from shaketable.report.words import room as words

if TYPE_CHECKING:
    from shaketable.rooms import RoomAssessment, RoomDesign, Tried

MOST_FIRST = 5  # changes on the first page


def write_room(
    found: RoomAssessment,
    run: Mapping[str, object],
    folder: Path,
    *,
    description: str,
    design: RoomDesign | None = None,
    scale: float = 1.0,
    overwrite: bool = False,
) -> None:
    """Write the results of a room in the language that is spoken: a page, tables, the plan.

    Args:
        found: what was found.
        run: what makes it repeatable.
        folder: new, or with `overwrite` one of earlier results.
        description: of the motions.
        design: what could be changed, if it was tried.
        scale: factor on them.
        overwrite: replace earlier results.
    """

    write_folder(
        folder, run, overwrite=overwrite,
        tables={**tables_of(found), **(design_tables(design) if design else {})},
        pictures=[plan_of(found, "plan")],
        page=lambda shown: page_of(
            found, run, shown, description=description, design=design, scale=scale
        ),
    )  # fmt: skip


def plan_of(found: RoomAssessment, name: str) -> Picture:
    """The plan of a room with all that was found."""
    return Picture(name, plan_caption(), figure_of(plot_room(found.room, found)))


def plan_caption() -> str:
    """What the plan shows."""
    return tell(
        "The plan: where something lies, in percent of the shakings; gray is what stands. Arrows "
        "show to which side it falls, the longer the more often."
    )


def page_of(
    found: RoomAssessment,
    run: Mapping[str, object],
    pictures: Sequence[Mapping[str, str]],
    *,
    description: str,
    design: RoomDesign | None = None,
    scale: float = 1.0,
) -> str:
    """The page of a room; arguments as for `write_room`."""
    at = "" if scale == 1.0 else tell(", multiplied by {scale:g}", scale=scale)
    return pages().get_template("room.html.j2").render(
        **_told(found, design), tell=tell, lang=spoken(), at=at, description=description,
        messages=run.get("messages", ()), pictures=pictures, run=run,
    )  # fmt: skip


def _told(found: RoomAssessment, design: RoomDesign | None) -> dict[str, object]:
    """What the page says."""
    changes = [
        {"does": words.tried(each), "leaves": words.left_after(each, design),
         "saves": number(each.saves, "+.2f")}
        for each in design.singles
    ] if design else []  # fmt: skip
    best_of: dict[str, Tried] = {}  # of each thing, the one that saves most first
    for each in design.singles if design else ():
        if each.saves > 0.0:
            best_of.setdefault(each.changes[0].thing, each)
    best = design.pairs[:1] if design else ()
    return {
        "found": found,
        "summary": words.summary(found),
        "first": [
            {"does": words.tried(each), "leaves": words.left_after(each, design)}
            for each in (*list(best_of.values())[:MOST_FIRST], *best)
            if design
        ],
        "about_first": words.about_changes(design),
        "not_considered": words.not_considered(found),
        "frictions": words.frictions([found]),
        "ways": [
            {"place": way.place, "exit": words.exit_of(way), "closed": words.closed(way, found),
             "by": words.by_what(way.by)}
            for way in found.ways
        ],
        "places": [
            {"name": each.place.name, "hit": words.often(each.hit, each.friction, found),
             "by": words.by_what(each.by),
             "hits": number(each.hits, ".2f") if each.place.people else "–"}
            for each in found.places
        ],
        "total": words.total_hits(found),
        "things": [
            {"name": each.name, "falls": words.often(each.falls, each.friction, found),
             "held_up": words.often(each.held_up, each.friction_held_up, found),
             "covers": number(each.covers, ".2f")}
            for each in found.things
        ],
        "changes": changes,
    }  # fmt: skip


def tables_of(found: RoomAssessment) -> dict[str, pd.DataFrame]:
    """All numbers, by the names of their tables; lengths in m, shares of 1."""
    grid = found.grid
    rows, columns = found.covered.nonzero()
    return {
        "things": pd.DataFrame(
            {"name": each.name, **_share("fall", each.falls), **_share("held_up", each.held_up),
             **{f"{side}_share_of_falls": share for side, share in each.sides._asdict().items()},
             "covered_m2": each.covers, "friction": each.friction,
             "friction_held_up": each.friction_held_up}
            for each in found.things
        ),
        "places": pd.DataFrame(
            {"name": each.place.name, "kind": each.place.kind.value, **_share("hit", each.hit),
             "people": each.place.people, "people_hit": each.hits, "friction": each.friction,
             "by": "; ".join(f"{name} {share:.4g}" for name, share in each.by)}
            for each in found.places
        ),
        "ways": pd.DataFrame(
            {"place": way.place, "exit": words.exit_of(way), **_share("closed", way.closed),
             "open_before": way.open_before, "friction": way.friction,
             "by": "; ".join(f"{name} {share:.4g}" for name, share in way.by)}
            for way in found.ways
        ),
        "covered": pd.DataFrame(
            {"x_m": grid.x[columns], "y_m": grid.y[rows],
             "covered_share": found.covered[rows, columns]}
        ),
    }  # fmt: skip


def design_tables(found: RoomDesign) -> dict[str, pd.DataFrame]:
    """Every change and pair that was tried, the one that saves most first."""
    return {
        name: pd.DataFrame(
            {
                "does": words.tried(each),
                "people_saved": each.saves,
                "people_left": each.left.people,
                **_share("hit", each.left.hit),
                **_share("shut_in", each.left.shut_in),
                **_share("hit_or_shut_in", each.left.any),
            }
            for each in some
        )
        for name, some in (("changes", found.singles), ("pairs", found.pairs))
    }


def _share(name: str, share: Share) -> dict[str, float]:
    return {f"{name}_share": share.value, f"{name}_low": share.low, f"{name}_high": share.high}
