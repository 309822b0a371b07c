"""How an answer is judged: files of questions, answers read back, what counts as right.

Not here: what a question means and its true answer (``tacgrasp.lessons.dialogue``), which
questions a model is asked (``tacgrasp.lessons.question_scores``).

May import: cltp.tactile, cltp.texts, policies, primitives, tacgrasp.base,
tacgrasp.lessons.dialogue.
"""
