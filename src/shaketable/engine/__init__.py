"""Loops over bodies and samples around the kernels; no formula of the physics stands here."""
