"""Questions for a number: of what is felt, of where it lies, and of what is agreed.

Not here: other families (``tacgrasp.lessons.dialogue.families``).

May import: tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.families.comparisons,
tacgrasp.lessons.dialogue.patterns.
"""
