"""
A campaign on Dask
==================

Simulations that are too many for memory go to a store in blocks. The same call runs on this
machine or on a cluster, and an interrupted campaign goes on where it stopped. (The extra
``cluster`` brings Dask and Zarr.)
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from distributed import Client

from shaketable import Body, Outcome, run_campaign, suite

bases, heights = np.linspace(0.2, 0.6, 9), np.linspace(0.6, 2.2, 9)
bodies = [Body.rectangle(base, height) for height in heights for base in bases]
store = Path(tempfile.mkdtemp()) / "campaign.zarr"

# A scheduler's address in place of these two workers makes it a cluster: Client("tcp://host:8786").
with Client(n_workers=2, threads_per_worker=1, dashboard_address=None, processes=False) as client:
    runs = run_campaign(
        bodies, suite("fema-p695-far-field"), store=store, client=client, progress=False
    )
share = (runs.outcome != Outcome.STANDING).mean(("motion", "polarity", "tilt", "scale"))
print(f"{runs.outcome.size:,} simulations in {store.name}")

figure, ax = plt.subplots()
drawn = ax.contourf(bases, heights, 100 * share.values.reshape(9, 9), np.arange(0, 101, 10))
figure.colorbar(drawn, label="overturns [%]")
ax.set(xlabel="base [m]", ylabel="height [m]")
