"""`shaketable serve`: what its options hand to the server, which is tested by itself."""

from __future__ import annotations

import socket

import pytest

from tests.support.command import refused, shaketable

pytest.importorskip("pebble", reason="the extra web is not installed: pip install '.[web]'")


def free_port() -> int:
    with socket.socket() as listens:
        listens.bind(("127.0.0.1", 0))
        return int(listens.getsockname()[1])


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[tuple[object, ...]]:
    """What the server is given; it does not run."""
    found: list[tuple[object, ...]] = []
    monkeypatch.setattr("shaketable.web.server.serve", lambda *given: found.append(given))
    return found


@pytest.mark.parametrize(
    ("option", "value", "place"),
    [
        ("--host", "0.0.0.0", 0),
        ("--port", None, 1),  # another one that is free
        ("--workers", 2, 2),
        ("--root-path", "/shake", 3),
        ("--name", "shake.example.org", 4),
    ],
)
def test_its_options_reach_the_server(
    served: list[tuple[object, ...]], option: str, value: object, place: int
) -> None:
    port, value = free_port(), free_port() if value is None else value
    for words in (("--port", port), ("--port", port, option, value)):
        run = shaketable("serve", *words)
        assert run.returncode == 0, run.stderr
    one, other = served
    assert one == ("127.0.0.1", port, None, "", ())
    if option == "--name":
        value = [value]  # of several
    assert other == (*one[:place], value, *one[place + 1 :])


def test_other_machines_are_told_of(served: list[tuple[object, ...]]) -> None:
    run = shaketable("serve", "--port", free_port(), "--host", "0.0.0.0")
    assert "Whoever reaches this machine can use the page." in run.stdout + run.stderr
    assert len(served) == 1


def test_a_port_that_is_taken() -> None:
    with socket.socket() as listens:
        listens.bind(("127.0.0.1", 0))
        listens.listen()
        port = listens.getsockname()[1]
        assert f"--port {port}: cannot listen there" in refused("serve", "--port", port)
    assert "must begin with a /" in refused("serve", "--root-path", "shake")
