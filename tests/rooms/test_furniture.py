"""The table of furniture in docs/how_to/rooms.md is what its command prints."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.slow  # it simulates ten things under the whole default suite
def test_the_table_is_what_its_command_prints() -> None:
    printed = subprocess.run(
        [sys.executable, str(DOCS / "furniture.py")], capture_output=True, text=True, check=True
    ).stdout
    assert printed.strip() in (DOCS / "how_to" / "rooms.md").read_text("utf-8")
