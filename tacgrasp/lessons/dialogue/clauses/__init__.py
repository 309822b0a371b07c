"""Clauses that state or ask for something, read word by word: every word must have its meaning.

    a cone pressed in by over 0.4 mm            shape == 'peak' and depth_mm > 0.4
    True or false: we are under a newton.       force_n < 1
    dump: force N, depth mm, band status        three things
    whose is this?                              touch can't know it

A clause is known by marks, in any order, among words that change nothing. With one word of which
neither is so it means nothing here.

Not here: wordings that a grammar composes (``tacgrasp.lessons.dialogue.families``), terms
(``tacgrasp.lessons.dialogue.calculations``).

May import: tacgrasp.lessons.dialogue.
"""
