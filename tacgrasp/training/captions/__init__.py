"""Captions of contacts, rated 1 to 5 by a rule and by a judge, beside the paper's (appendix C).

Not here: the percentages of ``tacgrasp eval`` (``tacgrasp.training.evaluate``), the table
(``tacgrasp.pretraining.report``).

May import: cltp, policies.llm, tacgrasp, tacgrasp.base, tacgrasp.lessons,
tacgrasp.lessons.dialogue, tacgrasp.pretraining, tacgrasp.pretraining.report, tacgrasp.training.
"""
