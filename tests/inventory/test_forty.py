"""Forty lists as people keep them, with the right values of each.

Somebody who had not seen the reader wrote them, after what hospitals, schools, museums, offices and
workshops keep in English, German, Spanish, Italian and Japanese.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from shaketable import InputError
from shaketable.inventory import BaseShape, Item
from shaketable.inventory.read import read_with_columns

FOLDER = Path(__file__).parent / "forty"
RIGHT: dict[str, Any] = json.loads((FOLDER / "right.json").read_text(encoding="utf-8"))
#: It names no unit anywhere: that it is in millimetres is asked, and answered here.
ASKED = {"39-toshokan.tsv": '[columns]\n"規格" = "size_mm"\n'}
SHARE = 2e-3  # of a size or mass: right values are rounded to four digits


def agrees(found: float | None, right: Any) -> bool:
    """Whether a number is right; of a range either end is."""
    if right is None or found is None:
        return found is right
    accepted = right if isinstance(right, list) else [right]
    return any(found == pytest.approx(each, rel=SHARE) for each in accepted)


def misread(item: Item, right: dict[str, Any]) -> list[str]:
    """What of an object was read wrong. Which side of a base is called its width is left open."""
    across = item.sideways.base if item.sideways else None
    sides = {(item.body.base, across), (across, item.body.base)}
    faults = [] if item.name == right["name"] else [f"name {item.name}"]
    if not any(agrees(w, right["width_m"]) and agrees(d, right["depth_m"]) for d, w in sides):
        faults.append(f"base {sides}")
    if not agrees(item.height, right["height_m"]):
        faults.append(f"height {item.height}")
    if item.quantity != right["quantity"]:
        faults.append(f"quantity {item.quantity}")
    if not agrees(item.mass, right["mass_kg"]):
        faults.append(f"mass {item.mass}")
    if right.get("round", False) != (item.shape is BaseShape.CYLINDER):
        faults.append(f"shape {item.shape}")
    return [f"{right['name']}: {fault}" for fault in faults]


def test_there_are_forty() -> None:
    assert len(RIGHT) == 40
    assert len(ASKED) == 1  # 39 are read at once, as docs/how_to/assessing.md tells


@pytest.mark.parametrize("name", RIGHT)
def test_a_list_is_read_right(name: str, tmp_path: Path) -> None:
    columns = None
    if name in ASKED:
        with pytest.raises(InputError, match="names no unit, and neither does the heading"):
            read_with_columns(FOLDER / name)
        columns = tmp_path / "said.toml"
        columns.write_text(ASKED[name], encoding="utf-8")
    found = read_with_columns(FOLDER / name, columns=columns)
    right = RIGHT[name]
    assert len(found.items) == len(right["rows"])
    pairs = zip(found.items, right["rows"], strict=True)
    assert [fault for item, row in pairs for fault in misread(item, row)] == []
    assert found.not_assessed == right["not_assessed"]
