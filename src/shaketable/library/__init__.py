"""Fragility functions of many common things, computed by a stated rule and published."""
