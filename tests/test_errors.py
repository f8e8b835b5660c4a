"""What a fault of a file says."""

import pytest

from shaketable.errors import Fault


@pytest.mark.parametrize(
    ("text", "mend", "said"),
    [
        ("not a number", "", "not a number"),
        ("not a number", "write 0.3", "not a number; write 0.3"),
        ("which is it?", "name it", "which is it? Name it"),
        ("which is it?", "--unit says it", "which is it? --unit says it"),
    ],
)
def test_how_to_mend_a_fault_follows_what_is_wrong(text: str, mend: str, said: str) -> None:
    fault = Fault("list.csv", "line 7", "Height", "number", text, mend)
    assert str(fault) == f"list.csv, line 7, Height: {said}"
