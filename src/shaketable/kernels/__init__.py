"""The physics, once, as compiled scalar functions that any engine can drive."""
