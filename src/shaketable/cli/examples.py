"""Two examples for the help of every command."""

from __future__ import annotations

EXAMPLES = {
    "": ("shaketable", "shaketable assess rooms.xlsx"),
    "open": ("shaketable open", "shaketable open --port 9000"),
    "assess": (
        "shaketable assess rooms.xlsx --out rooms",
        "shaketable assess rooms.csv --building clinic.toml --pga-levels 0.2g,0.4g,0.6g",
    ),
    "room": (
        "shaketable room check examples/hospital_room.toml --out plan.png",
        "shaketable room film examples/hospital_room.toml --out room.gif",
    ),
    "simulate": (
        "shaketable simulate --base-m 0.32 --height-m 1.8 --record RSN1004.AT2 --plot shelf.png",
        "shaketable simulate --base-m 0.5 --height-m 1.1 --record a.txt --units g "
        "--time-step-s 0.01 --model general --static-friction 0.4",
    ),
    "tilt": (
        "shaketable tilt --base-m 0.32 --height-m 1.8 --plot tilt.png",
        "shaketable tilt --base-m 0.32 --height-m 1.8 --tilt-deg 2 --building clinic.toml "
        "--motions fema-p695-far-field",
    ),
    "criteria": (
        "shaketable criteria --base-m 0.32 --height-m 1.8 --pga-g 0.4 --pgv-cm-s 40",
        "shaketable criteria --base-m 0.6 --height-m 1.6 --eccentricity 0.42 --record RSN1004.AT2",
    ),
    "initial-modes": (
        "shaketable initial-modes --base-m 0.5 --height-m 1.0 --static-friction 0.4",
        "shaketable initial-modes --base-m 0.5 --height-m 1.0 --static-friction 0.45 "
        "--kinetic-friction 0.4 --eccentricity 0.4 --out cart.png",
    ),
    "fragility": (
        "shaketable fragility --base-m 0.32 --height-m 1.8 --out bookcase --export nrml,pelicun",
        "shaketable fragility --inventory examples/hospital.csv --measure 'SA(1.0)' "
        "--limit-states 'rocks 0.5 alpha, overturns' --out hospital",
    ),
    "library": (
        "shaketable library library/fema-p58.csv --find 'bookcase ground' --measure PGV "
        "--limit-state overturns",
        "shaketable library library/fema-p58.csv --find lateral --out lateral",
    ),
    "hazard": (
        "shaketable hazard examples/hazard.csv examples/hospital.csv --out yearly",
        "shaketable hazard hazard_curve-mean-PGV_1.csv examples/clinic.csv --site 8.5,47.4 "
        "--building examples/clinic.toml --out yearly",
    ),
    "scenario": (
        "shaketable scenario rooms.csv --magnitude 7 --distance-km 20 --vs30 400 --out quake",
        "shaketable scenario city.csv --shakemap grid.xml --out quake",
    ),
    "ida": (
        "shaketable ida --base-m 0.32 --height-m 1.8 --out capacities",
        "shaketable ida --inventory examples/hospital.csv --measure PGA --out capacities",
    ),
    "overturning-spectrum": (
        "shaketable overturning-spectrum --base-m 0.32 --height-m 1.8 --pulse ricker "
        "--out spectrum",
        "shaketable overturning-spectrum --record RSN1004.AT2 --slenderness-deg 10,20 "
        "--out rocking",
    ),
    "calibrate": (
        "shaketable calibrate examples/tests.csv --motions fema-p695 --out calibrated",
        "shaketable calibrate tests.csv --motions table --predict others.csv --depth-m 0.12 "
        "--height-m 0.6 --out calibrated",
    ),
    "campaign": (
        "shaketable campaign run examples/campaign.toml --store results.zarr",
        "shaketable campaign run examples/campaign.toml --store results.zarr --workers 4",
        "shaketable campaign collect results.zarr --out collected",
    ),
    "records": (
        "shaketable records RSN1004.AT2 station.V2",
        "shaketable records downloads --out measured",
    ),
    "select-motions": (
        "shaketable select-motions fema-p695 --magnitude 7 --distance-km 20 --vs30 400 --number 20 "
        "--out chosen",
        "shaketable select-motions downloads --magnitude 7 --distance-km 20 --period-s 1 "
        "--level 0.3g --out chosen",
    ),
    "serve": ("shaketable serve", "shaketable serve --port 9000 --workers 2"),
    "template": ("shaketable template", "shaketable template --tests --xlsx"),
    "suites": ("shaketable suites", "shaketable assess rooms.csv --motions near-field-pulse"),
}
STUDY = (
    "shaketable study {name} --out again",
    "shaketable study {name} --motions downloads --seed 1 --out mine",
)


def epilog(name: str) -> str:
    """The examples of a command below its help."""
    return _lines(EXAMPLES[name])


def study_epilog(name: str = "NAME") -> str:
    """The examples of a study's command."""
    return _lines(tuple(each.format(name=name) for each in STUDY))


def _lines(examples: tuple[str, ...]) -> str:
    return "\b\nExamples:\n" + "\n".join(f"  {example}" for example in examples)
