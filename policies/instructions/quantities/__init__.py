"""Quantities that an instruction names: forces with what bounds them, changes of the task's, lengths, masses.

The text is rewritten step by step until each force has a unit and its relation before it (``numerals``,
``tolerances``, ``bounds``, ``elisions``); then it is read. Not here: manner, and what becomes of a
force (``policies.force_terms``).

May import: policies.instructions.english.
"""

from policies.instructions.quantities.force import MARK, Force
from policies.instructions.quantities.reading import Quantities, read_quantities

__all__ = ["MARK", "Force", "Quantities", "read_quantities"]
