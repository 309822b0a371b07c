"""``make fuzz CASES=N PARSER=p SEED=s``: every parser of foreign bytes, against mutated ones.

Each parser runs in a process of its own, so that its memory is its own, and a line of JSON tells
its figures. Failing inputs and what they raised lie in the output folder; a second call with more
cases goes on.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

from tests.fuzz.runner import fuzz
from tests.fuzz.targets import all_targets


def main(argv: list[str]) -> int:
    """Run the parsers that were asked for; 1 when a case was not taken as documented."""
    targets = {target.name: target for target in all_targets()}
    flags = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    flags.add_argument("--parser", choices=["all", *targets], default="all")
    flags.add_argument("--cases", type=int, default=1000, help="cases of each parser")
    flags.add_argument("--seed", type=int, default=0, help="random seed of the mutations")
    flags.add_argument("--out", type=Path, default=Path("runs/fuzz"), help="folder of findings")
    given = flags.parse_args(argv)
    if given.parser == "all":
        common = ["--cases", str(given.cases), "--seed", str(given.seed), "--out", str(given.out)]
        calls = [[sys.executable, "-m", "tests.fuzz", "--parser", p, *common] for p in targets]
        return max(subprocess.run(call, check=False).returncode for call in calls)
    result = fuzz(targets[given.parser], given.cases, given.seed, given.out)
    sys.stdout.write(json.dumps(asdict(result)) + "\n")
    return 1 if result.undocumented else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
