"""No message that a terminal shows speaks Python."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

import pytest

from shaketable import InputError
from shaketable.cli.spelling import as_options
from tests.support.command import shaketable
from tests.support.imports import FILES, PACKAGE

#: A keyword with its value or none, a call, or a class.
PYTHON = re.compile(
    r"\b(?!investigation_time|imt)[a-z_]+=(?=True|False|None|'|[A-Z]\w*\(|[\s,;.)]|$)|\b\w+\((\.\.\.|\))"
)
#: What is about Python alone, or no Python: the options of a table, a call of the page's server.
ELSEWHERE = ("web", "cli", "plot")


def messages() -> Iterator[tuple[str, str]]:
    """The texts of errors, where values stand for a number."""
    for path in FILES:
        if path.relative_to(PACKAGE).parts[0] in ELSEWHERE:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            called = (
                node.func.id
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
                else ""
            )
            if called in ("InputError", "refused", "tell", "require"):
                for one in node.args:
                    text = text_of(one)
                    if text:
                        yield f"{path.name}:{node.lineno}", text


def text_of(node: ast.expr) -> str:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(
            str(part.value) if isinstance(part, ast.Constant) else "7" for part in node.values
        )
    return ""


def test_no_error_speaks_python_to_a_terminal() -> None:
    every = list(messages())
    assert len(every) > 300
    assert sum(PYTHON.search(text) is not None for _, text in every) > 5  # they are found
    left = [(where, as_options(text)) for where, text in every if PYTHON.search(as_options(text))]
    assert left == []


@pytest.mark.parametrize(
    ("python", "options"),
    [
        ("device='cuda': no GPU is to be had", "--device cuda: no GPU is to be had"),
        ("static_friction= is for the general model: give model=General(...)",
         "--static-friction is for the general model: give --model general"),
        ("Rocking(restitution=0.8) is for planar=True: solids know General(...) and Rocking() "
         "without restitution=",
         "--restitution 0.8 is for --planar: in three dimensions --model general or no "
         "--restitution is known"),
        ("demand= must be one of floor, ground", "--demand must be one of floor, ground"),
        ("a sheet = \"…\" stays", "a sheet = \"…\" stays"),
    ],
)  # fmt: skip
def test_words_of_python_become_options(python: str, options: str) -> None:
    assert as_options(python) == options


def test_the_command_says_it_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> None:
        raise InputError("surroundings= is not for a GPU; leave device='cuda'")

    monkeypatch.setattr("shaketable.cli.app", refuse)
    run = shaketable("suites")
    assert run.returncode == 2
    assert run.stderr == "error: --surroundings is not for a GPU; leave --device cuda\n"
