"""Errors of episodes: a recording can't be written, or a file can't be read as one."""


class EpisodeError(Exception):
    """An episode could not be written or read.

    While recording it ends the run: the loop makes the robot safe, since nothing that it does from
    then on could be reconstructed. The message names the file, what went wrong and what to do.
    """
