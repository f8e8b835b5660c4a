"""The equations of motion: `plane` for bodies in a vertical plane, `space` for solids.

They are compiled, and meet nowhere else. `engine` runs many planar bodies at once, and both of them
on a GPU.
"""
