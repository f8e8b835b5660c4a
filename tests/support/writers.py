"""Which of its arguments a function writes to, itself or by what it calls: read off the source."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import shaketable

PACKAGE = Path(shaketable.__file__).parent


class Function(NamedTuple):
    """A function of a module, by its source."""

    source: ast.FunctionDef
    arguments: tuple[str, ...]
    answers: bool  # it returns a bool
    names: Mapping[str, frozenset[str]]  # of the arguments that each local name is a part of


def functions(folder: str) -> dict[str, Function]:
    """The functions of a folder's modules, by their names."""
    found = {}
    for path in sorted((PACKAGE / folder).glob("*.py")):
        for each in ast.parse(path.read_text()).body:
            if isinstance(each, ast.FunctionDef):
                assert each.name not in found, f"{path}: {each.name} is there twice"
                found[each.name] = _read(each)
    return found


def writes(found: Mapping[str, Function]) -> dict[str, set[str]]:
    """The arguments that each function writes to."""
    written = {name: set(_written_here(each)) for name, each in found.items()}
    grows = True
    while grows:
        before = sum(map(len, written.values()))
        for name, each in found.items():
            for call in ast.walk(each.source):
                if isinstance(call, ast.Call) and isinstance(call.func, ast.Name):
                    called = found.get(call.func.id)
                    pairs = zip(called.arguments, call.args, strict=False) if called else ()
                    for argument, given in pairs:
                        if argument in written[call.func.id]:
                            written[name] |= each.names.get(_whole(given), frozenset())
        grows = sum(map(len, written.values())) > before
    return written


def _read(source: ast.FunctionDef) -> Function:
    arguments = tuple(each.arg for each in source.args.args)
    names = {name: frozenset({name}) for name in arguments}
    for target, value in _assigned(source):
        if isinstance(target, ast.Name) and isinstance(value, ast.Attribute | ast.Subscript):
            part = names.get(_whole(value), frozenset())
            names[target.id] = names.get(target.id, frozenset()) | part
    answers = isinstance(source.returns, ast.Name) and source.returns.id == "bool"
    return Function(source, arguments, answers, names)


def _written_here(function: Function) -> Iterator[str]:
    """The arguments into which a function itself puts something."""
    targets = [target for target, _ in _assigned(function.source)]
    targets += [
        each.target for each in ast.walk(function.source) if isinstance(each, ast.AugAssign)
    ]
    for target in targets:
        if isinstance(target, ast.Attribute | ast.Subscript):
            yield from function.names.get(_whole(target), ())


def _assigned(source: ast.FunctionDef) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Targets and values of the assignments, those of tuples one by one."""
    for each in ast.walk(source):
        if isinstance(each, ast.Assign):
            for target in each.targets:
                if not isinstance(target, ast.Tuple):
                    yield target, each.value
                elif isinstance(each.value, ast.Tuple):
                    yield from zip(target.elts, each.value.elts, strict=True)
                else:
                    yield from ((part, each.value) for part in target.elts)


def _whole(part: ast.expr) -> str:
    """The name of which an expression is a part; "" if it is of none."""
    while isinstance(part, ast.Attribute | ast.Subscript):
        part = part.value
    return part.id if isinstance(part, ast.Name) else ""
