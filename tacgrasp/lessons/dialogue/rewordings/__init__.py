"""Questions in a plainer construction of the same meaning, which the readers of questions know.

Also those that are written as a program writes them, which are expressions already.

Not here: what a question means (``tacgrasp.lessons.understanding``).

May import: cltp.tactile, cltp.texts, policies.instructions.quantities, tacgrasp.lessons.dialogue.
"""
