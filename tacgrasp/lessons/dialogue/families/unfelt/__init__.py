"""What touch can't know of a thing, and what has nothing to do with it.

Not here: other families (``tacgrasp.lessons.dialogue.families``).

May import: tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.patterns.
"""
