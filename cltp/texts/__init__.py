"""Texts about contacts: captions, paraphrases, prompts, questions, and their tokenizer.

Not here: instructions and lessons for the language model (``tacgrasp.lessons``).

May import: cltp, cltp.data, cltp.tactile.
"""
