"""The families of questions: wordings as patterns, with the meaning of each.

Not here: how patterns are read (``tacgrasp.lessons.dialogue.patterns.pattern``), the answers
(``tacgrasp.lessons.dialogue.answers``).

May import: tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.patterns,
tacgrasp.lessons.dialogue.families.amounts, tacgrasp.lessons.dialogue.families.classes,
tacgrasp.lessons.dialogue.families.comparisons, tacgrasp.lessons.dialogue.families.contacts,
tacgrasp.lessons.dialogue.families.grasps, tacgrasp.lessons.dialogue.families.unfelt.
"""
