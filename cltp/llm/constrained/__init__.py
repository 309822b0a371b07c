"""Replies that keep to a grammar: the grammar as data, its tokens, and greedy decoding under it.

Not here: the grammar of D_t (``policies.llm.grammar``), replies in free words
(``cltp.llm.generation``).

May import: cltp.
"""
