"""CPU seconds of the tests and fixtures, with those of the processes that they wait for.

`pytest --costs 20` prints the twenty dearest files, fixtures and tests.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Generator

import pytest


def cpu_seconds() -> float:
    return sum(os.times()[:4])


class Costs:
    def __init__(self, count: int) -> None:
        self.count = count
        self.fixtures: list[tuple[str, float]] = []
        self.files: Counter[str] = Counter()
        self.tests: Counter[str] = Counter()
        self.made: Counter[str] = Counter()

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(
        self, fixturedef: pytest.FixtureDef[object]
    ) -> Generator[None, object, object]:
        begun = cpu_seconds()
        try:
            return (yield)
        finally:
            name = f"{fixturedef.baseid}::{fixturedef.argname}"
            self.fixtures.append((name, cpu_seconds() - begun))

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None, bool, bool]:
        self.begun = cpu_seconds()
        return (yield)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_teardown(self, item: pytest.Item) -> None:
        """What is reported of the teardown carries it to the process that sums up."""
        item.user_properties.append(("cpu", cpu_seconds() - self.begun))
        item.user_properties.append(("fixtures", self.fixtures))
        self.fixtures = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        told = dict(report.user_properties)
        if report.when == "teardown" and "cpu" in told:
            self.files[report.nodeid.partition("::")[0]] += told["cpu"]
            self.tests[report.nodeid] += told["cpu"]
            for name, seconds in told["fixtures"]:
                self.made[name] += seconds

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        total = sum(self.files.values())
        terminalreporter.section(f"CPU seconds of all tests: {total:.0f}")
        for title, costs in (
            ("files", self.files),
            ("fixtures, all times that they were made", self.made),
            ("tests, with the fixtures made for them", self.tests),
        ):
            terminalreporter.write_line(f"\nthe dearest {title}")
            for name, seconds in costs.most_common(self.count):
                terminalreporter.write_line(f"{seconds:8.1f}  {name}")
