"""Questions about the contact as a whole, its sides, and several things at once.

Not here: other families (``tacgrasp.lessons.dialogue.families``).

May import: tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.families.classes,
tacgrasp.lessons.dialogue.families.grasps, tacgrasp.lessons.dialogue.patterns.
"""
