"""The first part of a report as a Word document, for those who must paste it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path, PurePath
from typing import Any

from shaketable.assess import Assessment
from shaketable.building import Building
from shaketable.errors import printable
from shaketable.language import tell
from shaketable.report import first_part
from shaketable.report.words import headline, method

TICK = "\u2610 "


def write_docx(
    assessment: Assessment, run: Mapping[str, Any], building: Building | None, path: Path
) -> None:
    """Write what first, room by room, and how sure.

    Args:
        assessment: what was found.
        run: what the run log holds.
        building: whose floors were assessed, if there is one.
        path: of the document.
    """
    from docx import Document

    ranked = assessment.ranked()
    document = Document()
    document.add_heading(tell("What falls in an earthquake, and what to do"), 0)
    name = PurePath(str(run["inventory"]["path"])).name
    document.add_paragraph(_shown(f"{name} · {run['finished']}"))
    for sentence in headline.headline(assessment):
        document.add_paragraph(_shown(sentence))
    document.add_heading(tell("What to do first"), 1)
    heads = (tell("object"), tell("risk"), tell("to do first"), tell("with what"), tell("by whom"))
    table = document.add_table(rows=1, cols=len(heads))
    table.style = "Light Grid Accent 1"
    for cell, head in zip(table.rows[0].cells, heads, strict=True):
        cell.text = head
    rows = first_part.rows(assessment, ranked)
    for row in rows:
        done = f"{row.measure}: {row.outcome}" if row.outcome else row.measure
        done = f"{done}\n{row.instead}" if row.instead else done
        texts = (f"{TICK}{row.name}\n{row.where}", row.told, done, row.takes, row.who)
        for cell, text in zip(table.add_row().cells, texts, strict=True):
            cell.text = _shown(text)
    document.add_paragraph(method.of_what(assessment))
    if any(row.holds for row in rows):
        document.add_paragraph(method.forces())
    document.add_heading(tell("How sure is that"), 1)
    for sentence in headline.how_sure(assessment):
        document.add_paragraph(_shown(sentence))
    document.add_paragraph(_shown(method.not_considered(assessment)))
    document.add_heading(
        tell("Floor by floor")
        if building is not None
        else tell("Room by room, by the part that falls"),
        1,
    )
    for place in first_part.places(assessment, building):
        document.add_heading(_shown(place.name), 2)
        if place.told:
            document.add_paragraph(_shown(place.told))
        for thing in place.things:
            document.add_paragraph(
                _shown(f"{TICK}{thing.quantity} × {thing.name}: {thing.measure} ({thing.share})")
            )
    document.add_paragraph(tell("Seen and decided"))
    for word in (tell("Date"), tell("Name"), tell("Signature")):
        document.add_paragraph(f"{word}: {'_' * 30}")
    document.save(str(path))


def _shown(text: str) -> str:
    """A text without characters that XML cannot hold: they are written as escapes."""
    return "\n".join(map(printable, text.split("\n")))
