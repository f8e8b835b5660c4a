"""A small campaign, and what `simulate_many` gives for it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

from shaketable import Body, Motion, simulate_many

pytest.importorskip("zarr", reason="the extra campaign is not installed: pip install '.[campaign]'")

BODIES = [Body.rectangle(0.1 + 0.05 * k, 0.8 + 0.2 * k, name=f"body {k}") for k in range(5)]
TILTS = np.radians([0.0, 2.0])
BLOCK = 60  # simulations: 5 bodies × 12 motions × 2 × 2 are 240


@pytest.fixture
def small(p695: list[Motion]) -> dict[str, Any]:
    """Arguments of a campaign of several blocks."""
    return {
        "bodies": BODIES,
        "motions": p695[:12],
        "tilts": TILTS,
        "block": BLOCK,
        "progress": False,
    }


@pytest.fixture
def known(small: dict[str, Any]) -> xr.Dataset:
    """The same in one piece."""
    return simulate_many(**{name: value for name, value in small.items() if name != "block"})
