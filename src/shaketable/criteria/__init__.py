"""Published criteria, one per file; all quantities are in SI."""
