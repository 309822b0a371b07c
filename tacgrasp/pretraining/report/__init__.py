"""Results of pre-training: stored on disk, printed, and compared with the paper in a report.

Not here: measuring (``tacgrasp.pretraining.evaluate``).

May import: cltp, tacgrasp, tacgrasp.base.
"""
