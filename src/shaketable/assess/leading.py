"""On how many kinds of object measures are tried; alone, so that help texts load nothing."""

LEADING = 10
