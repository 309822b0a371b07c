"""Questions about a contact and their true answers: meaning, wordings and reading.

A grammar (``families``) makes wordings, each with its meaning. A meaning has a truth in every
scene, from which ``answers`` words the answer.

Not here: judging an answer (``tacgrasp.lessons.dialogue.scoring``), asking a model
(``tacgrasp.training``, ``tacgrasp.playback``).

May import: cltp.llm.constrained, cltp.tactile, cltp.texts, policies, primitives.
"""
