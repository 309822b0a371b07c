"""Pre-training methods side by side: train each on one data set, evaluate and report them.

Reproduces the paper's tables 1, 2 and A. Not here: the methods themselves (``cltp.train``), their
scores (``cltp.evaluation``), and the weights of the controller (``tacgrasp.training``).

May import: cltp, tacgrasp, tacgrasp.base, tacgrasp.datasets, tacgrasp.lessons,
tacgrasp.pretraining.report.
"""
