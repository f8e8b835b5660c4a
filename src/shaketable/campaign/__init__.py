"""Campaigns: simulations in blocks, here or on many machines, resumable, each counted once."""

from shaketable.campaign.results import open_campaign
from shaketable.campaign.run import run_campaign

__all__ = ["open_campaign", "run_campaign"]
