"""Pictures that need nothing but what they show: a run's history and its film; picture files."""
