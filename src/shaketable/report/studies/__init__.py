"""Views of the studies: their figures, and the folder that holds a study's results."""
