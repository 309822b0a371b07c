"""The error of episode files."""


class EpisodeError(Exception):
    """An episode could not be written or read.

    While recording it ends the run: the loop makes the robot safe, since no later action could be
    reconstructed. The message names the file, the cause and a remedy.
    """
