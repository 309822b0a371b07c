"""Questions whether a number lies above, below or between others.

Not here: other families (``tacgrasp.lessons.dialogue.families``).

May import: tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.patterns.
"""
