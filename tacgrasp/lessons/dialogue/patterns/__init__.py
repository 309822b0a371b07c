"""Patterns of wordings: their notation, recognition, shared phrases, and families of questions.

Not here: the families themselves (``tacgrasp.lessons.dialogue.families``).

May import: tacgrasp.lessons.dialogue.
"""
