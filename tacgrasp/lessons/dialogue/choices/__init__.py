"""Questions that name the alternatives of their answer: 'deeper or shallower than 0.6 mm?'.

    Does it cover more or less than a quarter of the pad?   'more' if area_percent > 25 else 'less'
    To bring the grip to 3 N, must I tighten or loosen?     'tighten' if force_n < 3 else 'loosen'
    Pick one: touching or free?                             'touching' if contact else 'free'
    Which way is it off more, sideways or lengthwise?

The alternatives are words of a scale, and an answer has the word that the question used. What else
the question says must be understood word for word, else it is left to others. What these read is
said in the question's words all the same (``own_words``).

Not here: which of two terms is greater or nearer, where they are named so
(``tacgrasp.lessons.dialogue.calculations.choices``).

May import: cltp.tactile, tacgrasp.lessons.dialogue, tacgrasp.lessons.dialogue.calculations,
tacgrasp.lessons.dialogue.families.classes.
"""
