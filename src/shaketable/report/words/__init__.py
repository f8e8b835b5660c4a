"""Results as sentences that a facility manager can act on."""
