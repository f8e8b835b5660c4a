"""The sentences that the code tells, as they stand in it."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TypeGuard

from shaketable.engine import endings
from shaketable.physics.space import ending
from shaketable.report import page
from tests.support.imports import FILES, PACKAGE

TELLS = ("tell", "translated")
#: What is logged where the main job reads, simulates and assesses is told in every language.
PLAIN = ("%s", "%s %s", "%s: %s")  # what is told already
LOGS = ("assess", "building", "inventory", "records", "signal", "simulate", "tables")
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
            elif _logs(node) and path.relative_to(PACKAGE).parts[0] in LOGS:
                yield from (each for each in _texts(node.args[0]) if each not in PLAIN)
    for some in (endings.SENTENCES, ending.SENTENCES):
        yield from some.values()


def _logs(node: ast.AST) -> TypeGuard[ast.Call]:
    """Whether a warning is logged."""
    return (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr == "warning"
        and isinstance(node.func.value, ast.Name)
        and node.func.value.id == "log"
    )


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
