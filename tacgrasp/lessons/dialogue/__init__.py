"""Questions about a contact and their true answers: meaning, wordings, reading and scoring.

A grammar (``families``) makes wordings, each with its meaning. A meaning has a truth in every
scene, from which ``answers`` words the answer and ``answer_scores`` judges one.

Not here: asking a model (``tacgrasp.training``, ``tacgrasp.playback``).

May import: cltp.llm.constrained, cltp.tactile, cltp.texts, policies, primitives, tacgrasp.base.
"""
