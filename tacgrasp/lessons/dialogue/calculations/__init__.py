"""Questions that calculate: terms of quantities and numbers, and what is asked of them.

    How far are we below half of the limit?     0.5 * limit_n - force_n
    What percentage of 2 mm is the depth?       100 * depth_mm / 2
    If the force dropped by 20 %, what remains? 0.8 * force_n
    Is it nearer to the limit or to 1 N?        'limit' if ... else '1 N'

A term is a noun phrase that means an expression, and terms stand within terms. So no list of
quantities has to have each sum, share and distance.

Not here: questions that the grammar or a rule reads (``tacgrasp.lessons.dialogue.families``,
``tacgrasp.lessons.dialogue.rules``), answers (``tacgrasp.lessons.dialogue.answers``).

May import: tacgrasp.lessons.dialogue.
"""
