"""Runs what the pages tell to type: every `shaketable` command, every block of Python.

python docs/run_pages.py                 all pages, but for what takes minutes
python docs/run_pages.py --long          that, too
python docs/run_pages.py how_to/rooms.md README.md

Each page has a folder of its own, where files stand in for those that it names. Its commands are
run from its top to its end, then all its Python together. A command has to end with exit code 0,
and where a page shows what it prints (below it, or in the block of text that follows), it has
to print that. Exit code 1 if anything fails.
"""

from __future__ import annotations

import argparse
import csv
import os
import re
import shlex
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import openpyxl

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.support.record_files import at2, csmip, shaking, write_at2  # noqa: E402

PAGES = ("docs/tutorials", "docs/how_to", "docs/reference", "docs/explanation", "docs/project")
#: Not run, and why. What matches the first word is looked for in the command.
LEFT_OUT = {
    r"\bstudy \S+ --out": "takes minutes; each study has tests of its own",
    r"campaign (run|collect).* p58": "takes minutes; tests/library runs a small library",
    r"--scheduler": "needs a cluster; tests/campaign runs one",
    r"calibrate tests\.csv": "needs the table's recorded motions, which are not public domain",
    r"shaketable( serve.*)?$": "never ends; tests/web starts the server",
    r"room design examples/hospital_room": "takes two minutes",
    r"assess examples/clinic\.csv": "takes two minutes",
}
LONG = (r"\bstudy \S+ --out", r"room design examples", r"assess examples/clinic")
LIST = "name,depth_m,width_m,height_m\nBookcase,0.32,0.90,1.80\nCabinet,0.45,0.80,1.30\n"
DONE: set[str] = set()  # commands that were run
#: What the pages' Python takes as given.
GIVEN = """
import numpy, shaketable
bodies = [shaketable.Body.rectangle(0.2 * h, h) for h in (0.5, 1.0, 1.5)]
longitudes, latitudes = numpy.array([-70.9, -70.6]), numpy.array([-33.5, -33.3])
medians, betas = numpy.array([0.4, 0.6]), numpy.array([0.4, 0.4])
"""


class Step(NamedTuple):
    """Something to do on a page: a command with what it prints, or a block of Python."""

    kind: str
    text: str
    printed: str = ""


def steps_of(text: str) -> list[Step]:
    """The commands and the Python of a page, from its top to its end."""
    found: list[Step] = []
    text = re.sub(r"\\\n\s*", "", text)
    for block in re.finditer(
        r"^```(\w+)\n(.*?)^```|^((?:    [^\n]*\n|\n(?=    ))+)", text, re.MULTILINE | re.DOTALL
    ):
        language, fenced, indented = block.groups()
        if language == "python" and ">>>" not in fenced:
            found.append(Step("python", fenced))
        elif language in ("console", None):
            lines = [line.removeprefix("    ") for line in (fenced or indented).splitlines()]
            found += _commands([line for line in lines if line])
        elif language == "text" and fenced.startswith("name,"):
            found.append(Step("list", fenced))
        elif language == "text" and found and found[-1].kind == "command":
            found[-1] = found[-1]._replace(printed=fenced)
    return found


def _commands(lines: list[str]) -> list[Step]:
    found: list[Step] = []
    for line in lines:
        words = line.removeprefix("$ ")
        if re.match(r"shaketable( |$)", words):
            found.append(Step("command", words.split("   #")[0].rstrip()))
        elif found and line.strip() and line[0] != "$" and lines[0].startswith("$"):
            last = found[-1]
            found[-1] = last._replace(printed=f"{last.printed}\n{line}".strip())
    return found


def furnish(folder: Path) -> None:
    """Write the files that pages name: lists, records, a building, a hazard curve."""
    shutil.copytree(ROOT / "examples", folder / "examples")
    shutil.copytree(ROOT / "library", folder / "library")
    for name in ("rooms.csv", "store.csv"):
        (folder / name).write_text(LIST, encoding="utf-8")
    workbook = openpyxl.Workbook()
    for row in csv.reader(LIST.splitlines()):
        workbook.active.append(row)
    workbook.save(folder / "rooms.xlsx")
    header, bookcase, cabinet = LIST.splitlines()
    on_floors = f"{header},floor\n{bookcase},0\n{cabinet},2\n"
    (folder / "things.csv").write_text(on_floors, encoding="utf-8")
    for name in ("record.AT2", "RSN1004.AT2", "roof.AT2"):
        (folder / name).write_text(at2(2000), encoding="latin-1")
    for name in ("station.V2", "CE36456.V2"):
        (folder / name).write_text(csmip(600), encoding="latin-1")
    (folder / "my_records").mkdir()
    for code in ("000", "090"):
        name = f"RSN1_QUAKE_STA{code}.AT2"
        write_at2(folder / "my_records", name, code, 0.001 * shaking(2000, seed=int(code)))
    (folder / "plans").mkdir()
    for name in ("hospital_room", "laboratory_room"):
        shutil.copy(ROOT / "examples" / f"{name}.toml", folder / "plans")
    shutil.copy(ROOT / "examples" / "clinic.toml", folder / "clinic.toml")
    shutil.copy(ROOT / "examples" / "clinic.toml", folder / "building.toml")
    shutil.copy(ROOT / "examples" / "hazard.csv", folder / "curve.csv")
    shutil.copy(ROOT / "examples" / "hazard.csv", folder / "hazard_curve-mean-PGV_1.csv")
    for name in ("grid.xml", "uncertainty.xml"):
        shutil.copy(ROOT / "examples" / "shakemap" / name, folder)


def run(page: Path, long: bool) -> list[str]:
    """Work through a page; what failed."""
    failed: list[str] = []
    servers: list[subprocess.Popen[bytes]] = []
    python = GIVEN
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        furnish(folder)
        for step in steps_of(page.read_text(encoding="utf-8")):
            begun = time.monotonic()
            if step.kind == "list":  # the next command's, by its name
                pending = step.text
                for name in ("ward.csv", "vases.csv"):
                    (folder / name).write_text(pending, encoding="utf-8")
                continue
            if step.kind == "python":
                python += step.text
                continue
            if re.match(r"shaketable serve --port \d+$", step.text):
                servers.append(_serve(step.text, folder))
                continue
            reason = _left_out(step.text, long)
            if not step.printed and step.text in DONE and " campaign " not in step.text:
                reason = "was run for another page"
            if reason:
                print(f"left out: {step.text}: {reason}", flush=True)
                continue
            said = subprocess.run(  # noqa: S603  our own pages
                [sys.executable, "-m", *_words(step.text, folder)],
                cwd=folder, capture_output=True, text=True, env=os.environ | {"COLUMNS": "400"},
            )  # fmt: skip
            seconds = time.monotonic() - begun
            print(f"{seconds:6.1f} s  {step.text}", flush=True)
            if said.returncode == 0:
                DONE.add(step.text)
            else:
                failed.append(f"{page}: {step.text}: exit {said.returncode}: {said.stderr[-600:]}")
            for line in step.printed.splitlines():
                if line.strip("─") and _plain(line) not in _plain(said.stdout):
                    failed.append(f"{page}: {step.text}: does not print: {line}")
        if python != GIVEN:
            said = subprocess.run(  # noqa: S603
                [sys.executable, "-c", python], cwd=folder, capture_output=True, text=True
            )
            print(f"        the Python of {page.name}", flush=True)
            if said.returncode:
                failed.append(f"{page}: {said.stderr[-900:]}")
        for server in servers:
            server.terminate()
            server.wait()
    return failed


def _serve(command: str, folder: Path) -> subprocess.Popen[bytes]:
    """A server that answers; it is ended after its page."""
    words = [sys.executable, "-m", *shlex.split(command)]
    server = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL)  # noqa: S603
    port = int(command.split()[-1])
    for _ in range(600):
        if server.poll() is not None:
            sys.exit(f"{command}: exit {server.returncode}")
        try:
            socket.create_connection(("127.0.0.1", port)).close()
        except OSError:
            time.sleep(0.1)
        else:
            return server
    sys.exit(f"{command}: does not answer")


def _words(command: str, folder: Path) -> list[str]:
    """The words of a command, with the files that a pattern means, as a shell gives them."""
    words: list[str] = []
    for word in shlex.split(command):
        found = sorted(folder.glob(word)) if "*" in word else []
        words += [str(path.relative_to(folder)) for path in found] or [word]
    return words


def _left_out(command: str, long: bool) -> str:
    if long and any(re.search(each, command) for each in LONG):
        return ""
    return next((why for what, why in LEFT_OUT.items() if re.search(what, command)), "")


def _plain(text: str) -> str:
    return " ".join(text.split())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pages", nargs="*")
    parser.add_argument("--long", action="store_true")
    given = parser.parse_args()
    pages = [ROOT / "README.md", ROOT / "studies" / "README.md"]
    for place in PAGES:
        pages += sorted((ROOT / place).glob("*.md"))
    if given.pages:
        pages = [page for page in pages if any(str(page).endswith(name) for name in given.pages)]
        if len(pages) < len(given.pages):
            parser.error("some of these are no pages")
    failed = [each for page in pages for each in run(page, given.long)]
    print("\n".join(failed))
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
