"""The end of an episode in plain words: what became of the object, and how hard it was pressed.

In simulation the words are the truth's. On a real rig they are what touch knows, and say so.

Not here: the reason of the end (``tacgrasp.runtime.outcome``), printing (``tacgrasp.console``).
"""

from __future__ import annotations

from tacgrasp.config.schema import RunConfig, VerifyConfig
from tacgrasp.episodes.record import TruthFacts
from tacgrasp.runtime.outcome import Outcome


def end_text(outcome: Outcome, config: RunConfig) -> str:
    """Held, slipped or dropped; bruised or not; the largest force."""
    if config.dry_run:
        return "Dry run: nothing moved."
    truth, lift = outcome.truth, _lift_text(outcome, config.verify)
    if truth is None:
        return f"By touch: {_felt_state(outcome)}{lift}. {_felt_force_text(outcome)}."
    sentences = [
        f"{_true_state(truth, lifted=outcome.verified is not None)}: {lift}.",
        f"{_bruise_text(truth)}.",
        _true_force_text(truth, outcome.slip_minimum_n),
    ]
    return " ".join(filter(None, sentences))


def gain_text(outcome: Outcome) -> str:
    """The gripper's force gain, and how far the force that it is measured by is calibrated."""
    gain = outcome.gain
    if gain is None:
        return ""
    grips = "1 grip" if gain.num_grips == 1 else f"{gain.num_grips} grips"
    residual = outcome.force_mark or f"calibrated to {outcome.force_residual or 0.0:.0%}"
    return (
        f"gripper: presses {gain.value:.2f} times its command ({gain.low:.2f}-{gain.high:.2f}, "
        f"{grips}), felt force {residual}"
    )


def _lift_text(outcome: Outcome, verify: VerifyConfig) -> str:
    if outcome.verified is None:
        return "the lift was not completed" if outcome.declared else "not lifted"
    if not outcome.lifted:
        return f"lifted off by {verify.lift_off_mm:g} mm alone"
    shaken = ", shaken" if verify.shakes and verify.shake_mm else ""
    return f"lifted {verify.lift_mm:g} mm{shaken}, {verify.hold_s:g} s"


def _true_state(truth: TruthFacts, *, lifted: bool) -> str:
    if truth["dropped"]:
        return "Dropped"
    slid = f"by {truth['slip_mm']:.1f} mm" if truth["slipped"] else ""
    if not truth["held"]:
        return f"Slipped {slid}" if slid else "Nothing gripped"
    state = "Held" if lifted else "Gripped"
    return f"{state}, slid {slid}" if slid else state


def _bruise_text(truth: TruthFacts) -> str:
    if not truth["bruised_at_start"]:
        return "Bruised after the first touch" if truth["bruised"] else "Not bruised"
    return "Bruised at first touch" + (" and again later" if truth["bruised"] else "")


def _true_force_text(truth: TruthFacts, slip_minimum_n: float | None) -> str:
    peak_n = float(truth["peak_force_n"] or 0.0)
    if peak_n == 0:
        return ""
    needed = f", {peak_n / slip_minimum_n:.1f} × what was needed" if slip_minimum_n else ""
    return f"Peak {_newtons(peak_n)}{needed}."


def _felt_state(outcome: Outcome) -> str:
    if outcome.verified is None:
        return ""
    return "held, " if outcome.verified else "not held, "


def _felt_force_text(outcome: Outcome) -> str:
    unknown = "a bruise can't be felt"
    if outcome.peak_felt_n is None:
        return unknown.capitalize()
    mark = f" ({outcome.force_mark})" if outcome.force_mark else ""
    return f"Peak felt {_newtons(outcome.peak_felt_n)}{mark}; {unknown}"


def _newtons(force_n: float) -> str:
    return f"{force_n:.1f} N" if force_n >= 1 else f"{force_n:.2f} N"
