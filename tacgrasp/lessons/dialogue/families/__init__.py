"""The families of questions: wordings as patterns, with the meaning of each.

Not here: how patterns are read (``tacgrasp.lessons.dialogue.pattern``), the answers
(``tacgrasp.lessons.dialogue.answers``).

May import: cltp.tactile, tacgrasp.lessons.dialogue.
"""
