"""Where a UR5e's tool is, and which joints bring it there.

Forward kinematics by Denavit-Hartenberg parameters, inverse kinematics by Newton steps from a
nearby posture: good enough that a pose comes back as commanded. Not here: dynamics, joint limits.

Source: DH parameters of the UR5e, universal-robots.com, 'DH parameters for calculations of
kinematics and dynamics'.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

D_M = (0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996)
A_M = (0.0, -0.425, -0.3922, 0.0, 0.0, 0.0)
ALPHA_RAD = (math.pi / 2, 0.0, 0.0, math.pi / 2, -math.pi / 2, 0.0)

CLOSE_ENOUGH = 1e-9
"""Newton stops below this error (metres and radians, together)."""

READY_Q = np.array([2.6, -1.6, 2.0, -1.95, -math.pi / 2, 4.2])
"""Elbow up, tool pointing down: the posture from which the first pose is sought [rad]."""


def matrix(rotvec_rad: Floats) -> Floats:
    """Rotation vector (3,) [rad] to rotation matrix (3, 3) (Rodrigues)."""
    angle = math.sqrt(float(rotvec_rad @ rotvec_rad))
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = (float(v) for v in rotvec_rad / angle)
    c, s = math.cos(angle), math.sin(angle)
    t = 1.0 - c
    return np.array([
        [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
        [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
        [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
    ])  # fmt: skip


def rotvec(turn: Floats) -> Floats:
    """Rotation matrix (3, 3) to rotation vector (3,) [rad], of length 0 to pi."""
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    sine = 0.5 * math.sqrt(float(skew @ skew))
    cosine = 0.5 * (float(np.trace(turn)) - 1.0)
    angle = math.atan2(sine, cosine)
    if sine > 1e-6:
        return skew * (0.5 * angle / sine)
    if cosine > 0:
        return 0.5 * skew
    # Half a turn: the axis is what the rotation leaves alone, its sign that of the small skew part.
    outer = 0.5 * (turn + np.eye(3))
    axis = outer[int(np.argmax(np.diag(outer)))]
    axis = axis / math.sqrt(float(axis @ axis))
    return angle * axis * (-1.0 if float(axis @ skew) < 0 else 1.0)


def as_frame(pose: Floats) -> Floats:
    """UR pose (6,) [m, rad] to homogeneous matrix (4, 4)."""
    frame = np.eye(4)
    frame[:3, :3] = matrix(pose[3:])
    frame[:3, 3] = pose[:3]
    return frame


def as_pose(frame: Floats) -> Floats:
    """Homogeneous matrix (4, 4) to UR pose (6,) [m, rad]."""
    return np.concatenate([frame[:3, 3], rotvec(frame[:3, :3])])


def inverse(frame: Floats) -> Floats:
    """The inverse of a homogeneous matrix (4, 4)."""
    turn = frame[:3, :3].T
    back = np.eye(4)
    back[:3, :3] = turn
    back[:3, 3] = -turn @ frame[:3, 3]
    return back


def _joint_frames(q: Floats) -> list[Floats]:
    """Frames of the base and of each joint's end, seven matrices (4, 4)."""
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
    """From joint speeds [rad/s] to the flange's twist (v, w) in the base frame, (6, 6)."""
    frames = _joint_frames(q)
    end = frames[-1][:3, 3]
    columns = [
        np.concatenate([np.cross(frame[:3, 2], end - frame[:3, 3]), frame[:3, 2]])
        for frame in frames[:-1]
    ]
    return np.array(columns).T


def joints_of(flange: Floats, near_q: Floats, num_steps: int = 60) -> Floats:
    """Joint angles (6,) [rad] that bring the flange to a frame (4, 4), found from a nearby posture.

    Raises:
        ValueError: No posture was found: out of reach, or through a singularity.
    """
    q = np.array(near_q, dtype=np.float64)
    damping = 1e-10 * np.eye(6)
    for _ in range(num_steps):
        frames = _joint_frames(q)
        now = frames[-1]
        error = np.concatenate([
            flange[:3, 3] - now[:3, 3], rotvec(flange[:3, :3] @ now[:3, :3].T)
        ])  # fmt: skip
        if float(np.abs(error).max()) < CLOSE_ENOUGH:
            return q
        turn = jacobian(q)
        step = turn.T @ np.linalg.solve(turn @ turn.T + damping, error)
        q = q + step * min(1.0, 0.5 / max(1e-12, float(np.abs(step).max())))
    raise ValueError(f"no posture brings the flange to {flange[:3, 3].round(4).tolist()} m")
