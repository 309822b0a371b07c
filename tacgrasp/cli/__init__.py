"""The commands: one module each with ``main(argv) -> exit code``, imported only when asked for."""
