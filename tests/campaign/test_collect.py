"""Tables of campaigns: the counts and intervals of what `simulate_many` gives."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from shaketable.campaign import open_campaign, run_campaign
from shaketable.campaign.collect import falls_table
from shaketable.campaign.objects import Objects
from shaketable.campaign.results import simulations_of
from shaketable.resampling import events_of, recordings_of, wilson_interval


@pytest.mark.parametrize("keep", ["all", "summary"])
def test_counts_and_intervals(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, keep: str
) -> None:
    run_campaign(**small, store=tmp_path, keep=keep)
    table = falls_table(open_campaign(tmp_path), simulations_of(Objects(tmp_path)).plan)
    assert len(table) == 5 * 2
    down = (known["outcome"] == -1).sum(["motion", "polarity"]).transpose("body", "tilt", "scale")
    assert np.array_equal(table["falls_downhill"], down.values.ravel())
    fell = known["outcome"] != 0
    share = fell.mean(["motion", "polarity"]).transpose("body", "tilt", "scale").values.ravel()
    assert table["fall_share"].to_numpy() == pytest.approx(share)
    recording = recordings_of(small["motions"])
    low, high = wilson_interval(share, recording.max() + 1)
    assert table["fall_share_low"].to_numpy() == pytest.approx(low)
    assert table["fall_share_high"].to_numpy() == pytest.approx(high)
    # the ratio estimator over events by its definition (Cochran 1977, eq. 6.9)
    event = events_of(small["motions"])[recording]
    each = fell.sum("polarity").transpose("motion", "body", "tilt", "scale").values
    groups = [np.flatnonzero(event == k) for k in np.unique(event)]
    falls = np.array([each[group].sum(axis=0).ravel() for group in groups])
    number = np.array([2 * group.size for group in groups])[:, None]
    off = np.square(falls - share * number).sum(axis=0)
    error = np.sqrt(off * len(groups) / (len(groups) - 1)) / number.sum()
    assert table["fall_error_events"].to_numpy() == pytest.approx(error)


def test_both_ways_of_keeping_give_one_table(small: dict[str, Any], tmp_path: Path) -> None:
    tables = []
    for keep in ("all", "summary"):
        run_campaign(**small, store=tmp_path / keep, keep=keep)
        store = tmp_path / keep
        tables.append(falls_table(open_campaign(store), simulations_of(Objects(store)).plan))
    pd.testing.assert_frame_equal(*tables)
