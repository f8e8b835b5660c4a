"""What an earthquake of a magnitude at a distance does to the ground.

Ground-motion models give the median and the standard deviation of ln of each spectral ordinate:
Boore, Stewart, Seyhan and Atkinson (BSSA14), Abrahamson, Silva and Kamai (ASK14), Campbell and
Bozorgnia (CB14), and Chiou and Youngs (CY14), all of 2014, for shallow earthquakes of active
regions, in the implementation of Kottke's pygmm. Ordinates of one motion are correlated after
Baker and Jayaram (2008), significant durations are those of Afshari and Stewart (2016).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_not_negative, require_positive, require_whole
from shaketable.extras import require
from shaketable.signal import Measure, measure_named
from shaketable.signal.spectra import Spectrum
from shaketable.units import STANDARD_GRAVITY

#: Ground-motion models by their abbreviation, with the class of pygmm.
MODELS = {
    "BSSA14": "BooreStewartSeyhanAtkinson2014",
    "ASK14": "AbrahamsonSilvaKamai2014",
    "CB14": "CampbellBozorgnia2014",
    "CY14": "ChiouYoungs2014",
}
#: Kinds of faulting, with pygmm's word and a usual dip [degrees].
MECHANISMS = {"strike-slip": ("SS", 90.0), "reverse": ("RS", 45.0), "normal": ("NS", 55.0)}
#: Periods [s] at which the models have coefficients: between others they are interpolated.
NODES = (
    0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0,
    4.0, 5.0, 7.5, 10.0,
)  # fmt: skip
_EVEN = np.geomspace(0.01, 10.0, 61)
_APART = np.abs(np.log(_EVEN[:, None] / np.array(NODES))).min(axis=1) > 0.02
PERIODS = np.sort(np.append(_EVEN[_APART], NODES))
CHECKED = {
    "depth_hyp": "hypocentral depth",
    "mag": "magnitude",
    "dist_jb": "distance",
    "dist_rup": "distance",
    "v_s30": "Vs30",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Scenario:
    """The ground motion of one earthquake at one site, as ground-motion models tell it.

    The logarithms of several models' medians are averaged by their weights; their standard
    deviation holds that of each model and what they differ by.

    Attributes:
        magnitude: moment magnitude.
        distance: Joyner-Boore's, to the rupture's projection to the surface [km].
        vs30: shear-wave velocity of the upper 30 m [m/s].
        mechanism: strike-slip, reverse or normal.
        weights: of each model, 1 in all.
        periods: [s], (n,).
        ln_spectrum, sigma: mean and standard deviation of ln pseudo-acceleration [m/s²], (n,).
        peaks: the same two of PGA [m/s²] and PGV [m/s].
        duration: median and standard deviation of ln of the significant duration D5-95 [s].
        hypocentral_depth: that CB14 took [km], NaN without CB14.
    """

    magnitude: float
    distance: float
    vs30: float
    mechanism: str
    weights: Mapping[str, float]
    periods: NDArray[np.float64]
    ln_spectrum: NDArray[np.float64]
    sigma: NDArray[np.float64]
    peaks: Mapping[str, tuple[float, float]]
    duration: tuple[float, float]
    hypocentral_depth: float = math.nan

    @property
    def name(self) -> str:
        """In words."""
        return (
            f"magnitude {self.magnitude:g} at {self.distance:g} km ({self.mechanism}, Vs30 "
            f"{self.vs30:g} m/s)"
        )

    @property
    def spectrum(self) -> Spectrum:
        """The median spectrum."""
        return Spectrum(self.periods, np.exp(self.ln_spectrum), name=self.name)

    def of(self, measure: str | Measure) -> tuple[float, float]:
        """The mean and the standard deviation of ln of PGA, PGV or SA(T) [SI].

        Raises:
            InputError: a measure that the models do not give.
        """
        known = measure_named(measure) if isinstance(measure, str) else measure
        if known.name in self.peaks:
            return self.peaks[known.name]
        if not known.name.startswith("SA("):
            raise InputError(
                f"ground-motion models give PGA, PGV and SA(T), not {known.name}: find the "
                "fragility function of one of these"
            )
        period = float(known.name[3:-1])
        if not self.periods[0] <= period <= self.periods[-1]:
            raise InputError(f"{known.name}: the models give periods from 0.01 to 10 s")
        at = np.log(period), np.log(self.periods)
        return float(np.interp(*at, self.ln_spectrum)), float(np.interp(*at, self.sigma))

    def spectra(self, n: int, seed: int = 0) -> NDArray[np.float64]:
        """Pseudo-accelerations of drawn motions, at the periods [m/s²], (n, period).

        The median of two horizontal components in any direction, which is what the models give.
        """
        require_whole("n", n)
        drawn = np.random.default_rng(seed).standard_normal((n, self.periods.size))
        root = np.linalg.cholesky(self.correlation + 1e-9 * np.eye(self.periods.size))
        return np.asarray(np.exp(self.ln_spectrum + self.sigma * (drawn @ root.T)))

    @property
    def correlation(self) -> NDArray[np.float64]:
        """Of ln pseudo-accelerations at two periods, Baker and Jayaram (2008), (n, n)."""
        return correlation(self.periods)


def correlation(periods: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of ln pseudo-accelerations at two periods [s], Baker and Jayaram (2008), (n, n)."""
    calc = _pygmm("pygmm.baker_jayaram_2008").calc_correls
    return np.array([calc(periods, period) for period in periods])


def scenario(
    magnitude: float,
    distance_km: float,
    vs30: float = 760.0,
    *,
    mechanism: str = "strike-slip",
    models: Mapping[str, float] | None = None,
    dip: float | None = None,
    depth_to_top: float | None = None,
    region: str = "california",
    hypocentral_depth: float | None = None,
) -> Scenario:
    """Predict the ground motion of an earthquake of a given magnitude and distance.

    Args:
        magnitude: moment magnitude.
        distance_km: Joyner-Boore's, to the rupture's projection to the surface; the site is on the
            footwall.
        vs30: shear-wave velocity of the upper 30 m [m/s].
        mechanism: strike-slip, reverse or normal.
        models: weights of the ground-motion models, of MODELS; the same for all four by default.
        dip: of the fault [degrees]; 90, 45 or 55 by its mechanism.
        depth_to_top: of the rupture [km]; by default that of Kaklamanos, Baise and Boore (2011).
        region: of the models.
        hypocentral_depth: [km], 0 to 20: CB14's median rises with it from 7 km depth on; by default
            its own estimate from magnitude, dip and the rupture's top.

    Raises:
        InputError: values outside the models' range, an unknown word, or pygmm is not there.
    """
    require_positive("magnitude", magnitude)
    require_not_negative("distance [km]", distance_km)
    require_positive("vs30 [m/s]", vs30)
    if mechanism not in MECHANISMS:
        raise InputError(f"mechanism={mechanism!r}: accepted are {', '.join(MECHANISMS)}")
    weights = dict.fromkeys(MODELS, 1.0) if models is None else dict(models)
    unknown = set(weights) - set(MODELS)
    total = sum(weights.values())
    if unknown or not weights or min(weights.values()) < 0.0 or not total > 0.0:
        raise InputError(
            f"models: expected weights, not negative, of {', '.join(MODELS)}; found "
            f"{', '.join(f'{name}={value:g}' for name, value in weights.items()) or 'none'}"
        )
    word, usual = MECHANISMS[mechanism]
    top = _depth_to_top(magnitude, mechanism) if depth_to_top is None else depth_to_top
    given = {
        "mag": magnitude, "dist_jb": distance_km, "dist_rup": math.hypot(distance_km, top),
        "dist_x": -distance_km, "v_s30": vs30, "mechanism": word, "region": region,
        "dip": usual if dip is None else dip, "depth_tor": top,
    }  # fmt: skip
    if hypocentral_depth is not None:
        require_not_negative("hypocentral depth [km]", hypocentral_depth)
        given["depth_hyp"] = hypocentral_depth
    return _averaged(given, mechanism, {name: w / total for name, w in weights.items() if w})


def _averaged(given: dict[str, Any], mechanism: str, weights: Mapping[str, float]) -> Scenario:
    """The scenario of the models, averaged by their weights."""
    pygmm = _pygmm("pygmm")
    told = pygmm.Scenario(**given)
    means, deviations, depth = [], [], math.nan
    for name in weights:
        model = getattr(pygmm, MODELS[name])
        _require_range(name, model, given)
        one = model(told)
        if name == "CB14":
            depth = float(one.scenario.depth_hyp)
        means.append([
            np.log(one.pga * STANDARD_GRAVITY), np.log(one.pgv * 0.01),
            *(one.interp_ln_spec_accels(PERIODS) + math.log(STANDARD_GRAVITY)),
        ])  # fmt: skip
        deviations.append([one.ln_std_pga, one.ln_std_pgv, *one.interp_ln_stds(PERIODS)])
    share = np.array(list(weights.values()))
    mean = share @ np.array(means)
    sigma = np.sqrt(share @ (np.array(deviations) ** 2 + (np.array(means) - mean) ** 2))
    durations = pygmm.AfshariStewart2016(told)
    return Scenario(
        magnitude=given["mag"],
        distance=given["dist_jb"],
        vs30=given["v_s30"],
        mechanism=mechanism,
        weights=weights,
        periods=PERIODS,
        ln_spectrum=mean[2:],
        sigma=sigma[2:],
        peaks={"PGA": (mean[0], sigma[0]), "PGV": (mean[1], sigma[1])},
        duration=(float(durations.duration.D_5t95), float(durations.std_err.D_5t95)),
        hypocentral_depth=depth,
    )


def _require_range(name: str, model: Any, given: Mapping[str, Any]) -> None:
    """InputError where a model is not given for the scenario; says the range."""
    for parameter in model.PARAMS:
        told = CHECKED.get(parameter.name)
        if told is None:
            continue
        if parameter.name not in given:
            continue
        value = given[parameter.name]
        low = getattr(parameter, "min", None) or 0.0
        high = getattr(parameter, "max", None) or math.inf
        if not low <= value <= high:
            raise InputError(
                f"{told} {value:g}: {name} is given from {low:g} to {high:g}; stay within, or name "
                f"models without it, of {', '.join(MODELS)}"
            )


def _depth_to_top(magnitude: float, mechanism: str) -> float:
    """Depth to the top of the rupture [km], Kaklamanos, Baise and Boore (2011), eqs. 4 and 5.

    Estimating unknown input parameters when implementing the NGA ground-motion prediction
    equations in engineering practice, Earthquake Spectra 27(4):1219-1235; here as squares, after
    Chiou and Youngs (2014), eqs. 4 and 5.
    """
    if mechanism == "reverse":
        return max(2.704 - 1.226 * max(magnitude - 5.849, 0.0), 0.0) ** 2
    return max(2.673 - 1.136 * max(magnitude - 4.970, 0.0), 0.0) ** 2


def _pygmm(name: str) -> ModuleType:
    """A module of pygmm.

    Raises:
        InputError: it is not installed.
    """
    require("scenario", "a scenario")
    return import_module(name)
