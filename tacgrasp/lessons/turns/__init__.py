"""Questions of a dialogue: each is read with what it leaves to those before it.

A follow-up is written anew so that it stands alone, and is then read as any other question. What
the next one follows is that text, so that several in a row lose nothing.

Not here: what a question alone means (``tacgrasp.lessons.understanding``), what is felt
(``tacgrasp.playback.conversation``).

May import: cltp.tactile, policies.instructions, primitives, tacgrasp.lessons,
tacgrasp.lessons.dialogue.
"""
