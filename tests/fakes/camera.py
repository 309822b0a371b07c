"""A camera behind a gel, of whatever picture a test puts before it."""

import time

import numpy as np

from cltp.errors import TouchError

GREY = np.full((240, 320, 3), 120, dtype=np.uint8)
NOISE = np.random.default_rng(0).integers(-1, 2, (4, 240, 320, 3))


class Camera:
    """Frames 60 times a second, noisy, of what a test puts before it; can fail in many ways."""

    def __init__(self, picture=GREY):
        self.picture, self.failure, self.frozen, self.stalled = picture, "", False, False
        self.frames, self.opened, self.closed = 0, 0, False

    def __call__(self, settings, sensor):
        self.opened += 1
        return self

    def next_frame(self):
        time.sleep(1 / 60)
        while self.stalled and not self.failure:
            time.sleep(0.01)
        if self.failure:
            raise TouchError(self.failure)
        self.frames += not self.frozen
        return (self.picture + NOISE[self.frames % 4]).clip(0, 255).astype(np.uint8)

    def show(self, picture):
        """Put a picture before it and wait until a frame of it has been taken."""
        self.picture, wanted, until_s = picture, self.frames + 3, time.monotonic() + 10
        while self.frames < wanted:  # one was under way, and the last may not be handed over yet
            assert time.monotonic() < until_s, "the camera gives no frames"
            time.sleep(0.005)

    def close(self):
        self.closed = True
