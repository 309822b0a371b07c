"""Training of CLIP, the tactile encoder, its baselines and the language model.

Every stage can be stopped at any time and continues at its checkpoint. Not here: the data
(``cltp.data``), the calibration of a sensor (``cltp.train.photometric``), measuring
(``cltp.evaluation``) and the order of stages (``tacgrasp.pretraining``, ``tacgrasp.training``).

May import: cltp, cltp.checkpoints, cltp.data, cltp.encoder, cltp.llm, cltp.tactile, cltp.texts.
"""
