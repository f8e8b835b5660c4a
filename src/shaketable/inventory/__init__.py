"""Inventories: tables of objects, and the bodies that stand for them."""

from shaketable.inventory.directions import both_directions
from shaketable.inventory.item import BaseShape, Castors, Item
from shaketable.inventory.read import Inventory, read_inventory, read_with_columns
from shaketable.inventory.shapes import solid_of
from shaketable.inventory.surroundings import RESTITUTION

__all__ = [
    "RESTITUTION",
    "BaseShape",
    "Castors",
    "Inventory",
    "Item",
    "both_directions",
    "read_inventory",
    "read_with_columns",
    "solid_of",
]
