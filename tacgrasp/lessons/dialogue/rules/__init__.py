"""Questions that a rule reads, for what no pattern of the grammar composes: plain words to a query.

A rule knows a class of questions by a few words, and reads none that has several clauses unless it
accounts for each of their words. What every query would miss is none, so that it is not taken for
something near.

Not here: wordings with their meanings (``tacgrasp.lessons.dialogue.families``), what is left out of
a question (``tacgrasp.lessons.dialogue.plainer``).

May import: primitives, cltp.tactile, policies, tacgrasp.lessons.dialogue,
tacgrasp.lessons.dialogue.families.classes.
"""
