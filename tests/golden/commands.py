"""Every command with small files: what it says, and the text and numbers of the files it writes."""

from __future__ import annotations

import json
import re
import socket
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import shaketable
from tests.support import command
from tests.support.small_files import DRUM, EXAMPLES, FEW, PLAIN, QUAKE, SIZE, SOLID, UPRIGHT, WHERE

PACKAGE = Path(shaketable.__file__).parent
#: What each command is called with, by a name for it.
CALLS = {
    **{name: f"{name} {words}".strip() for name, words in PLAIN.items()},
    "assess in space": f"assess list.csv {UPRIGHT} --pga-levels 0.2g --out out",
    "assess in a building": f"assess list.csv {FEW} --planar --building house.toml --out out",
    "simulate in space": f"simulate {SOLID}",
    "simulate a cylinder": f"simulate {DRUM}",
    "fragility, exported": f"fragility {SIZE} {FEW} --export nrml,pelicun --out out",
    "scenario by ShakeMap": f"scenario campus.csv {FEW} {WHERE} --map-sigma 0.6 --out out",
    "scenario at a distance": f"scenario list.csv {QUAKE} {FEW} --vs30 300 --out out",
    "campaign": "campaign run campaign.toml --workers 1 --store store && "
    "campaign collect store --out out",
    "suites": "suites",
}
#: Of what a result's JSON says of its run: when, where and with which versions.
OF_THE_RUN = {
    "command", "folder", "started", "finished", "versions", "environment",
    "environment_of_this_table",
}  # fmt: skip
NO_TEXT = {".png", ".gif", ".svg", ".jpg", ".parquet", ".xlsx", ".npz"}


class _Text(HTMLParser):
    """The text of a page, a line for each piece."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[str] = []
        self._hidden = 0

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self._hidden += tag in ("style", "script", "svg")

    def handle_endtag(self, tag: str) -> None:
        self._hidden -= tag in ("style", "script", "svg")

    def handle_data(self, data: str) -> None:
        if not self._hidden and (line := " ".join(data.split())):
            self.lines.append(line)


def _of_page(text: str) -> str:
    page = _Text()
    page.feed(text)
    return "\n".join(page.lines)


def _without_run(told: Any) -> Any:
    if isinstance(told, dict):
        return {key: _without_run(each) for key, each in told.items() if key not in OF_THE_RUN}
    return [_without_run(each) for each in told] if isinstance(told, list) else told


def _content(path: Path) -> str:
    text = path.read_text("utf-8")
    if path.suffix == ".html":
        return _of_page(text)
    if path.suffix == ".json":
        return json.dumps(_without_run(json.loads(text)), indent=1, ensure_ascii=False)
    return text


def _timeless(text: str, folder: Path) -> str:
    """Without what differs from day to day and from machine to machine."""
    for place, word in ((EXAMPLES, "EXAMPLES"), (folder, "FOLDER"), (PACKAGE, "PACKAGE")):
        text = text.replace(str(place), word)
    text = re.sub(r"\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d)?(\+\d\d:\d\d|Z)?)?", "DATE", text)
    text = re.sub(r"\bshaketable \d+\.\d+\S*", "shaketable VERSION", text)
    text = text.replace(socket.gethostname(), "HOST")
    return re.sub(r"^(work|bytes) .*$", r"\1", text, flags=re.MULTILINE)  # of a campaign


def called(name: str, folder: Path) -> str:
    """What a call says and writes in a folder of small files, as text."""
    before, parts = set(folder.rglob("*")), []
    for words in CALLS[name].split("&&"):
        run = command.shaketable(*words.split(), cwd=folder)
        parts += [f"exit {run.returncode}", run.stdout, run.stderr]
    for path in sorted(set(folder.rglob("*")) - before):
        place = path.relative_to(folder)
        if path.is_file() and place.parts[0] != "store":
            parts.append(f"==== {place}")
            if path.suffix not in NO_TEXT:
                parts.append(_content(path))
    return _timeless("\n".join(parts), folder).rstrip()
