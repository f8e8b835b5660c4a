"""Planar bodies among walls, edges and straps, by the general model.

Free bodies never come here: `physics.plane` takes them through their phases. What may touch
something else has too many phases for a table; here every contact has one form, a place, a normal
and a lever (`touches`), and one enumeration finds the forces and the impulses that all closed
contacts admit together (`admissible`).
"""
