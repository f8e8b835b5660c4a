"""What transfers, disks and editors did to records, fault by fault; every one was read silently."""

from __future__ import annotations

import logging
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components, suite
from shaketable.records import cached
from tests.support import record_files
from tests.support.builders import G


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def replaced(text: str, old: str, new: str, count: int = 1) -> str:
    assert old in text
    return text.replace(old, new, count)


def second(text: str, line: str) -> int:
    """Where the second line begins that starts so."""
    return text.index(f"\n{line}", text.index(f"\n{line}") + 1) + 1


#: Formats that leave the instrument's offset in their values, but not in their maximum.
LOOSE = ("AOM003.EW", "nsmn.txt", "unam.txt", "csmnc.dat")


# components ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "name", "line"),
    [
        (record_files.cosmos, "a.V1C", "Uncorrected acceleration"),
        (record_files.cosmos, "a.V1C", "   80 acceleration pts"),
        (record_files.cosmos, "a.V1C", " 100 Integer-header"),
        (record_files.cosmos, "a.V1C", " 100 Real-header"),
        (record_files.cosmos, "a.V1C", "End-of-data"),
        (record_files.geonet, "a.V2A", "Corrected accelerogram"),
        (record_files.csmip, "a.V2", "CORRECTED ACCELEROGRAM"),
        (record_files.csmip, "a.V2", "   60 POINTS OF ACCEL"),
        (record_files.csmip, "a.V2", "/&"),
        (record_files.renadic, "a.v1", "/&"),
        (record_files.bhrc, "5523-1.V1", "UNITS ARE"),
        (record_files.bhrc, "5523-1.V1", "/&"),
    ],
)
@pytest.mark.parametrize("damage", ["garbled", "cut"])
def test_no_later_component_is_lost(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, make, name: str, line: str, damage: str
) -> None:
    text = make()
    whole = read_components(write(tmp_path, name, text))
    at = second(text, line)
    spoilt = text[:at] if damage == "cut" else f"{text[:at]}?§{text[at + 5 :]}"
    path = write(tmp_path, name, spoilt)
    try:
        found = read_components(path)
    except InputError:
        return
    if damage == "garbled":  # a word that says nothing of the values
        assert [(one.code, one.uncorrected) for one in found] == [
            (one.code, one.uncorrected) for one in whole
        ]
    else:  # cut between two components, of which the header says how many there are
        assert len(found) < len(whole)
        assert "of the 3 components" in caplog.text


def test_a_repeated_header_of_integers_is_no_time_step(tmp_path: Path) -> None:
    # the second header was taken for the one of reals
    text = record_files.cosmos()
    at = text.index(" 100 Integer-header")
    block = text[at : text.index(" 100 Real-header")]
    path = write(tmp_path, "a.V1C", text[:at] + block + text[at:])
    with pytest.raises(InputError, match="expected Real-header values, found Integer"):
        read_components(path)


# counts -------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [60, 119, 121, 125, 128])
@pytest.mark.parametrize("start", ["", "  "])
def test_another_count_is_an_error(tmp_path: Path, count: int, start: str) -> None:
    # rows without a blank at their start were dropped once the count was met
    lines = [start + line.lstrip() for line in record_files.at2(120).splitlines()]
    text = replaced("\n".join(lines), "NPTS=    120", f"NPTS= {count}")
    with pytest.raises(InputError, match=f"the header says {count} values, found 120"):
        read_components(write(tmp_path, "a.AT2", text))


def test_a_footer_after_the_counted_values_is_no_value(tmp_path: Path) -> None:
    text = record_files.at2(120) + "Processed by somebody\n"
    assert read_components(write(tmp_path, "a.AT2", text))[0].acceleration.size == 120


def test_several_values_on_later_lines_of_a_column(tmp_path: Path) -> None:
    for name, text in (
        ("a.txt", record_files.column()),
        ("b.txt", record_files.headed_column()),
    ):
        lines = text.splitlines()
        lines[40] += " 0.1"
        path = write(tmp_path, name, "\n".join(lines))
        with pytest.raises(InputError, match=r"line 41: expected 1 value"):
            read_components(path, units="g", time_step=0.01)


# units, sizes, steps ------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["velocity_cm/s", "vel_m_s2", "Disp (cm)", "a (m/s)"])
def test_velocities_are_no_accelerations(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, name: str
) -> None:
    rows = "".join(f"{0.01 * n:.2f},{n},{-n}\n" for n in range(50))
    path = write(tmp_path, "a.csv", f"time_s,{name},NS (gal)\n{rows}")
    (component,) = read_components(path)
    assert component.code == "NS"
    assert "left out, no accelerations" in caplog.text
    rows = "".join(f"{0.01 * n:.2f},{n}\n" for n in range(50))
    path = write(tmp_path, "a.csv", f"time_s,{name}\n{rows}")
    with pytest.raises(InputError, match="but no acceleration"):
        read_components(path, units="gal")


def test_a_slash_in_a_units_name(tmp_path: Path) -> None:
    rows = "".join(f"{0.01 * n:.2f},{n}\n" for n in range(50))
    (component,) = read_components(write(tmp_path, "a.csv", f"time_s,acc_cm/s2\n{rows}"))
    assert component.acceleration[1] == pytest.approx(0.01)
    assert component.code == "acc"


@pytest.mark.parametrize("first", ["0.0x1 0.5", "x.01 0.5", "0.01 0.5x", "12x 5", "0,0l 0.5"])
def test_a_damaged_first_row_is_no_header(tmp_path: Path, first: str) -> None:
    rows = "\n".join(f"{0.01 * n:.2f} {n}" for n in range(50))
    with pytest.raises(InputError, match=r"line 1: expected numbers, or a header|unknown record"):
        read_components(write(tmp_path, "a.txt", f"{first}\n{rows}"), units="gal")


def test_a_header_that_says_nothing_is_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = write(tmp_path, "a.txt", "E1\n" + record_files.column())
    read_components(path, units="gal", time_step=0.01)
    assert "line 1: read as the columns' header: 'E1'" in caplog.text


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("7845(gal)", "784500(gal)", "a peak of"),
        ("7845(gal)", "x7845(gal)", "expected a scale factor"),
        ("(gal)/8223790", "(gal)/8223790x", "expected a scale factor"),
        (
            "(gal)/8223790",
            "(gal)/0",
            "line 14: on this line or below it the file is not as its format",
        ),
        ("100Hz", "0Hz", "line 11: the sampling rate must be positive"),
        ("100Hz", "1.0.0Hz", "line 11: expected a number, found '1.0.0'"),
        ("(s)  3", "(s)  " + "3" * 4300, "cut short: the header says 3.33333333333e+183 counts"),
        ("Scale Factor", "Scale Fact0r", "unknown record format"),
        ("Dir.  ", "Dor.  ", "no value for 'Dir.'"),
        ("-9", "\uff19", "expected a count"),
    ],
)
def test_knet_headers(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = write(tmp_path, "AOM003.EW", replaced(record_files.knet(), old, new))
    with pytest.raises(InputError, match="AOM003") as error:
        read_components(path)
    assert said in str(error.value)
    assert len(str(error.value)) < 1000


MAXIMA = {
    "a.V2": r"PEAK ACCELERATION =\s*(\S+)",
    "a.V1C": r" (-?0\.200000)",  # among the real header's values
    "a.v1": r"MAX  =\s*(\S+) G",
    "AOM003.EW": r"Max\. Acc\. \(gal\)\s+(\S+)",
    "a.ASC": r"PGA_CM/S\^2: (\S+)",
    "old.acc": r"PGA \(m/s/s\)\s+: (\S+)",
    "a.V2A": r"Peak\s+(\S+)",
    "a.V1A": r"Peak\s+(\S+)",
    "a.smc": r" (-?3\.0000000E\+02)",
    "nsmn.txt": r"\(N-S\) (\S+)",
    "usc.s0a": r"PEAK ACCELERATION = +(\S+)",
    "unam.txt": r"ACEL. MAX.*?/(\S+?)/",
    "csmnc.dat": r"PEAK VALUE: +(\S+)",
    "cwb.dat": r"AmplitudeMAX\. N:.*?(-?30\.000)",
}


def test_every_maximum_is_tested() -> None:
    examples = record_files.examples()
    assert set(MAXIMA) == {name for name, one in examples.items() if one.peaked and one.even}


@pytest.mark.parametrize("name", MAXIMA)
@pytest.mark.parametrize("factor", [0.98, 1.02, 10.0])
def test_stated_maxima_are_held_against_the_values(
    tmp_path: Path, name: str, factor: float
) -> None:
    example = record_files.examples()[name]
    found = re.search(MAXIMA[name], example.text)
    assert found is not None
    stated = float(found[1]) * (factor if name not in LOOSE else factor**2)
    word = f"{stated:.3f}" if "E" not in found[1] else f"{stated:.7E}"
    text = example.text[: found.start(1)] + word.rjust(len(found[1])) + example.text[found.end(1) :]
    # a longer word would move the fields of numbers after it
    grown = len(word) - len(found[1])
    if grown > 0 and name in ("a.V1C", "a.smc"):
        text = replaced(text, " " * grown + word, word)
    with pytest.raises(InputError, match="the header says a peak of"):
        read_components(write(tmp_path, name, text), **example.given)


def test_a_lonely_spike_is_told_with_its_line(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    values = record_files.shaking(200, 3, 10.0)
    values[120] = 6000.0
    path = write(tmp_path, "a.txt", "# a comment\n" + "\n".join(f"{x:.1f}" for x in values))
    read_components(path, units="gal", time_step=0.01)
    assert "a.txt, line 122: sample 121 of component 1, 6.12 g, is a lonely spike" in caplog.text


def test_recorded_shaking_has_no_lonely_spike(
    shared_records: Path, caplog: pytest.LogCaptureFixture
) -> None:
    for path in sorted((shared_records / "kallioras_2025").glob("*.acc")):
        read_components(path, units="m/s2", time_step=0.005)
    assert "spike" not in caplog.text


@pytest.mark.parametrize("step", ["1e-30", "1e30", "2.0", "0"])
def test_time_steps_that_no_record_has(tmp_path: Path, step: str) -> None:
    text = replaced(record_files.at2(), "DT=   .0050", f"DT= {step}")
    with pytest.raises(InputError, match=r"line 4: (a|the) time step"):
        read_components(write(tmp_path, "a.AT2", text))
    path = write(tmp_path, "a.txt", record_files.column())
    with pytest.raises(InputError, match="time_step"):
        read_components(path, units="gal", time_step=float(step))


@pytest.mark.parametrize("name", ["csmip", "cosmos", "renadic", "bhrc", "geonet"])
def test_a_file_joined_to_itself(tmp_path: Path, name: str) -> None:
    # every motion would count twice
    text = getattr(record_files, name)()
    with pytest.raises(InputError, match="2 times; are several files joined"):
        read_components(write(tmp_path, "a.txt", text + text))


@pytest.mark.parametrize(
    ("name", "line", "damaged"),
    [
        ("renadic", "CHAN  2: V", "XHAN  2: V"),
        ("geonet", "Component Up", "Xomponent Up"),
        ("cosmos", "Sta Chan  2:", "Xta Chan  2:"),
    ],
)
def test_a_component_that_lost_its_name(tmp_path: Path, name: str, line: str, damaged: str) -> None:
    # a vertical component would become a horizontal one
    text = replaced(getattr(record_files, name)(), line, damaged)
    with pytest.raises(InputError, match="of which 1 have no name"):
        read_components(write(tmp_path, "a.txt", text))


def test_units_that_the_header_contradicts(tmp_path: Path) -> None:
    text = record_files.cwb()
    with pytest.raises(InputError, match="expected amplitudes in gal"):
        read_components(write(tmp_path, "a.dat", replaced(text, "gal", "g")))
    text = record_files.cosmos()
    with pytest.raises(InputError, match="the header's units are"):
        read_components(write(tmp_path, "a.v1", replaced(text, "units=g", "units=m/s2")))


def test_a_time_that_no_name_tells(tmp_path: Path) -> None:
    rows = "".join(f"{0.01 * n:.2f},{n % 7 - 3}\n" for n in range(50))
    path = write(tmp_path, "a.csv", f"elapsed,acc\n{rows}")
    with pytest.raises(InputError, match="column 'elapsed' rises evenly: is it the time"):
        read_components(path, units="g", time_step=0.01)


def test_times_with_too_few_digits(tmp_path: Path) -> None:
    # 200 samples a second, printed with two decimals: half of the samples would vanish
    rows = "".join(f"{int(0.5 * n) / 100:.2f},{n % 7 - 3}\n" for n in range(100))
    with pytest.raises(InputError, match="printed with too few digits"):
        read_components(write(tmp_path, "a.csv", f"time_s,acc_g\n{rows}"))


def test_a_long_number_is_refused_at_once(tmp_path: Path) -> None:
    # a pattern that tries every split of the digits would take seconds
    path = write(tmp_path, "a.txt", record_files.column() + "1" * 19_000 + "x\n")
    with pytest.raises(InputError, match="expected a number"):
        read_components(path, units="gal", time_step=0.01)


def test_a_rate_that_does_not_meet_the_peak(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    # 0.05 % off: the largest value is still the nearest to its stated time, but no longer at it
    text = replaced(record_files.smc(), "2.0000000E+02", "2.0010000E+02")
    read_components(write(tmp_path, "a.smc", text))
    assert "which is no multiple of the time step" in caplog.text


def test_digits_of_other_scripts_are_no_numbers(tmp_path: Path) -> None:
    for digit in ("\uff15", "\u0665"):  # fullwidth and Arabic five
        path = write(tmp_path, "a.txt", record_files.column() + f"{digit}\n")
        with pytest.raises(InputError, match=r"line 101: expected a number"):
            read_components(path, units="gal", time_step=0.01)


# real files that were refused ---------------------------------------------------------------


def test_cosmos_as_networks_print_it(tmp_path: Path) -> None:
    # CESMD prints values in fields of E format, gmprocess blanks around commas and signs
    (one, _, _) = read_components(write(tmp_path, "a.v1", record_files.cosmos()))
    text = record_files.cosmos()
    text = text.replace("lines, Format= (", "lines , Format = (")
    (spaced, _, _) = read_components(write(tmp_path, "b.v1", text))
    assert np.array_equal(spaced.acceleration, one.acceleration)
    lines = record_files.cosmos(80, 1).splitlines()
    at = next(n for n, line in enumerate(lines) if "acceleration pts" in line)
    values = one.acceleration / G
    stated = re.sub(r"\(\d+f.*", "(1E15.6)", lines[at], flags=re.IGNORECASE)
    rows = [f"{x:15.6E}" for x in values]
    end = next(n for n, line in enumerate(lines) if line.startswith("End-of-data"))
    text = "\n".join([*lines[:at], stated, *rows, *lines[end:], ""])
    (exponents,) = read_components(write(tmp_path, "c.v1", text))
    assert exponents.acceleration == pytest.approx(one.acceleration, rel=1e-6)


def test_tables_as_r_and_spreadsheets_quote_them(tmp_path: Path) -> None:
    rows = [(0.01 * n, (n % 7 - 3) / 10) for n in range(50)]
    plain = "\n".join(f"{t:.2f},{a}" for t, a in rows)
    (expected,) = read_components(write(tmp_path, "a.csv", f"time_s,acc_g\n{plain}\n"))
    quoted = "\n".join(f'"{t:.2f}","{a}"' for t, a in rows)
    for text in (f'"time_s","acc_g"\n{plain}\n', f'"time_s","acc_g"\n{quoted}\n'):
        (found,) = read_components(write(tmp_path, "b.csv", text))
        assert (found.code, found.time_step) == ("acc", 0.01)
        assert np.array_equal(found.acceleration, expected.acceleration)


def test_headers_with_blanks_before_their_units(tmp_path: Path) -> None:
    rows = [(0.01 * n, (n % 7 - 3) / 10) for n in range(50)]
    pairs = "\n".join(f"{t:8.2f} {a:8.3f}" for t, a in rows)
    (found,) = read_components(write(tmp_path, "a.txt", f"Time (s)   Acc (g)\n{pairs}\n"))
    assert (found.code, found.time_step) == ("Acc", 0.01)
    column = "\n".join(f"{a}" for _, a in rows)
    path = write(tmp_path, "b.txt", f"acc (g)\n{column}\n")
    (single,) = read_components(path, time_step=0.01)
    assert np.array_equal(single.acceleration, found.acceleration)


def test_rotated_components(tmp_path: Path) -> None:
    (component,) = read_components(write(tmp_path, "a.at2", record_files.at2_rotated()))
    assert (component.code, component.azimuth, component.time_step) == ("SN", 53.0, 0.005)
    assert component.event.startswith("SOMEWHERE 10/15/79")
    expected = record_files.shaking(120, 2, 3000.0) * 1e-4 * G
    assert component.acceleration == pytest.approx(expected, rel=1e-12)


def test_a_bare_last_value_where_the_count_is_met(tmp_path: Path) -> None:
    text = record_files.at2(120).rstrip()
    text = text[: text.rindex(" ")] + "  .0\n"
    (component,) = read_components(write(tmp_path, "a.AT2", text))
    assert component.acceleration[-1] == 0.0


def test_uneven_smc_with_lines_that_are_not_full(tmp_path: Path) -> None:
    text = record_files.smc(80, uneven=True)
    (whole,) = read_components(write(tmp_path, "a.smc", text))
    head, _, values = text.partition("| a comment\n")
    rows = values.splitlines()
    rows[3:5] = [rows[3][:40], rows[3][40:] + rows[4][:40], rows[4][40:]]
    (found,) = read_components(
        write(tmp_path, "a.smc", "\n".join([head + "| a comment", *rows, ""]))
    )
    np.testing.assert_array_equal(found.acceleration, whole.acceleration)


# bombs --------------------------------------------------------------------------------------


def test_archives_that_swell_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.txt", b"0\n" * 9_000_000)
    with pytest.raises(InputError, match=r"unpacks to 18 MB.*at most 100 times"):
        read_components(path, units="g", time_step=0.01)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0\n" * 2_000_001, "more than 2,000,000 lines"),
        ("UNITS OF G\nNPTS= 9, DT= .01 SEC\n" + ("1 " * 9000 + "\n") * 1200, "10,000,000 values"),
        ("a" * 100_000 + "\n1\n2\n", "line 1: has 100,000 characters"),
        ("UNITS OF G\nNPTS= " + "9" * 100 + ", DT= .01 SEC\n1 2\n", "at most 9 digits"),
    ],
)
def test_limits_have_names(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as error:
        read_components(write(tmp_path, "a.at2", text), units="g", time_step=0.01)
    assert len(str(error.value)) < 500


def test_archives_tell_what_they_leave_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("a.AT2", record_files.at2())
        archive.writestr("notes\x1b[31m.txt", "words\nof no record\n")
    read_components(path)
    assert r"left out, no records of acceleration: notes\x1b[31m.txt" in caplog.text
    with zipfile.ZipFile(path, "a") as archive, pytest.warns(UserWarning, match="Duplicate"):
        archive.writestr("a.AT2", record_files.at2(90))
    with pytest.raises(InputError, match=r"holds 'a.AT2' 2 times"):
        read_components(path)


def test_a_cached_suite_warns_again(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cached, "user_cache_path", lambda _: tmp_path / "cache")
    folder = tmp_path / "records"
    folder.mkdir()
    write(folder, "a.smc", record_files.smc(uneven=True))
    with caplog.at_level(logging.WARNING):
        suite(folder)
        first = list(caplog.messages)
        caplog.clear()
        suite(folder)
    assert first
    assert caplog.messages == first
