"""Runs OpenQuake's classical damage calculation of one site with a file that shaketable wrote.

It runs in an environment of its own: `python read_openquake.py FILE NAME`, where FILE is what
`to_nrml` wrote and NAME one of its bodies; it prints what it found as JSON. The hazard is a power
law in 28 steps. OpenQuake's readers of maps (GDAL) are not needed for this and are stood in for.
"""

from __future__ import annotations

import json
import sys
import types

import numpy as np

sys.modules.setdefault("osgeo", types.ModuleType("osgeo"))

from openquake.hazardlib import nrml  # noqa: E402
from openquake.risklib.scientific import classical_damage  # noqa: E402

STEPS = 28
EXPONENT = 2.5
YEARS = 50.0

path, name = sys.argv[1:]
model = nrml.to_python(path)
measure, functions = next((key[0], value) for key, value in model.items() if key[1] == name)
functions = functions.build(model.limitStates)
levels = np.geomspace(2.0, 400.0, STEPS + 1)  # cm/s
rates = 0.02 * (levels / 20.0) ** -EXPONENT  # a year
poes = -np.expm1(-rates * YEARS)
shares = classical_damage(functions, levels, poes, YEARS, YEARS)
print(
    json.dumps(
        {
            "measure": measure,
            "limit states": model.limitStates,
            "shares": [float(share) for share in shares],
            "levels": levels.tolist(),
            "rates": rates.tolist(),
            "years": YEARS,
        }
    )
)
