"""Questions about the five words of a contact: open, offered, and checked.

Not here: other families (``tacgrasp.lessons.dialogue.families``).

May import: cltp.tactile, tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.patterns.
"""
