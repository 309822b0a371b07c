"""Train a tactile encoder on contacts of one's own: generate them, train, read the encoder back.

    python examples/11_train_an_encoder.py [contacts] [steps]

The defaults only show the way: 120000 contacts and 8000 steps make weights that are worth something
(make weights). Each command can be interrupted and goes on when it is given again.
"""

import sys
from pathlib import Path

from cltp.checkpoints.tac3d_llm import load_encoder
from tacgrasp.__main__ import main


def tacgrasp(*argv):
    """One command, as on the command line; an error ends the program."""
    print("$ tacgrasp", *argv, flush=True)
    if code := main([str(part) for part in argv]):
        sys.exit(code)


contacts = int(sys.argv[1]) if len(sys.argv) > 1 else 64
steps = int(sys.argv[2]) if len(sys.argv) > 2 else 4
few = ["--steps", steps, "--batch-size", 8, "--threads", 1]
data, out = Path("contacts"), Path("trained")

tacgrasp("data", "generate", "--set", "full", "--contacts", contacts, "--out", data, "--workers", 1)
tacgrasp("data", "stats", data)
tacgrasp("train", "clip", "--data", data, "--out", out, *few)
tacgrasp("train", "cltp", "--data", data, "--out", out, *few, "--preset", "tiny")

encoder, heads = load_encoder(out / "cltp" / "encoder")
num = sum(parameter.numel() for parameter in [*encoder.parameters(), *heads.parameters()])
print(f"{out / 'cltp' / 'encoder'}: {num / 1e3:.0f} thousand parameters, {encoder.config}")
