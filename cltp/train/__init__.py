"""Training of CLIP, the tactile encoder, its baselines, the language model and the calibration.

Every stage can be stopped at any time and continues at its checkpoint. Not here: the data
(``cltp.data``), measuring (``cltp.evaluation``) and the order of stages (``tacgrasp.pretraining``,
``tacgrasp.training``).

May import: cltp, cltp.checkpoints, cltp.data, cltp.encoder, cltp.llm, cltp.sensing, cltp.tactile,
cltp.texts.
"""
