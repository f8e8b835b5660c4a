"""Solids in three dimensions: compiled scalar physics, and the drivers around it."""
