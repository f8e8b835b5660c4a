"""What the paper prints: bodies, curves' values, errors, tests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from shaketable.body import Body
from shaketable.units import CM, radians

MM = CM / 10
TILTS = np.radians(np.arange(0.0, 7.01, 0.5))  # abscissae of table II and figures 3-10
RECORDS = 314


class PrintedSize(NamedTuple):
    """A row of table I: full sizes [m] and how many of the 314 records eq. 1 lets count."""

    base: float
    height: float
    records: int

    @property
    def body(self) -> Body:
        name = f"{self.base:g} m × {self.height:g} m"
        return Body.rectangle(self.base, self.height, name=name)


TABLE_1 = (
    PrintedSize(0.04, 0.20, 258),
    PrintedSize(0.05, 0.20, 196),
    PrintedSize(0.06, 0.20, 158),
    PrintedSize(0.10, 0.50, 258),
    PrintedSize(0.13, 0.50, 188),
    PrintedSize(0.15, 0.50, 158),
    PrintedSize(0.18, 0.50, 116),
    PrintedSize(0.20, 1.00, 258),
    PrintedSize(0.25, 1.00, 196),
    PrintedSize(0.30, 1.00, 158),
    PrintedSize(0.30, 1.50, 258),
    PrintedSize(0.38, 1.50, 196),
)

#: GCOR at TILTS [%].
TABLE_2 = (50, 59, 67, 75, 81, 85, 89, 92, 94, 95, 96, 97, 97, 97, 98)


class Errors(NamedTuple):
    """A row of table III: of GCOR, then of SCOR, against the paper's simulations."""

    max_difference: tuple[float, float]  # simulated less curve [%]
    area: tuple[float, float]  # between them [% · degrees]
    error: tuple[float, float]  # eq. 12 [%]


TABLE_3 = (
    Errors((3, -2), (5.01, 5.21), (1, 1)),
    Errors((9, 10), (15.57, 8.22), (3, 2)),
    Errors((-7, 5), (16.83, 5.86), (3, 2)),
    Errors((9, 7), (12.39, 13.22), (3, 3)),
    Errors((-3, -3), (9.23, 5.87), (2, 1)),
    Errors((-5, -2), (13.90, 6.65), (3, 2)),
    Errors((-37, -29), (63.12, 40.98), (13, 9)),
    Errors((14, 8), (31.50, 11.65), (6, 3)),
    Errors((10, 7), (17.61, 9.23), (4, 2)),
    Errors((7, 6), (12.39, 12.35), (3, 3)),
    Errors((14, 4), (41.16, 6.04), (8, 1)),
    Errors((7, -16), (15.13, 14.91), (4, 3)),
)

#: The shaker's limits (table IV, surge): m, m/s and g.
SHAKER_DISPLACEMENT, SHAKER_VELOCITY, SHAKER_ACCELERATION_G = 0.25, 0.5, 0.6


class Specimen(NamedTuple):
    """A row of table V: agglomerated wood with its measured centre of gravity.

    The paper does not say from which edge bcg is measured: figure 13 is made with both.
    """

    width_mm: float
    height_mm: float
    depth_mm: float
    cg_from_edge_mm: float
    cg_height_mm: float

    def body(self, from_left: bool = True) -> Body:
        """In metres; its radius of gyration is that of the homogeneous rectangle.

        Args:
            from_left: whether bcg is measured from the left edge, the downhill one.
        """
        near = self.cg_from_edge_mm if from_left else self.width_mm - self.cg_from_edge_mm
        plain = Body.rectangle(MM * self.width_mm, MM * self.height_mm)
        return Body(
            base=plain.base,
            cg_height=MM * self.cg_height_mm,
            left=MM * near,
            gyration_radius=plain.gyration_radius,
            name=f"{self.width_mm:g} mm × {self.height_mm:g} mm",
        )


TABLE_5 = (
    Specimen(99, 493, 201.2, 51.5, 243),
    Specimen(130, 500, 305, 65, 254),
    Specimen(152, 500, 301.5, 76.5, 251.5),
    Specimen(39, 200, 81, 19.5, 100),
    Specimen(49, 200, 109, 25, 100),
    Specimen(200, 998, 410, 100, 495),
    Specimen(248, 995, 490, 124, 499),
)
#: Tilts of the tests [rad]: level, then around the one that should control 95 %.
TEST_TILTS = np.array([radians(tilt) for tilt in (0.0, 4.0, 4.5, 5.0, 5.5)])


class ScaledRecord(NamedTuple):
    """A row of table VI, with words by which networks know the event and the station."""

    name: str
    event: str  # regular expressions
    station: str
    azimuth: float  # [degrees]
    scale: float


_IMPERIAL, _LOMA_PRIETA, _NORTHRIDGE, _CHILE = r"IMP", r"LOMA", r"NORTHR", r"CHILE|1985"

TABLE_6 = (
    ScaledRecord("Kobe 1995, KJMA 090", r"KOBE", r"KJM", 90, 0.68),
    ScaledRecord("Northridge 1994, Sylmar 142", _NORTHRIDGE, r"SYLMAR|SCS", 142, 0.57),
    ScaledRecord("Chi-Chi 1999, TCU068 E", r"CHI-?CHI", r"TCU068", 90, 0.35),
    ScaledRecord("Imperial Valley 1979, Bonds Corner 140", _IMPERIAL, r"BONDS|BCR", 140, 0.26),
    ScaledRecord("Imperial Valley 1979, Array #7 S50W", _IMPERIAL, r"ARRAY #?7|E07", 230, 0.49),
    ScaledRecord("Northridge 1994, Castaic 090", _NORTHRIDGE, r"CASTAIC|ORR", 90, 0.96),
    ScaledRecord("Loma Prieta 1989, Corralitos 000", _LOMA_PRIETA, r"CORRALITOS|CLS", 0, 0.91),
    ScaledRecord("Loma Prieta 1989, Corralitos 090", _LOMA_PRIETA, r"CORRALITOS|CLS", 90, 1.0),
    ScaledRecord("Northridge 1994, Castaic 360", _NORTHRIDGE, r"CASTAIC|ORR", 360, 0.92),
    ScaledRecord("Chile 1985, Llolleo 10", _CHILE, r"LLOLLEO", 10, 0.67),
    ScaledRecord("Chile 1985, Melipilla EW", _CHILE, r"MELIPILLA", 90, 1.0),
    ScaledRecord("Imperial Valley 1979, Array #5 S50W", _IMPERIAL, r"ARRAY #?5|E05", 230, 0.53),
    ScaledRecord("Landers 1992, Lucerne 270", r"LANDERS", r"LUCERNE|LCN", 270, 0.58),
    ScaledRecord("Loma Prieta 1989, Gilroy #1 090", _LOMA_PRIETA, r"GILROY.*#?1\b|G01", 90, 1.0),
    ScaledRecord("Whittier 1987, Bell 280", r"WHITTIER", r"BELL|BUL", 280, 1.0),
    ScaledRecord("Loma Prieta 1989, Gilroy #3 000", _LOMA_PRIETA, r"GILROY.*#?3\b|G03", 0, 1.0),
    ScaledRecord("Imperial Valley 1979, Array #4 S40E", _IMPERIAL, r"ARRAY #?4|E04", 140, 1.0),
    ScaledRecord("Chile 1985, Llay-Llay N80W", _CHILE, r"LLAY", 280, 1.0),
    ScaledRecord("Imperial Valley 1979, Array #8 S40E", _IMPERIAL, r"ARRAY #?8|E08", 140, 0.95),
    ScaledRecord("Kocaeli 1999, DZC 270", r"KOCAELI", r"DUZCE|DZC", 270, 0.93),
    ScaledRecord("Chile 1985, Llay-Llay S10W", _CHILE, r"LLAY", 190, 1.0),
    ScaledRecord("Imperial Valley 1979, Array #7 S40E", _IMPERIAL, r"ARRAY #?7|E07", 140, 1.0),
    ScaledRecord("Northridge 1994, Arleta 090", _NORTHRIDGE, r"ARLETA|ARL", 90, 0.91),
    ScaledRecord("Loma Prieta 1989, Gilroy #2 000", _LOMA_PRIETA, r"GILROY.*#?2\b|G02", 0, 1.0),
    ScaledRecord("Loma Prieta 1989, Gilroy #2 090", _LOMA_PRIETA, r"GILROY.*#?2\b|G02", 90, 1.0),
)
