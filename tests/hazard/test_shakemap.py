"""ShakeMaps: grids of shaking with their uncertainty."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError
from shaketable.hazard import read_shakemap
from shaketable.hazard.falls import probabilities
from shaketable.units import STANDARD_GRAVITY as G

LON, LAT = np.array([-118.5, -118.4, -118.3]), np.array([34.0, 34.1])


def text(fields: dict[str, tuple[str, np.ndarray]], *, rows: int | None = None) -> str:
    """A file of ShakeMap, from the north to the south as it writes them."""
    points = [(j, i) for j in reversed(range(LAT.size)) for i in range(LON.size)]
    told = {"LON": ("dd", np.tile(LON, (2, 1))), "LAT": ("dd", np.tile(LAT[:, None], (1, 3)))}
    told |= fields
    lines = [" ".join(f"{grid[j, i]:.4f}" for _, grid in told.values()) for j, i in points[:rows]]
    head = "\n".join(
        f'<grid_field index="{k}" name="{name}" units="{unit}" />'
        for k, (name, (unit, _)) in enumerate(told.items(), 1)
    )
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<shakemap_grid xmlns="http://earthquake.usgs.gov/eqcenter/shakemap" event_id="made">\n'
        '<event event_id="made" magnitude="6.7" event_description="Made by hand" />\n'
        f"{head}\n<grid_data>\n" + "\n".join(lines) + "\n</grid_data>\n</shakemap_grid>\n"
    )


PGA = np.array([[10.0, 20.0, 40.0], [5.0, 10.0, 20.0]])  # %g, south first
PGV = np.array([[12.0, 24.0, 48.0], [6.0, 12.0, 24.0]])  # cm/s
GRID = {"PGA": ("%g", PGA), "PGV": ("cm/s", PGV), "PSA10": ("%g", PGA), "MMI": ("intensity", PGA)}
SIGMA = {"STDPGV": ("ln(cm/s)", np.full((2, 3), 0.5)), "STDPSA10": ("ln(g)", np.full((2, 3), 0.6))}


@pytest.fixture
def grid(tmp_path: Path) -> Path:
    (tmp_path / "grid.xml").write_text(text(GRID))
    (tmp_path / "uncertainty.xml").write_text(text(SIGMA))
    return tmp_path / "grid.xml"


def test_values_of_sites(grid: Path) -> None:
    """Percent of g and cm/s, linear in the logarithm between the points."""
    found = read_shakemap(grid)
    assert (found.name, found.magnitude) == ("Made by hand", 6.7)
    assert list(found.ln_median) == ["PGA", "PGV", "SA(1.0)"]
    assert np.exp(found.ln_median["PGA"]) == pytest.approx(PGA / 100.0 * G)
    mean, sigma = found.of("PGV", [-118.5, -118.45, -118.3], [34.0, 34.0, 34.05])
    assert np.exp(mean) == pytest.approx([0.12, np.sqrt(0.12 * 0.24), np.sqrt(0.48 * 0.24)])
    assert sigma.tolist() == pytest.approx([0.5, 0.5, 0.5])
    # a corner belongs to the grid
    assert np.exp(found.of("PGV", -118.3, 34.1)[0]) == pytest.approx(0.24)


def test_a_city_in_one_call(grid: Path) -> None:
    """The expected falls of 10⁵ things are the mean of what is drawn at each; 4 standard errors."""
    found = read_shakemap(grid)
    rng = np.random.default_rng(4)
    lon, lat = rng.uniform(-118.5, -118.3, 100_000), rng.uniform(34.0, 34.1, 100_000)
    mean, sigma = found.of("PGV", lon, lat)
    chance = probabilities(0.25, 0.4, mean, sigma)
    drawn = np.exp(mean + sigma * rng.standard_normal(lon.size))
    capacity = 0.25 * np.exp(0.4 * rng.standard_normal(lon.size))
    spread = np.sqrt((chance * (1.0 - chance)).sum())
    assert (drawn > capacity).sum() == pytest.approx(chance.sum(), abs=4.0 * spread)


def test_uncertainty(grid: Path, caplog: pytest.LogCaptureFixture) -> None:
    found = read_shakemap(grid)
    with pytest.raises(InputError, match=r"the uncertainty of PGA is not known.*uncertainty.xml"):
        found.of("PGA", -118.4, 34.05)
    (grid.parent / "uncertainty.xml").unlink()
    assumed = read_shakemap(grid, assumed_sigma=0.6)
    assert assumed.of("PGV", -118.4, 34.0)[1] == 0.6
    assert "the uncertainty of PGA, PGV, SA(1.0) is assumed" in caplog.text
    with pytest.raises(InputError, match="the uncertainty of PGV is not known"):
        read_shakemap(grid).of("PGV", -118.4, 34.05)


@pytest.mark.parametrize("told", [[179.9, 180.0, -179.9], [179.9, -180.0, -179.9]])
def test_a_grid_across_the_antimeridian(tmp_path: Path, told: list[float]) -> None:
    """A site is on it from either side of 180°, and one half around the world is not."""
    lon = f"{LON[0]:.4f}", f"{LON[1]:.4f}", f"{LON[2]:.4f}"
    for name, fields in (("grid.xml", GRID), ("uncertainty.xml", SIGMA)):
        made = text(fields)
        for old, new in zip(lon, told, strict=True):
            made = made.replace(f"{old} ", f"{new:.4f} ")
        (tmp_path / name).write_text(made)
    found = read_shakemap(tmp_path / "grid.xml")
    assert found.longitudes == pytest.approx([179.9, 180.0, 180.1])
    mean, _ = found.of("PGV", [179.9, -179.95, 180.05, -180.0], [34.0] * 4)
    between = np.sqrt(0.24 * 0.48)
    assert np.exp(mean) == pytest.approx([0.12, between, between, 0.24])
    for far in (0.0, 179.0, -179.5):
        with pytest.raises(InputError, match="off the grid"):
            found.of("PGV", far, 34.0)


def test_sites_off_the_grid(grid: Path) -> None:
    with pytest.raises(InputError, match=r"1 of 2 sites are off the grid.*the first is -117, 34"):
        read_shakemap(grid).of("PGV", [-118.4, -117.0], 34.0)
    with pytest.raises(InputError, match=r"has no SA\(3.0\); it has PGA, PGV, SA\(1.0\)"):
        read_shakemap(grid).of("SA(3.0)", -118.4, 34.0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("not xml", "not an XML file that can be read"),
        ("<html></html>", "is no grid of ShakeMap"),
        (text(GRID, rows=5), "5 points are no grid of whole rows; is the file cut short"),
        (text(GRID)[:-120], "not an XML file that can be read"),
        (text({"MMI": ("intensity", PGA)}), "has neither PGA, PGV nor PSA"),
        (text({"PGA": ("mm", PGA)}), "the unit 'mm' is not one of PGA; accepted: g, %g"),
        (text({"PGV": ("%g", PGA)}), "the unit '%g' is not one of PGV"),
        (text(GRID).replace('index="3"', 'index="9"'), "grid_field are not 1 to 6"),
        (text({"PGA": ("%g", 0.0 * PGA)}), "has neither PGA, PGV nor PSA that is above 0"),
        (text(GRID).replace("24.0000", "n/a"), "holds what is no number"),
        (
            '<!DOCTYPE x [<!ENTITY a "aaaa">]><shakemap_grid><grid_data>&a;</grid_data>'
            "</shakemap_grid>",
            "not an XML file that can be read",
        ),
    ],
)
def test_bad_files(tmp_path: Path, given: str, message: str) -> None:
    (tmp_path / "grid.xml").write_text(given)
    with pytest.raises(InputError, match=message) as error:
        read_shakemap(tmp_path / "grid.xml")
    assert "grid.xml" in str(error.value)


def test_two_files_that_do_not_belong_together(grid: Path) -> None:
    other = text(SIGMA).replace("34.1000", "34.2000")
    (grid.parent / "uncertainty.xml").write_text(other)
    with pytest.raises(InputError, match=r"uncertainty.xml: is on another grid"):
        read_shakemap(grid)


def test_of_an_older_map_what_is_no_number_is_left_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """Maps before ShakeMap 4 round small values to 0, and have a STDPGA that is no sigma of ln."""
    small = PGA.copy()
    small[1, 0] = 0.0
    fields = {**GRID, "PSA30": ("%g", small), "STDPGA": ("pctg", np.full((2, 3), 0.7))}
    (tmp_path / "grid.xml").write_text(text(fields))
    found = read_shakemap(tmp_path / "grid.xml", assumed_sigma=0.6)
    assert list(found.ln_median) == ["PGA", "PGV", "SA(1.0)"]
    assert found.sigma["PGA"] == pytest.approx(np.full((2, 3), 0.6))
    assert "SA(3.0) is left out: it is 0 at 1 of its points" in caplog.text
    assert "STDPGA is left out: it is no standard deviation of a logarithm" in caplog.text
