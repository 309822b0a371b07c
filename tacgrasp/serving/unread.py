"""Why a cloud in a question is not decided on, whatever the policy.

A run's own sensing (``tacgrasp.rig.gel_sense``) refuses a pad that is raised all over or measured
in part, and compares with the untouched gel; a client of another make may send what it likes.
"""

from __future__ import annotations

from cltp.tactile.cloud import check_relief
from cltp.tactile.contact.partial_pad import is_partial, partial_text
from cltp.tactile.contact.raised_pad import is_raised, raised_text
from cltp.tactile.contact.single_cloud import is_lowered, is_touched, lowered_text
from policies import Observation


def unread_reason(observation: Observation) -> str:
    """Why nothing is to be done about what is felt now; '' where a policy may decide.

    A client that has tested for contact has an untouched gel to compare with, so that the zero of
    its cloud may be anywhere below.

    Raises:
        TouchError: z has the wrong sign, or seems to be in metres.
    """
    cloud = observation.cloud
    if is_partial(cloud):
        return f"What is felt can't be read: {partial_text(cloud)}"
    if is_raised(cloud):
        return f"What is felt can't be read: {raised_text(cloud)}"
    if observation.in_contact is not False:
        check_relief(cloud.points_mm[:, 2])
        is_touched(cloud)  # for its refusal
    if observation.in_contact is None and is_lowered(cloud):
        return f"What is felt can't be read: {lowered_text(cloud)}"
    return ""
