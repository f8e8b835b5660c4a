"""Many rooms that were shaken: a table and a page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from shaketable.errors import named
from shaketable.language import number, spoken, tell
from shaketable.report.html import pages
from shaketable.report.results_folder import write_folder
from shaketable.report.room import page_of, plan_caption, plan_of, tables_of
from shaketable.report.words import room as words
from shaketable.rooms import RoomAssessment, RoomSurvey
from shaketable.rooms.survey import closed_share, worst_hit, worst_way

MOST_NAMED = 3  # floors


def write_survey(
    found: RoomSurvey,
    run: Mapping[str, object],
    folder: Path,
    *,
    limit: float,
    descriptions: Mapping[str, str],
    scale: float = 1.0,
    pages_of: int = 0,
    overwrite: bool = False,
) -> None:
    """Write tables of rooms and a page, in the language that is spoken, and pages of some of them.

    Args:
        found: what was found.
        run: what makes it repeatable.
        folder: new, or with `overwrite` one of earlier results.
        limit: share of the runs; ways that close more often are named first.
        descriptions: of the motions of each room, by its name.
        scale: factor on them.
        pages_of: how many rooms have a page of their own, the most pressing first.
        overwrite: replace earlier results.
    """

    rows = sorted(found.rooms, key=_most_pressing)
    first = {f"room_{number:03d}": room for number, room in enumerate(rows[:pages_of], 1)}
    links = {room.room.name: f"{name}.html" for name, room in first.items()}

    def page(plans: Sequence[Mapping[str, str]]) -> str:
        template = pages().get_template("room_survey.html.j2")
        return template.render(
            tell=tell, lang=spoken(), run=run, messages=run.get("messages", ()),
            about=_about(descriptions, scale),
            told=words.closing(found, limit),
            recordings=max(room.recordings for room in found.rooms),
            rooms=[{**_row(room, limit), "page": links.get(room.room.name)} for room in rows],
            frictions=words.frictions(found.rooms),
            not_considered=words.not_considered(found.rooms[0]),
        )  # fmt: skip

    def pages_of_rooms(folder: Path) -> None:
        for name, room in first.items():
            plan = {"file": f"{name}.png", "caption": plan_caption()}
            text = page_of(room, run, [plan], description=descriptions[room.room.name], scale=scale)
            (folder / links[room.room.name]).write_text(text, encoding="utf-8")

    write_folder(
        folder, run, overwrite=overwrite, tables={"rooms": table_of(found), **tables_of_all(found)},
        pictures=(plan_of(room, name) for name, room in first.items()), page=page,
        finish=pages_of_rooms,
    )  # fmt: skip


def _about(descriptions: Mapping[str, str], scale: float) -> str:
    """By what the rooms were shaken: of the floors of a building the first few."""
    told = named(list(dict.fromkeys(descriptions.values())), MOST_NAMED)
    return told if scale == 1.0 else told + tell(", multiplied by {scale:g}", scale=scale)


def tables_of_all(found: RoomSurvey) -> dict[str, pd.DataFrame]:
    """Things, places and ways of all rooms, with the name of each room."""
    each = [(room.room.name, tables_of(room)) for room in found.rooms]
    return {
        name: pd.concat([table[name].assign(room=room) for room, table in each], ignore_index=True)
        for name in ("things", "places", "ways")
    }


def table_of(found: RoomSurvey) -> pd.DataFrame:
    """A row for each room; shares of 1."""
    rows: list[dict[str, object]] = []
    for room in found.rooms:
        way, hit = worst_way(room), worst_hit(room)
        always = way is not None and not way.open_before
        rows.append(
            {
                "room": room.room.name,
                "floor": room.room.floor,
                "things": len(room.things),
                "not_simulated": len(room.left_out),
                "runs": room.runs,
                "recordings": room.recordings,
                "way_from": way.place if way else "",
                "closed_share": closed_share(way) if way else None,
                "closed_low": (1.0 if always else way.closed.low) if way else None,
                "closed_high": (1.0 if always else way.closed.high) if way else None,
                "closed_friction": way.friction if way else None,
                "open_before": way.open_before if way else None,
                "place": hit.place.name if hit else "",
                "hit_share": hit.hit.value if hit else None,
                "hit_low": hit.hit.low if hit else None,
                "hit_high": hit.hit.high if hit else None,
                "hit_friction": hit.friction if hit else None,
                "people_hit": room.hits,
                "not_shaken": "",
            }
        )
    for refused, reason in found.refused:
        rows.append({"room": refused.name, "floor": refused.floor, "not_shaken": reason})
    return pd.DataFrame(rows)


def _most_pressing(room: RoomAssessment) -> tuple[float, float]:
    way = worst_way(room)
    return (-closed_share(way), -way.closed.high) if way else (0.0, 0.0)


def _row(room: RoomAssessment, limit: float) -> dict[str, object]:
    way, hit = worst_way(room), worst_hit(room)
    return {
        "name": room.room.name,
        "floor": room.room.floor or "–",
        "way": words.closed(way, room) if way else "–",
        "from": way.place if way else "–",
        "by": words.by_what(way.by) if way else "–",
        "hit": f"{hit.place.name}: {words.often(hit.hit, hit.friction, room)}" if hit else "–",
        "hits": number(room.hits, ".2f"),
        "over": bool(way and closed_share(way) > limit),
    }
