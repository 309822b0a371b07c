"""Training of CLIP, of the tactile encoder, of its baselines, of the language model and calibration.

Every stage can be stopped at any time and continues at its checkpoint. Not here: the data
(``cltp.data``), measuring (``cltp.evaluation``) and the order of stages (``tacgrasp.pretraining``,
``tacgrasp.training``).
"""
