"""Forward and inverse kinematics of a UR5e.

Forward by Denavit-Hartenberg parameters, inverse by Newton steps from a nearby posture, to an error
below 1e-9: a pose is reported as commanded. Not here: dynamics, joint limits.

Source: DH parameters of the UR5e, universal-robots.com, 'DH parameters for calculations of
kinematics and dynamics'.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Floats = NDArray[np.float64]

D_M = (0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996)
A_M = (0.0, -0.425, -0.3922, 0.0, 0.0, 0.0)
ALPHA_RAD = (math.pi / 2, 0.0, 0.0, math.pi / 2, -math.pi / 2, 0.0)

CLOSE_ENOUGH = 1e-9
"""Error below which the Newton steps end [m and rad, the largest component]."""

MAX_STEPS = 60

LARGEST = 1e3
"""Largest number of a pose or of joint angles [m, rad]; beyond it sines lose their digits."""

READY_Q = np.array([2.6, -1.6, 2.0, -1.95, -math.pi / 2, 4.2])
"""Posture from which the first pose is solved [rad]: elbow up, tool pointing down."""


def matrix(rotvec_rad: Floats) -> Floats:
    """Rotation vector (3,) [rad] to rotation matrix (3, 3)."""
    return Rotation.from_rotvec(rotvec_rad).as_matrix()


def rotvec(rotation: Floats) -> Floats:
    """Rotation matrix (3, 3) to rotation vector (3,) [rad], of length 0 to pi."""
    return Rotation.from_matrix(rotation).as_rotvec()


def checked_pose(pose: Floats) -> Floats:
    """A copy of a UR pose (6,) [m, rad].

    Raises:
        ValueError: A number is not finite, or beyond any pose of an arm.
    """
    checked = np.array(pose, dtype=np.float64)
    if checked.shape != (6,) or not (np.abs(checked) <= LARGEST).all():  # False for NaN
        raise ValueError(f"a pose is six finite numbers within {LARGEST:g}, got {checked.tolist()}")
    return checked


def as_frame(pose: Floats) -> Floats:
    """UR pose (6,) [m, rad] to homogeneous matrix (4, 4)."""
    frame = np.eye(4)
    frame[:3, :3] = matrix(pose[3:])
    frame[:3, 3] = pose[:3]
    return frame


def _joint_frames(q: Floats) -> list[Floats]:
    """Frames of the base and of the end of each joint, seven matrices (4, 4)."""
    frames = [np.eye(4)]
    for d, a, alpha, angle in zip(D_M, A_M, ALPHA_RAD, q.tolist(), strict=True):
        c, s, ca, sa = math.cos(angle), math.sin(angle), math.cos(alpha), math.sin(alpha)
        link = np.array([
            [c, -s * ca, s * sa, a * c],
            [s, c * ca, -c * sa, a * s],
            [0.0, sa, ca, d],
            [0.0, 0.0, 0.0, 1.0],
        ])  # fmt: skip
        frames.append(frames[-1] @ link)
    return frames


def base_from_flange(q: Floats) -> Floats:
    """Frame of the tool flange (4, 4) for joint angles (6,) [rad]."""
    return _joint_frames(q)[-1]


def jacobian(q: Floats) -> Floats:
    """Jacobian (6, 6) from joint speeds [rad/s] to the flange's twist (v, w) in the base frame."""
    frames = _joint_frames(q)
    end = frames[-1][:3, 3]
    columns = [
        np.concatenate([np.cross(frame[:3, 2], end - frame[:3, 3]), frame[:3, 2]])
        for frame in frames[:-1]
    ]
    return np.array(columns).T


def joints_of(flange: Floats, near_q: Floats) -> Floats:
    """Joint angles (6,) [rad] that bring the flange to a frame (4, 4), from a nearby posture.

    Raises:
        ValueError: No posture was found: out of reach, or beyond a singularity.
    """
    q = np.array(near_q, dtype=np.float64)
    damping = 1e-10 * np.eye(6)
    for _ in range(MAX_STEPS):
        frames = _joint_frames(q)
        reached = frames[-1]
        error = np.concatenate([
            flange[:3, 3] - reached[:3, 3], rotvec(flange[:3, :3] @ reached[:3, :3].T)
        ])  # fmt: skip
        if float(np.abs(error).max()) < CLOSE_ENOUGH:
            return q
        j = jacobian(q)
        step = j.T @ np.linalg.solve(j @ j.T + damping, error)
        q = q + step * min(1.0, 0.5 / max(1e-12, float(np.abs(step).max())))
    raise ValueError(f"no posture brings the flange to {flange[:3, 3].round(4).tolist()} m")
