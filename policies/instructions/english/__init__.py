"""English as people type it: its plain form, slips of the keyboard, lists of words, denials.

Not here: what a text asks for (``policies.instructions``) and its numbers
(``policies.instructions.quantities``).

May import: nothing of ours.
"""
