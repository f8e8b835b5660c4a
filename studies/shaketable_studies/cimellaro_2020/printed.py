"""What the paper prints: its buildings (table 1), risks (table 2) and tests (table 3)."""

from __future__ import annotations

import math
from typing import NamedTuple


class Measured(NamedTuple):
    """A row of table 1; NaN where nothing is printed."""

    id: int
    station: str
    storeys: int
    height_in: float
    earthquake: str
    pga_transverse_g: float
    pga_longitudinal_g: float


TABLE_1 = (
    Measured(1, "Pasadena (Office bldg)", 12, 2016, "Northridge, 17 Jan. 1994", 0.135, 0.234),
    Measured(2, "Burbank (Commercial bldg)", 6, 990, "Whittier, 1 Oct. 1987", 0.17, 0.23),
    Measured(3, "San Jose (Office bldg)", 3, 594, "LomaPrieta, 17 Oct. 1989", 0.18, 0.2),
    Measured(4, "Palm Springs (Hospital)", 4, 954, "Palm Springs, 8 July 1986", 0.16, 0.19),
    Measured(
        5, "South San Francisco (Office bldg)", 4, 726, "Loma Prieta, 17 Oct. 1989", 0.16, 0.14
    ),
    Measured(6, "Richmond (Office bldg)", 3, 554, "Loma Prieta, 17 Oct. 1989", 0.11, 0.08),
    Measured(7, "San Jose (Gov. Office bldg)", 13, 2527, "Loma Prieta, 17 Oct. 1989", 0.087, 0.098),
    Measured(8, "San Bernardino (Office bldg)", 3, 496, "Landers, 28 June 1992", 0.11, 0.08),
    Measured(9, "Burbank (Commerce bldg)", 6, 990, "Sierra Madre, 28 June 1991", 0.11, 0.12),
    Measured(10, "San Rafael (Hospital)", 5, 1110, "Bolinas, 17 Aug. 1999", 0.107, 0.082),
    Measured(
        11, "Pasadena (Office bldg)", 12, 2016, "Whittier Narrows, 16 March 2010", 0.045, 0.11
    ),
    Measured(12, "San Bernardino (Office bldg)", 3, 496, "San Bernardino, 08 Jan. 2009", 0.1, 0.08),
    Measured(
        13, "San Bernardino (Commercial bldg)", 9, 1411, "Landers, 28 June 1992", 0.068, 0.088
    ),
    Measured(14, "Pasadena (Office bldg)", 12, 2314, "Northridge 17 Jan. 1994", math.nan, math.nan),
    Measured(15, "Pasadena (Office bldg)", 12, 2016, "Chino Hills, 29 July 2008", 0.08, 0.06),
    Measured(16, "San Bernardino (Hospital)", 5, 828, "Northridge, 17 Jan. 1994", 0.046, 0.057),
    Measured(17, "Redlands(Commercial bldg.)", 7, 1253, "Landers, 28 June 1992", 0.06, 0.07),
    Measured(18, "San Bernardino (Hospital)", 5, 828, "Landers, 28 June 1992", 0.08, 0.08),
    Measured(19, "Lancaster (Hospital)", 5, 942, "Landers, 28 June 1992", 0.08, 0.05),
    Measured(20, "Chatsworth (Commercial bldg)", 2, 482, "Chino Hills, 29 July 2008", 0.07, 0.04),
    Measured(21, "Long Beach (Office bldg)", 7, 1248, "Whittier, 1 Oct. 1987", 0.07, 0.04),
    Measured(22, "Lancaster (Hospital)", 5, 942, "Landers, 28 June 1992", 0.055, 0.07),
    Measured(23, "San Bernardino (Hospital)", 5, 828, "Big Bear, 28 June 1992", 0.06, 0.07),
    Measured(
        24, "Los Angeles (Residential bldg)", 32, 4214, "Chino Hills, 29 Jul 2008", 0.065, 0.06
    ),
    Measured(25, "Long Beach (Gov. Office bldg)", 15, 3456, "Whittier, 1 Oct. 1987", 0.055, 0.041),
    Measured(26, "Long Beach (Gov. Office bldg)", 15, 3456, "Inglewood, 17 May 2009", 0.059, 0.043),
    Measured(27, "San Bernardino (Office bldg)", 3, 496, "Chino Hills, 29 July 2008", 0.052, 0.047),
    Measured(28, "Chatsworth (Commercial bldg)", 2, 482, "Chatsworth, 09 Aug. 2007", 0.04, 0.046),
    Measured(29, "San Jose (Gov. Office bldg)", 13, 2527, "Morgan Hill, 24 April 84", 0.039, 0.036),
    Measured(30, "San Jose (Office bldg)", 3, 594, "Alum Rock, 30 Oct. 2007", 0.034, 0.027),
    Measured(31, "Palm Springs (Hospital)", 4, 954, "Calexico, 04 April 2010", 0.04, 0.02),
    Measured(32, "San Bernardino (Hospital)", 5, 828, "Chino Hills, 29 July 2008", 0.0265, 0.036),
    Measured(
        33, "San Bernardino (Office bldg)", 3, 496, "Lake Elsinore, 02 Sept. 2007", 0.036, 0.031
    ),
    Measured(34, "San Diego (Commercial bldg)", 22, 3804, "Calexico, 04 April 2010", 0.034, 0.026),
    Measured(35, "Palm Springs (Hospital)", 4, 954, "Borrego Springs, 07 July 2010", 0.03, 0.03),
    Measured(
        36,
        "Los Angeles (Residential bldg)",
        32,
        4214,
        "Whittier Narrows, 16 March 2010",
        0.028,
        0.033,
    ),
    Measured(37, "Redlands (Commercial bldg)", 7, 1253, "Redlands, 13 Feb. 2010", 0.0255, 0.026),
    Measured(38, "San Bernardino (Office bldg)", 3, 496, "Whittier, 1 Oct. 1987", 0.029, 0.024),
    Measured(
        39, "South San Francisco (Office bldg)", 4, 726, "Morgan Hill, 24 April 84", 0.03, 0.02
    ),
    Measured(40, "Burbank (Commerce bldg)", 6, 990, "Chino Hills, 29 July 2008", 0.028, 0.029),
    Measured(41, "San Bernardino (Hospital)", 5, 828, "Big Bear City, 22 Feb. 2003", 0.0125, 0.023),
    Measured(42, "San Bernardino (Office bldg)", 3, 496, "Calexico, 04 April 2010", 0.0221, 0.0179),
    Measured(
        43, "Long Beach (Gov. Office bldg)", 15, 3456, "Chino Hills, 29 July 2008", 0.013, 0.021
    ),
    Measured(
        44, "San Bernardino (Office bldg)", 3, 496, "Borrego Springs, 07 July 2010", 0.0179, 0.0169
    ),
    Measured(45, "Lancaster (Hospital)", 5, 942, "Big Bear City, 22 Feb. 2003", 0.009, 0.008),
    Measured(
        46, "San Diego (Commercial bldg)", 22, 3804, "Borrego Springs, 07 Jul. 2010", 0.0155, 0.0157
    ),
    Measured(
        47, "Los Angeles (Residential bldg)", 32, 4214, "Inglewood, 17 May 2009", 0.008, 0.0155
    ),
    Measured(48, "Gilroy (Hospital)", 2, 372, "San Martin, 15 June 2006", 0.016, 0.012),
    Measured(49, "Richmond (Office bldg)", 3, 554, "Piedmont, 20 July 2007", 0.015, 0.013),
    Measured(50, "Redlands (Commercial bldg)", 7, 1253, "Calexico, 04 April 2010", 0.0112, 0.0125),
)


class Risk(NamedTuple):
    """A row of table 2: a channel's risks by the three ways [%]."""

    building: int
    storey: int
    channel: int
    simplified: int
    direct: int
    proposed: int


TABLE_2 = (
    Risk(3, 1, 2, 0, 29, 35),
    Risk(3, 1, 3, 0, 37, 27),
    Risk(3, 1, 4, 0, 36, 36),
    Risk(3, 3, 5, 65, 48, 69),
    Risk(3, 3, 6, 14, 53, 54),
    Risk(3, 3, 7, 65, 71, 69),
    Risk(3, 4, 8, 10, 83, 87),
    Risk(3, 4, 9, 2, 100, 79),
    Risk(3, 4, 10, 100, 99, 92),
    Risk(4, 5, 2, 96, 100, 82),
    Risk(4, 5, 3, 1, 100, 75),
    Risk(4, 5, 4, 30, 71, 60),
    Risk(4, 3, 5, 4, 77, 47),
    Risk(4, 3, 6, 0, 59, 44),
    Risk(4, 2, 7, 0, 37, 40),
    Risk(4, 2, 8, 0, 40, 34),
    Risk(4, 5, 10, 18, 100, 90),
    Risk(4, 3, 11, 41, 77, 63),
    Risk(4, 2, 12, 2, 56, 45),
    Risk(5, 1, 4, 0, 42, 23),
    Risk(5, 1, 5, 0, 45, 34),
    Risk(5, 2, 6, 4, 59, 48),
    Risk(5, 2, 7, 0, 50, 37),
    Risk(5, 2, 8, 10, 71, 52),
    Risk(5, 5, 9, 99, 100, 89),
    Risk(5, 5, 10, 98, 77, 86),
    Risk(5, 5, 11, 100, 100, 92),
)


class Sample(NamedTuple):
    """A row of table 3: a block of the shaking-table tests of Purvance et al. (2008).

    PGA [g] at which it overturned, and OR, of the mean, the largest and the smallest.
    """

    name: str
    width_ratio: float
    mean: tuple[float, float]
    largest: tuple[float, float]
    smallest: tuple[float, float]


TABLE_3 = (
    Sample("AL1", 0.32, (0.41, 0.66), (0.58, 0.82), (0.23, 0.36)),
    Sample("AL2", 0.14, (0.19, 0.67), (0.24, 0.76), (0.14, 0.58)),
    Sample("W1", 0.32, (0.43, 0.68), (0.58, 0.82), (0.23, 0.36)),
    Sample("W2", 0.14, (0.18, 0.66), (0.25, 0.77), (0.1, 0.50)),
    Sample("W3", 0.39, (0.5, 0.67), (0.61, 0.76), (0.4, 0.55)),
    Sample("G", 0.39, (0.52, 0.69), (0.73, 0.81), (0.41, 0.56)),
    Sample("IB0", 0.30, (0.49, 0.78), (0.9, 0.87), (0.33, 0.57)),
    Sample("IB2", 0.21, (0.34, 0.76), (0.5, 0.94), (0.23, 0.59)),
    Sample("IB4", 0.28, (0.39, 0.69), (0.76, 0.93), (0.24, 0.45)),
)
