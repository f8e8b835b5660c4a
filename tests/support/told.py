"""The sentences that the code tells, as they stand in it."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path

from shaketable.report import page
from tests.support.imports import FILES

TELLS = ("tell", "translated")
TEMPLATES = Path(inspect.getfile(page)).parent
TOLD = re.compile(r'tell\("([^"]*)"')


def sentences() -> Iterator[str]:
    """Every text that is written out as what is told or translated, also as one of two."""
    for template in sorted(TEMPLATES.glob("*.j2")):
        yield from TOLD.findall(template.read_text(encoding="utf-8"))
    for path in FILES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                if node.func.id in TELLS and node.args:
                    yield from _texts(node.args[0])
                elif node.func.id == "counted" and len(node.args) == 2:
                    for thing in _texts(node.args[1]):
                        first, of, rest = thing.partition(" of ")
                        yield from (thing, f"{first}s{of}{rest}")


def literals() -> Iterator[str]:
    """Every text that is written out anywhere in the code."""
    for path in FILES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value


def _texts(node: ast.expr) -> Iterator[str]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from _texts(node.body)
        yield from _texts(node.orelse)
