"""Reads an action and a verdict out of any text, for every policy alike.

Not here: what a policy advises (``policies.teacher``) and how it words that (``policies.speech``).

May import: cltp.tactile, primitives.
"""

from policies.extraction.extraction import Extraction, extract
from policies.extraction.patterns import DESCRIPTORS

__all__ = ["DESCRIPTORS", "Extraction", "extract"]
