"""Perception and learning: tactile clouds, contact states, encoders, language, data sets, training.

Not here: robots (``tacgrasp``), simulation (``sim``), decisions (``policies``). Importing this
package loads no torch; the learning modules import it where they use it.

May import: nothing of ours.
"""

from cltp.errors import TouchError

__all__ = ["TouchError"]
