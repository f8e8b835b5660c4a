"""The table of result fields, and what follows from it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, General, Motion, Rocking, Solid, simulate, simulate_each, simulate_many
from shaketable.simulate.result_fields import ALL, FIELDS, GENERAL, ROCKING, SOLID

MOTION = Motion(4.0 * np.sin(np.arange(0.0, 2.0, 0.01) * 6.0), 0.01, transverse=np.zeros(200))
CASES = {
    ROCKING: (Body.rectangle(0.2, 1.0), Rocking()),
    GENERAL: (Body.rectangle(0.2, 1.0), General(static_friction=0.3)),
    SOLID: (Solid.box(0.2, 0.3, 1.0), General(static_friction=0.3)),
}


@pytest.mark.parametrize("of", ALL)
def test_datasets_have_the_fields_of_their_table(of: str) -> None:
    body, model = CASES[of]
    many = simulate_many([body], [MOTION], model=model, progress=False)
    each = simulate_each(body, MOTION, model=model, progress=False)
    expected = {name: field for name, field in FIELDS.items() if of in field.of and not field.held}
    for runs in (many, each):
        assert list(runs.data_vars) == list(expected)
        for name, field in expected.items():
            assert runs[name].dtype == field.dtype
            assert runs[name].attrs == field.attributes


@pytest.mark.parametrize("of", ALL)
def test_a_response_has_the_same_names_and_numbers(of: str) -> None:
    body, model = CASES[of]
    one = simulate(body, MOTION, model=model)
    each = simulate_each(body, MOTION, model=model, progress=False)
    for name in each.data_vars:
        assert getattr(one, str(name)) == pytest.approx(
            float(each[name].item()), nan_ok=True, abs=1e-12
        )


def test_the_documentation_has_the_same_table() -> None:
    page = (Path(__file__).parents[2] / "docs" / "reference" / "results.md").read_text(
        encoding="utf-8"
    )
    rows = [line.split("|")[1:-1] for line in page.splitlines() if line.startswith("| `")]
    told = {row[0].strip(" `"): [cell.strip() for cell in row[1:]] for row in rows}
    assert told == {
        name: [field.units, *("×" if of in field.of else "" for of in ALL), field.meaning]
        for name, field in FIELDS.items()
    }


def test_members_are_numbered_alike_in_plane_and_space() -> None:
    """Body, motion, polarity, tilt, scale and orientation, the last the fastest."""
    from shaketable.simulate.ensemble import Ensemble

    for body in (Body.rectangle(0.2, 1.0), Solid.box(0.2, 0.3, 1.0)):
        ensemble = Ensemble.of(
            [body, body], [MOTION] * 3, tilts=[0.0, 0.01], scales=[0.1, 0.2, 0.3],
            polarities=(1, -1), model=None,
        )  # fmt: skip
        assert ensemble.shape == (2, 3, 2, 2, 3, 1)
        seen: list[int] = []
        ensemble.run(lambda part, seen=seen: seen.extend(part.members.tolist()), 1, False)
        assert sorted(seen) == list(range(72))
