"""Whether anything touches the gel, and the drift of the gel around what does.

Not here: what a contact is like (``cltp.tactile.measure``).

May import: cltp, cltp.tactile.
"""
