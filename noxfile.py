"""The package in clean environments: `nox`, or one session, as `nox -s install-3.12`.

Interpreters that are not on this machine are skipped, but on CI, where the workflow files ask for
those that they have set up.
"""

from __future__ import annotations

import os
from pathlib import Path

import nox

PYTHONS = ["3.11", "3.12", "3.13", "3.14"]
EXTRAS = ("parquet", "campaign", "cluster", "scenario", "rooms", "gltf", "docx", "web")

nox.options.default_venv_backend = "uv"
nox.options.sessions = ["install", "lowest", "extras", "lint"]
nox.options.error_on_missing_interpreters = "CI" in os.environ
nox.options.download_python = "never"


def built(session: nox.Session, kind: str) -> str:
    """The path of a fresh wheel or sdist."""
    session.install("hatchling")
    folder = Path(session.create_tmp())
    session.run("python", "-m", "hatchling", "build", "-t", kind, "-d", str(folder))
    return str(max(folder.glob("*.whl" if kind == "wheel" else "*.tar.gz")))


@nox.session(python=PYTHONS)
@nox.parametrize("kind", ["wheel", "sdist"])
def install(session: nox.Session, kind: str) -> None:
    """The newest dependencies, without any extra."""
    session.install(built(session, kind))
    session.run("python", "scripts/smoke.py")


@nox.session(python=PYTHONS)
def lowest(session: nox.Session) -> None:
    """The lowest versions of the dependencies that pyproject.toml names."""
    session.install("--resolution", "lowest-direct", built(session, "wheel"))
    session.run("python", "scripts/smoke.py")


@nox.session(python=PYTHONS)
def extras(session: nox.Session) -> None:
    """All extras but the GPU's and the studies'."""
    session.install(f"{built(session, 'wheel')}[{','.join(EXTRAS)}]")
    session.run("python", "scripts/smoke.py", *EXTRAS)


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """The tests, but the long ones and those of the page."""
    session.install("-e", ".[test,cluster,scenario]", "-e", "./studies")
    session.run("python", "-m", "pytest", "-n", "auto", "-m", "not slow and not web")


@nox.session(python="3.11")
def lint(session: nox.Session) -> None:
    """Style and types, with the pinned versions."""
    session.install("--require-hashes", "-r", "requirements-test.lock")
    session.install("--no-deps", "-e", ".", "-e", "./studies")
    session.run("ruff", "format", "--check", ".")
    session.run("ruff", "check", ".")
    session.run("mypy")


@nox.session(python="3.11")
def docs(session: nox.Session) -> None:
    """The site, with every example run."""
    session.install("-e", ".[docs]", "-e", "./studies")
    session.run(
        "sphinx-build", "-q", "-W", "--keep-going", "-b", "html", "docs", "docs/_build/html"
    )
