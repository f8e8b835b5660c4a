"""Pictures of one run, its history and its film, and the files they are written to.

They need nothing but the thing that they show.
"""
