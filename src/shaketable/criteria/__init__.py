"""Published criteria, one to a file; they take SI."""
