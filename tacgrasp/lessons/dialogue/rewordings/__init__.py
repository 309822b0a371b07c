"""Questions in a plainer construction of the same meaning, which the readers of questions know.

Not here: what a question means (``tacgrasp.lessons.understanding``).

May import: cltp.texts, tacgrasp.lessons.dialogue.
"""
