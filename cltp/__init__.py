"""Perception and learning: tactile clouds, contact states, encoders, language, datasets, training.

Knows nothing of robots or of simulation; imports none of the other four packages. Importing this
package loads no torch: the learning modules import it where they use it.
"""

from cltp.errors import TouchError

__all__ = ["TouchError"]
