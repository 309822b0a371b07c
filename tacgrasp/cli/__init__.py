"""The commands: one module each with ``main(argv) -> exit code``, imported only when it is needed.

Not here: the work of a command (the folder that its module imports), the dispatch and the exit
codes of errors (``tacgrasp.__main__``).
"""
