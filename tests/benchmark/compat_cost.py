#!/usr/bin/env python3
"""Instructions that the overview's API costs over the engine's own functions: compat_cost.py PROGRAM [LIMIT_PERCENT].

Runs PROGRAM (compat_cost) under callgrind both ways, with two numbers of steps each, so that what comes before and after
the steps drops out. Exit 1 when the API takes more than LIMIT_PERCENT (1) more, 77 when valgrind is missing.
"""
import re
import shutil
import subprocess
import sys
import tempfile


def instructions(program, way, steps):
    with tempfile.NamedTemporaryFile() as out:
        result = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out.name}", program, way, str(steps)],
                                capture_output=True, text=True, check=True)
    return int(re.search(r"Collected : (\d+)", result.stderr).group(1)), result.stdout.strip()


def main():
    if shutil.which("valgrind") is None:
        print("valgrind is missing")
        sys.exit(77)
    program, limit = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1.0
    per_step, ends = {}, {}
    for way in ("compat", "native"):
        few, _ = instructions(program, way, 10)
        many, ends[way] = instructions(program, way, 30)
        per_step[way] = (many - few) / 20
    extra = 100 * (per_step["compat"] / per_step["native"] - 1)
    print(f"instructions a step: native {per_step['native']:.0f}, through physics_effects.h {per_step['compat']:.0f} ({extra:+.2f} %)")
    if ends["compat"] != ends["native"]:
        sys.exit(f"the two ways do not end alike: {ends}")
    sys.exit(0 if extra <= limit else 1)


if __name__ == "__main__":
    main()
