"""Questions about the grasp under its contract: force, lifting and slipping, advice.

Not here: other families (``tacgrasp.lessons.dialogue.families``).

May import: tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.patterns.
"""
