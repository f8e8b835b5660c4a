"""Pages of the site that are made from the code: one for each public name, one for each command.

Their folders, `reference/api` and `reference/commands`, are not kept in the repository.
"""

from __future__ import annotations

import re
import shutil
import tomllib
from importlib import import_module
from inspect import isclass, isfunction, ismodule
from pathlib import Path
from typing import Any, NamedTuple

import typer

import shaketable
from shaketable.cli import app
from shaketable.cli.lazy import SUMMARIES


def write_library(folder: Path, table: Path) -> None:
    """Write the page that searches a published library.

    Args:
        folder: for the page, which is called as the table.
        table: its rows; beside it lies the TOML file from which they were made.
    """
    from shaketable.library.published import read_library_table
    from shaketable.report.library import render

    folder.mkdir(exist_ok=True)
    library = tomllib.loads(table.with_suffix(".toml").read_text(encoding="utf-8"))["library"]
    page = render(
        read_library_table(table), library["title"], library["edition"], {},
        published=f"{table.parent.name}/{table.stem}",
    )  # fmt: skip
    (folder / f"{table.stem}.html").write_text(page, encoding="utf-8")


class Group(NamedTuple):
    """Names that belong together, with the pages that tell how to use them."""

    title: str
    names: tuple[str, ...]
    guides: tuple[str, ...]


#: By the titles of python.md: what to read beside a name.
GUIDES = {
    "Bodies and supports": ("how_to/surroundings", "explanation/solids"),
    "Motions": ("how_to/motions", "reference/formats"),
    "Simulations": ("reference/results", "explanation/theory", "how_to/campaigns"),
    "Lists of objects": ("how_to/assessing", "how_to/floors"),
    "Rooms": ("how_to/rooms",),
    "Fragility, hazard and risk": ("how_to/fragility", "how_to/hazard", "how_to/floors"),
    "Tests and uncertainty": ("explanation/validation",),
}
#: Modules with more names than the package itself hands out, and their pages.
ROOMS = {
    "rooms": ("how_to/rooms",),
    "criteria": ("how_to/criteria", "explanation/boroschek_romo_2004"),
    "tilting": ("how_to/tilting", "explanation/boroschek_iruretagoyena_2006"),
    "signal": ("how_to/motions",),
    "synthesis": ("how_to/motions", "how_to/floors"),
    "building": ("how_to/floors",),
    "fragility": ("how_to/fragility",),
    "hazard": ("how_to/hazard",),
    "calibration": ("explanation/validation",),
    "plot": ("gallery_of_examples/index",),
}


def write_api(reference: Path) -> None:
    """A page for each public name, and one that lists them all."""
    folder = reference / "api"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    parts = [_heading("API reference", "="), _API]
    for group in groups((reference / "python.md").read_text(encoding="utf-8")):
        parts.append(_table(group.title, "shaketable", group.names))
        for name in group.names:
            (folder / f"shaketable.{name}.rst").write_text(_page("shaketable", name, group))
    for room, guides in ROOMS.items():
        module = f"shaketable.{room}"
        names = tuple(n for n in import_module(module).__all__ if _is_told(module, n))
        parts.append(_table(f"More in ``{module}``", module, names))
        group = Group(room, names, guides)
        for name in names:
            (folder / f"{module}.{name}.rst").write_text(_page(module, name, group))
    (folder / "index.rst").write_text("\n".join(parts))


_API = """
Every public name, with its parameters, units and shapes. The names of the first sections are the
package's own (``from shaketable import Body``): they are kept, or deprecated for one minor version
before they go. The names below "More in" are imported from their module and may still change.
:doc:`/reference/python` shows the main ones at work; quantities are in SI and radians unless the
name says otherwise (``tilt_deg``).
"""


def groups(page: str) -> list[Group]:
    """The sections of python.md with the names of their tables."""
    found = []
    for section in page.split("\n## ")[1:]:
        title, _, text = section.partition("\n")
        rows = re.findall(r"^\| (`[^|]+) \|", text, re.MULTILINE)
        names = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
        own = tuple(name for name in names if name in shaketable.__all__)
        if own:
            found.append(Group(title, own, GUIDES[title]))
    return found


def _is_told(module: str, name: str) -> bool:
    """Whether a module's name gets a page: no constant, and none that the package hands out."""
    thing = getattr(import_module(module), name)
    if name in shaketable.__all__ and getattr(shaketable, name) is thing:
        return False
    return isclass(thing) or isfunction(thing) or ismodule(thing)


def _heading(title: str, line: str) -> str:
    return f"{title}\n{line * len(title)}\n"


def _table(title: str, module: str, names: tuple[str, ...]) -> str:
    """The names of a group with the first sentence of each."""
    rows = "".join(
        f"   * - :py:obj:`{name} <{module}.{name}>`\n     - {_first_sentence(module, name)}\n"
        for name in names
    )
    pages = "".join(f"   {module}.{name}\n" for name in names)
    return (
        f"{_heading(title, '-')}\n.. currentmodule:: {module}\n\n"
        f".. list-table::\n   :widths: 30 70\n\n{rows}\n"
        f".. toctree::\n   :hidden:\n\n{pages}"
    )


def _first_sentence(module: str, name: str) -> str:
    text = getattr(import_module(module), name).__doc__ or ""
    return escaped(" ".join(text.split("\n\n")[0].split()))


def escaped(text: str) -> str:
    """With bars that are bars to reStructuredText: |a_x| is an absolute value."""
    return text.replace("|", "\\|")


def _page(module: str, name: str, group: Group) -> str:
    thing: Any = getattr(import_module(module), name)
    title = _heading(f"{module}.{name}", "=")
    if ismodule(thing):
        body = f".. automodule:: {module}.{name}\n   :members:\n"
    else:
        kind = "autoclass" if isclass(thing) else "autofunction"
        members = "   :members:\n" if isclass(thing) else ""
        body = f".. currentmodule:: {module}\n\n.. {kind}:: {name}\n{members}"
    beside = ", ".join(f":py:obj:`{each} <{module}.{each}>`" for each in _near(name, group.names))
    guides = ", ".join(f":doc:`/{guide}`" for guide in group.guides)
    also = f".. seealso::\n\n   {beside + ' · ' if beside else ''}{guides}\n"
    return f"{title}\n{body}\n{also}\n.. minigallery:: {module}.{name}\n   :add-heading: Examples\n"


def _near(name: str, names: tuple[str, ...], most: int = 6) -> tuple[str, ...]:
    """The names that stand beside one in its table."""
    place = names.index(name)
    first = max(0, min(place - most // 2, len(names) - most - 1))
    return tuple(each for each in names[first : first + most + 1] if each != name)


def write_commands(reference: Path) -> None:
    """A page for each command, from its help."""
    folder = reference / "commands"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    program: Any = typer.main.get_command(app)
    rows = "".join(f"| [`{name}`]({name}.md) | {line} |\n" for name, line in SUMMARIES.items())
    pages = "\n".join(SUMMARIES)
    (folder / "index.md").write_text(
        f"# Commands\n\n{_COMMANDS}\n\n| command | |\n|---|---|\n{rows}\n"
        f"```{{toctree}}\n:hidden:\n\n{pages}\n```\n"
    )
    for name in SUMMARIES:
        command = program.commands[name]
        text = _command(f"shaketable {name}", command, "#")
        (folder / f"{name}.md").write_text(text)


_COMMANDS = """Every command prints its help with `-h` and ends with exit code 0 when it is done, 1
when it failed, and 2 when the input has to be mended. Without any command, `shaketable` opens
[the page](../../how_to/web.md) in your browser. The pages below hold the text of each help."""


def _command(words: str, command: Any, level: str) -> str:
    """The help of a command, and of those below it."""
    epilog = command.epilog or ""
    examples = [line.strip() for line in epilog.splitlines() if line.startswith("  ")]
    text = f"{level} {words}\n\n{_paragraphs(command.help)}\n"
    below = getattr(command, "commands", {})
    shown = [each for each in examples if not below or each.startswith(words)]
    if shown and level == "#":
        text += "\n```console\n" + "".join(f"$ {each}\n" for each in shown) + "```\n"
    options = [each for each in command.params if getattr(each, "help", None) is not None]
    if options and not below:
        text += "\n| argument or option | meaning |\n|---|---|\n"
        text += "".join(_option(each) for each in options)
    for name, each in below.items():
        text += "\n" + _command(f"{words} {name}", each, level + "#")
    return text


def _paragraphs(text: str | None) -> str:
    return "\n\n".join(" ".join(part.split()) for part in (text or "").split("\n\n"))


def _option(option: Any) -> str:
    words = ", ".join(f"`{word}`" for word in option.opts) if option.opts else ""
    if option.param_type_name == "argument":
        words = f"`{(option.metavar or option.name).upper()}`"
    elif option.secondary_opts:
        words += ", " + ", ".join(f"`{word}`" for word in option.secondary_opts)
    default = option.default
    told = ""
    if isinstance(default, (int, float, str)) and not isinstance(default, bool) and default != "":
        told = f" Default: {default}."
    needed = " Required." if option.required else ""
    text = " ".join((option.help or "").split()).replace("|", "\\|").replace("<", "&lt;")
    return f"| {words} | {text}{needed}{told} |\n"
