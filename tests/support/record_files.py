"""Small record files in every text format, made here, so that tests of readers run anywhere."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Example(NamedTuple):
    """A record file.

    Attributes:
        text: what it holds.
        given: what has to be given to read it.
        counted: whether it states its number of values.
        timed: whether it states its time step twice, or in times.
        peaked: whether it states its largest value.
        even: whether its values stand at even times, and are read as they are.
    """

    text: str
    given: Mapping[str, object] = MappingProxyType({})
    counted: bool = True
    timed: bool = True
    peaked: bool = True
    even: bool = True


def shaking(count: int, seed: int = 0, peak: float = 300.0) -> NDArray[np.float64]:
    """Noise under an envelope, with the given peak, in whole tenths."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(size=count) * np.sin(np.linspace(0.1, 3.0, count))
    values: NDArray[np.float64] = np.round(noise / np.abs(noise).max() * peak, 1)
    return values


def rows(fields: Iterable[str], per_line: int) -> list[str]:
    fields = list(fields)
    return ["".join(fields[k : k + per_line]) for k in range(0, len(fields), per_line)]


def at2(count: int = 120) -> str:
    values = shaking(count, 1, 0.3 * 1e6) * 1e-6
    return "\n".join(
        [
            "PEER NGA STRONG MOTION DATABASE RECORD",
            "Somewhere, 1/2/1990, A Station, North, 021",
            "ACCELERATION TIME SERIES IN UNITS OF G",
            f"NPTS= {count:6d}, DT=   .0050 SEC,  -5 POLE @ .1 HZ",
            *rows((f"{x:15.7E}" for x in values), 5),
            "",
        ]
    )


def at2_rotated(count: int = 120) -> str:
    values = shaking(count, 2, 0.3 * 1e4) * 1e-4
    return "\n".join(
        [
            "PEER NGA Rotated Accelerogram (v1.1)",
            "H1 for rotation: SOMEWHERE 10/15/79 2316, A STATION, 092 (CDMG STATION 1)",
            "H2 for rotation: SOMEWHERE 10/15/79 2316, A STATION, 002 (CDMG STATION 1)",
            "rotation angle - clockwise  51.000000",
            "SN component, azimuth =  53.000000",
            "Accelerations in g",
            f"{count} 0.005000 NPTS, DT",
            *rows((f"{x:.6f} \t " for x in values), 5),
            "",
        ]
    )


def csmip(count: int = 60, channels: int = 3) -> str:
    lines = []
    for number in range(1, channels + 1):
        values = shaking(count, 10 + number)
        code = ("90 DEG", "UP", "180 DEG")[number - 1]
        peak, at = values[np.argmax(np.abs(values))], 0.02 * np.argmax(np.abs(values))
        lines += [
            f"CORRECTED ACCELEROGRAM   36456-S4384-83123.01       CHAN  {number}: {code}     FROM",
            "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/16/98",
            "AN EARTHQUAKE",
            "MAY 2, 1983 16:42 PDT",
            "36456-S4384-83123.01               TRIGGER TIME: 05/02/83",
            f"STATION NO. 36456   35.9N, 120.4W  SMA-1 S/N 4384 ( {channels} CHNS OF  3 AT STA)",
            "A PLACE",
            f"CHAN  {number}: {code}",
            f" {count:5d} POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA",
            "AT EQUALLY-SPACED INTERVALS OF     .020 SEC.",
            f"PEAK ACCELERATION = {peak:10.3f}    CM/SEC/SEC  AT {at:8.3f}   SEC.",
            f"{count:5d} POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)",
            *rows((f"{x:10.3f}" for x in values), 8),
            f"{count:5d} POINTS OF VELOC DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC)",
            *rows((f"{x:10.3f}" for x in 0.1 * values), 8),
            f"{count:5d} POINTS OF DISPL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM)",
            *rows((f"{x:10.3f}" for x in 0.01 * values), 8),
            f"/&  ----------  END OF DATA FOR CHANNEL  {number}  ----------",
        ]
    return "\n".join([*lines, ""])


def cosmos(count: int = 80, channels: int = 3) -> str:
    lines = []
    for number in range(1, channels + 1):
        values = shaking(count, 20 + number, 0.2 * 1e5) * 1e-5
        integers = np.full(100, -999)
        integers[:3] = 1, 1, 2  # uncorrected, acceleration, in g
        reals = np.full(100, -999.0)
        reals[33], reals[61], reals[62] = 0.005, 5.0, count * 0.005
        reals[63] = values[np.argmax(np.abs(values))]
        lines += [
            "Uncorrected acceleration  (Format v01.20 with 13 text lines) Src:  ce23837j",
            "Rcrd of Tue Aug 28, 2018 19:33:00.0 PDT",
            "Hypocenter: To be determined",
            "Origin: To be determined",
            "Statn No: 05- 23837 Code:CE-23837  CGS  A Place",
            "Coords: 34.063  -117.785   Site geology:",
            f"Recorder: Etna   s/n 1193 ( {channels} Chns of   3 at Sta) Sensor: FBA",
            "Rcrd start time: 8/29/2018, 02:33:  .0 UTC (Q=5)",
            f"Sta Chan  {number}: {('360', 'Up', '90')[number - 1]} deg (Rcrdr Chan  {number})",
            f"Raw record length = {count * 0.005:7.3f} sec",
            "Processed:",
            "Record not filtered.",
            "Values used when parameter or data value is unknown/unspecified:   -999, -999.0",
            " 100 Integer-header values follow on  10 lines, Format= (10I8)",
            *rows((f"{n:8d}" for n in integers), 10),
            " 100 Real-header values follow on  17 lines, Format= (6F13.6)",
            *rows((f"{x:13.6f}" for x in reals), 6),
            '   1 Comment line(s) follow, each starting with a "|":',
            "|<SCNL>23837.HNN.CE.--",
            f"   {count} acceleration pts, approx  {count * 0.005:.0f} secs, units=g.     "
            "(02)Format=(8f9.6)",
            *rows((f"{x:9.6f}" for x in values), 8),
            f"End-of-data for Chan  {number} acceleration",
        ]
    return "\n".join([*lines, ""])


def renadic(count: int = 100, channels: int = 3, *, uneven: bool = False) -> str:
    lines = []
    for number in range(1, channels + 1):
        values = shaking(count, 30 + number, 2000.0) * 1e-3
        time = 0.005 * np.arange(count)
        if uneven:
            time += np.random.default_rng(number).integers(-1, 2, count) * 1e-3
            time[0] = 0.0
        peak = values[np.argmax(np.abs(values))] / 10
        lines += [
            "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/04/2010",
            "MAULE 2010",
            "01/01/1980 0:00:00 (GMT)",
            "                                   TRIGGER TIME: 1/1/1980",
            f"STATION NO.          0.000N    0.000E  SMA  S/N 0   ({channels}  CHNS OF 3  AT STA)",
            "A PLACE S/N 4566",
            f"CHAN  {number}: {'LVT'[number - 1]}        (STA CHN:  {number})",
            f"NO. OF POINTS =  {count}  RECORD LENGTH ={count * 0.005:7.3f} SEC",
            f"UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = {peak:6.3f} G, AT  45.025 SEC",
            "RMS ACCEL OF COMPLETE RECORD = 0.051 G",
            *["    0" * 16] * 6,
            "    0" * 4,
            *["     0.000" * 8] * 6,
            "     0.000" * 2,
            *rows(
                (f"{x:7.3f}" for pair in zip(time, values, strict=True) for x in pair),
                10,
            ),
            f"/&  ----------  END OF DATA FOR CHANNEL  {number}  ----------",
        ]
    return "\n".join([*lines, ""])


def bhrc(count: int = 100) -> str:
    lines = ["* VOL1DS FILE:  5523/01", "Inst Type = SSA-2", "Origin Time : 2012/08/11   12:23:16"]
    for number, code in enumerate(("L1", "V2", "T3")):
        values = shaking(count, 40 + number) * 1e-3
        reals = np.zeros(50)
        reals[2], reals[6] = count * 0.005, 200.0
        lines += [
            "",
            code[0],
            f"COMP {code}",
            "A place              Station   38.2 N 46.1 E   Altitude 1m   Azimuth L 177   T 267",
            "INSTR PERIOD =  .020 SEC   DAMPING =  .640",
            f"NO. OF POINTS =  {count:5d}      DURATION =  {count * 0.005:.3f}",
            "UNITS ARE SECONDS AND G/10",
            "",
            *rows(["    0"] * 88, 14),
            *rows((f"{x:14.6E}" for x in reals), 8),
            *rows((f"{x:14.6E}" for x in values), 10),
            "/&",
        ]
    return "\n".join([*lines, ""])


def knet(count: int = 300) -> str:
    counts = np.rint(shaking(count, 50) * 100 - 9000).astype(int)
    gal = 7845 / 8223790
    peak = np.abs(counts - counts.mean()).max() * gal
    return "\n".join(
        [
            "Origin Time       2018/01/24 19:51:00",
            "Lat.              41.0",
            "Long.             142.5",
            "Depth. (km)       30",
            "Mag.              6.2",
            "Station Code      AOM003",
            "Station Lat.      41.4053",
            "Station Long.     141.1691",
            "Station Height(m) 4",
            "Record Time       2018/01/24 19:51:38",
            "Sampling Freq(Hz) 100Hz",
            f"Duration Time(s)  {count // 100}",
            "Dir.              E-W",
            "Scale Factor      7845(gal)/8223790",
            f"Max. Acc. (gal)   {peak:.3f}",
            "Last Correction   2018/01/24 19:51:38",
            "Memo.             ",
            *rows((f"{n:8d} " for n in counts), 8),
            "",
        ]
    )


def esm(count: int = 100) -> str:
    values = shaking(count, 60, 30.0)
    head = {
        "EVENT_NAME": "GREECE", "EVENT_ID": "EMSC-1", "EVENT_DATE_YYYYMMDD": "20190728",
        "MAGNITUDE_W": "", "MAGNITUDE_L": "4.6",
        "NETWORK": "HI", "STATION_CODE": "ARS1", "STATION_NAME": "Town Hall",
        "SAMPLING_INTERVAL_S": "0.005000", "NDATA": f"{count}",
        "DURATION_S": f"{count * 0.005:.3f}", "STREAM": "HNE", "UNITS": "cm/s^2",
        "PGA_CM/S^2": f"{values[np.argmax(np.abs(values))]:.6f}", "TIME_PGA_S": "20.670000",
        "BASELINE_CORRECTION": "BASELINE REMOVED", "FILTER_TYPE": "BUTTERWORTH",
        "DATA_TYPE": "ACCELERATION", "PROCESSING": "manual",
    }  # fmt: skip
    lines = [f"{key}: {value}" for key, value in head.items()]
    lines += [f"USER{n}: " for n in range(64 - len(lines))]
    return "\n".join([*lines, *(f"{x:.6f}" for x in values), ""])


def esm_old(count: int = 100) -> str:
    values = shaking(count, 61, 3000.0) * 1e-3
    return "\n".join(
        [
            "Event Date & Time             : 2009-04-06 01:32:39",
            "Station Code / Name           : 3623 / A Place, Italy",
            "Network                       : DPC",
            "Orientation                   : NS",
            "Processing Info               : Acausal Butterworth bandpass filtering",
            "Filter Cut-off Frequency (Hz) : 0.100 - 18.000",
            "Time Increment (s)            : 0.005",
            f"Number of Data                : {count}",
            f"PGA (m/s/s)                   : {np.abs(values).max():.7E}",
            "Accelaration time series in m/s/s",
            *rows((f"{x:14.7E}" for x in values), 5),
            "",
        ]
    )


def geonet(count: int = 60, *, corrected: bool = True) -> str:
    lines = []
    for number in range(3):
        values = shaking(count, 70 + number)
        peak = values[np.argmax(np.abs(values))]
        integers = np.zeros((4, 10), int)
        integers[3, 3:6] = count if corrected else (count, 0, 0)
        series = [values, 0.1 * values, 0.01 * values] if corrected else [values]
        lines += [
            f"{'C' if corrected else 'Unc'}orrected accelerogram 20160214_001343_NBLC GNS Science",
            "Site NBLC      43 30 25S  172 43 53E     Cusp file:  20160214_001345_NBLC",
            "A Library",
            "Instrument Cusp_323",
            "Resolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700",
            "Accelerogram 20160214_001343_NBLC_20                 Processed 2016 February 22",
            "11 km east of SOMEWHERE",
            "2016 February 14         00:13:43 UT",
            "Epicentre  43 29 50S 172 45 18E  Bearing N61E  Dist    2km  Depth    8km M  5.70",
            f"Number of points  {count}    Duration {count * 0.005:.2f} s",
            "Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s",
            "Data is unfiltered",
            f"Component {('S14E', 'N76E', 'Up')[number]}",
            f"Acceleration:  Peak  {peak:.1f} mm/s/s at  23.28 s     RMS   145.6 mm/s/s",
            "Velocity record unevaluated",
            "Displacement record unevaluated",
            *("".join(f"{n:8d}" for n in row) for row in integers),
            *["".join(f"{0:8.2f}" for _ in range(10))] * 6,
            *(line for one in series for line in rows((f"{x:8.1f}" for x in one), 10)),
        ]
    return "\n".join([*lines, ""])


def smc(count: int = 80, *, uneven: bool = False) -> str:
    """A USGS SMC file; integer 17 is the count, real 2 the sampling rate or none (1.7e38)."""
    values = shaking(count, 80)
    time = 0.005 * np.arange(count)
    if uneven:
        time = np.cumsum(np.random.default_rng(8).integers(3, 8, count)) * 1e-3
    integers = np.full(48, -32768)
    integers[16] = count
    reals = np.full(50, 1.7e38)
    reals[1] = 1.7e38 if uneven else 200.0
    largest = int(np.argmax(np.abs(values)))
    reals[28], reals[29] = time[largest], values[largest]
    pairs = (x for pair in zip(time, values, strict=True) for x in pair)
    return "\n".join(
        [
            f"{1 if uneven else 2} {'UN' if uneven else ''}CORRECTED ACCELEROGRAM",
            "*",
            "SAF0A",
            "     1989  10  18    0004 Loma Prieta, CA",
            "*",
            "station = A Town, Main Street component=    270",
            *["*"] * 5,
            *rows((f"{n:10d}" for n in integers), 8),
            *rows((f"{x:15.7E}" for x in reals), 5),
            "| a comment",
            *rows((f"{x:10.4f}" for x in (pairs if uneven else values)), 8),
            "",
        ]
    )


def nsmn(count: int = 120) -> str:
    table = np.column_stack([shaking(count, 90 + k, 30.0) for k in range(3)])
    peaks = np.abs(table).max(axis=0)
    return "\n".join(
        [
            "STRONG GROUND MOTION RECORDS OF TURKIYE",
            "PLACE                   : SOMEWHERE",
            "EARTHQUAKE DATE         : 2017/07/20 22:31:09 (GMT)",
            "EARTHQUAKE MAGNITUDE    : 6.5 Mw",
            "STATION ID              : 0921",
            f"NUMBER OF DATA          : {count}",
            "SAMPLING INTERVAL (sec) : 0.01",
            f"RAW PGA VALUES (gal)    : (N-S) {peaks[0]:.6f} (E-W) {peaks[1]:.6f} "
            f"(U-D) {peaks[2]:.6f}",
            "       N-S          E-W          U-D",
            *("".join(f"{x:13.6f}" for x in row) for row in table),
            "",
        ]
    )


def cwb(count: int = 100) -> str:
    table = np.column_stack([shaking(count, 100 + k, 30.0) for k in range(3)])
    peaks = [
        f"#AmplitudeMAX. {code}: {column.max():8.3f}~ {column.min():8.3f}"
        for code, column in zip("UNE", table.T, strict=True)
    ]
    return "\n".join(
        [
            "#Earthquake Information",
            "#Origin Time(GMT+08): 2018/02/06-23:50:42",
            "#Magnitude(Ml): 6.0",
            "",
            "#StationCode: EGF",
            "#StationName: Somewhere",
            f"#RecordLength(sec): {count / 50:g}",
            "#SampleRate(Hz): 50",
            "#AmplitudeUnit:  gal. DCoffset(corr)",
            *peaks,
            "#DataSequence: Time U(+); N(+); E(+)",
            "#Data: 4F10.3",
            *("".join(f"{x:10.3f}" for x in (0.02 * n, *row)) for n, row in enumerate(table)),
            "",
        ]
    )


def csmip_rated(count: int = 60, channels: int = 3) -> str:
    """Volume 1 of CSMIP as it is since 2012: raw values in g and their rate."""
    lines = []
    for number in range(1, channels + 1):
        values = shaking(count, 120 + number, 0.3e6) * 1e-6
        code = ("90 Deg", "Up", "360 Deg")[number - 1]
        peak, at = values[np.argmax(np.abs(values))], 0.005 * np.argmax(np.abs(values))
        lines += [
            "Uncorrected Accelerogram Data             Processed: 06/16/16, CSMIP",
            "Record of Tue May 03, 2016 16:42:00.0 PDT",
            "Preliminary Processing",
            "36456-S4384-16123.01                 Start time:  5/03/16, 23:41:30.0 UTC (GPS)",
            f"Station No. 36456   35.9N, 120.4W     K2  s/n 4384  ({channels} Chns of  3 at Sta)",
            "A Place",
            f"Chan  {number}: {code}",
            f"No. of Points = {count:6d}  Record Length = {count / 200:.3f} sec at 200 Samples/sec",
            f"Units of uncor data are sec and g .        Max  = {peak:8.3f} g , at {at:6.3f} sec.",
            *rows(("    0" for _ in range(100)), 16),
            *rows(("   0.00000" for _ in range(50)), 8),
            f"{count:6d} Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)",
            *rows((f"{x:9.6f}" for x in values), 8),
            f"/&  ----------  End of data for channel  {number}  ----------",
        ]
    return "\n".join([*lines, ""])


def usc_volume_2(count: int = 100) -> str:
    """A corrected component of USC, of which no line says that it ends."""
    values = shaking(count, 130)
    largest = int(np.argmax(np.abs(values)))
    return "\n".join(
        [
            "CORRECTED ACCELEROGRAM  XX   COMP N90E   FILE   7",
            "FILE     7 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:",
            "AN EARTHQUAKE",
            "OCT 01, 1987",
            "STATION USC# 0013   34 13 12N, 118 25 12W",
            "1 SOME ST., SOMEWHERE",
            "COMP N90E",
            "UNITS ARE SEC AND G/10",
            f"{count:6d}  INSTRUMENT AND BASELINE CORRECTED DATA",
            "AT EQUALLY-SPACED INTERVALS OF    .020  SEC.",
            f"PEAK ACCELERATION = {values[largest]:12.5f} CMS/SEC/SEC AT {0.02 * largest:.3f} SEC.",
            *rows(("    0" for _ in range(100)), 16),
            *rows(("     0.000" for _ in range(100)), 8),
            f"{count:6d} POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC",
            *rows((f"{x:10.3f}" for x in values), 8),
            "",
        ]
    )


def unam(count: int = 100) -> str:
    table = np.column_stack([shaking(count, 140 + k, 30.0 + k) for k in range(3)])
    peaks = "/".join(f"{column[np.argmax(np.abs(column))]:.2f}" for column in table.T)
    return "\n".join(
        [
            "*" * 80,
            "ARCHIVO ESTANDAR DE ACELERACION:",
            "VERSION DEL FORMATO                    : 2.0",
            "NOMBRE DE LA ESTACION                  : UN LUGAR",
            "CLAVE DE LA ESTACION                   : LUGA",
            "ORIENTACION C1-C6 (rumbo;orientacion)  : /S60E;-L/+V;V/N30E;+T",
            "INTERVALO DE MUESTREO, C1-C6 (s)       : /0.01/0.01/0.01",
            f"NUM. TOTAL DE MUESTRAS, C1-C6          : /{count}/{count}/{count}",
            f"ACEL. MAX.(Gal), C1-C6                 : /{peaks}",
            "FECHA DEL SISMO [GMT]                  : 19 DE SEPTIEMBRE DE 1985",
            "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)",
            "FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.3",
            "DATOS DE ACELERACION:",
            "---------+---------+---------+",
            "   CANAL-1   CANAL-2   CANAL-3",
            "      S60E        +V      N30E",
            "---------+---------+---------+",
            *("".join(f"{x:10.3f}" for x in row) for row in table),
            "",
        ]
    )


def csmnc(count: int = 120) -> str:
    values = shaking(count, 150)
    largest = int(np.argmax(np.abs(values)))
    return "\n".join(
        [
            "051XXX080512142801",
            "0510805121428 2008-05-12 14:28:01 BTM",
            "SOME EARTHQUAKE, CHN",
            "EPICENTER  31.000N 103.400E DEPTH 14 KM",
            "MAGNITUDE  7.9(Ms)",
            "STATION: 051XXX 31.000N 103.700E",
            "COMP. UD",
            "CORRECTED ACCELERATION          UNIT: CM/SEC/SEC",
            f"NO. OF POINTS: {count:6d}  EQUALLY SPACED INTERVALS OF:  0.005  SEC",
            f"PEAK VALUE: {values[largest]:11.3f}   AT {0.005 * largest:.3f} SEC  DURATION:  1 SEC",
            "",
            *rows((f"{x:14.6E}" for x in values), 8),
            "",
        ]
    )


def csv(count: int = 100) -> str:
    values = shaking(count, 110, 30.0)
    return "\n".join(
        [
            "Time (s),NS (gal),EW (gal)",
            *(f"{0.01 * n:.2f},{x:.1f},{-x:.1f}" for n, x in enumerate(values)),
            "",
        ]
    )


def pairs(count: int = 100) -> str:
    return "\n".join(f"{0.01 * n:.2f} {x:.1f}" for n, x in enumerate(shaking(count, 111))) + "\n"


def column(count: int = 100) -> str:
    return "\n".join(f"{x:.1f}" for x in shaking(count, 112)) + "\n"


def headed_column(count: int = 100) -> str:
    return "\n".join(["980.665", "0.01", *(f"{x:.4f}" for x in shaking(count, 113) * 1e-3), ""])


def examples() -> dict[str, Example]:
    """A file of each format by its name."""
    unsaid = {"counted": False, "peaked": False}
    return {
        "a.AT2": Example(at2(), timed=False, peaked=False),
        "rotated.at2": Example(at2_rotated(), timed=False, peaked=False),
        "a.V2": Example(csmip()),
        "a.V1C": Example(cosmos()),
        "a.v1": Example(renadic()),
        "uneven.v1": Example(renadic(uneven=True), even=False, peaked=False),
        "5523-1.V1": Example(bhrc(), peaked=False),
        "AOM003.EW": Example(knet()),
        "a.ASC": Example(esm()),
        "old.acc": Example(esm_old(), timed=False),
        "a.V2A": Example(geonet()),
        "a.V1A": Example(geonet(corrected=False)),
        "a.smc": Example(smc()),
        "uneven.smc": Example(smc(uneven=True), even=False, peaked=False),
        "since2012.V1": Example(csmip_rated(), peaked=False),
        "usc.s0a": Example(usc_volume_2()),
        "unam.txt": Example(unam(), timed=False),
        "csmnc.dat": Example(csmnc(), timed=False),
        "nsmn.txt": Example(nsmn(), timed=False),
        "cwb.dat": Example(cwb()),
        "a.csv": Example(csv(), **unsaid),
        "pairs.txt": Example(pairs(), {"units": "gal"}, **unsaid),
        "column.txt": Example(column(), {"units": "gal", "time_step": 0.01}, **unsaid),
        "headed.txt": Example(headed_column(), {"units": "g"}, timed=False, **unsaid),
    }


AT2 = (
    "PEER NGA STRONG MOTION DATABASE RECORD\nQuake, 1/1/2000, Place, {code}\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  {count}, DT= .01 SEC\n"
)


def write_at2(folder: Path, name: str, code: str, series: np.ndarray) -> Path:
    """A record in PEER's format, in g, whose component's azimuth is its code."""
    path = folder / name
    rows = "\n".join(f"{value: .7E}" for value in series)
    path.write_text(AT2.format(code=code, count=series.size) + rows + "\n")
    return path
