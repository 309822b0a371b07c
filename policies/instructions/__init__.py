"""What a person's instruction says: forces in numbers, manner, and what must be refused.

Plain rules over English words, without a model: the same words mean the same in every episode. Not
here: what becomes of it (``policies.contract``).

May import: policies.instructions.english, policies.instructions.quantities.
"""
