#!/usr/bin/env python3
"""What a step costs in instructions, counted: what is not there must cost nothing.

cost_test.py STEP_COST runs that program under callgrind. Counts repeat to a few parts in a million on any machine, so
that these are tests where times would be guesses:
  fixed and sleeping bodies cost nothing a step, however many there are;
  every other body costs the same as the one before it;
  the code of features that a world does not use takes at most half a percent of its instructions.
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else ""

# Functions of a feature, by name, and the kinds of world that do not use it.
FEATURES = {
    "joints": (r"[Jj]oint(?!Constraint>)|[Dd]irect(Component|Factor|Rows|Body|Structure)", ("free", "spinning", "resting")),
    "contacts": (r"[Cc]ontact|[Mm]anifold|collide|[Ss]oftStep", ("free", "spinning", "hanging")),
    "meshes": (r"LargeMesh|[Mm]eshContact|[Ff]acet", ("free", "spinning", "resting", "hanging")),
    "particles": (r"[Pp]article|[Ss]trand", ("free", "spinning", "resting", "hanging")),
    "rays": (r"castRay|RayInput", ("free", "spinning", "resting", "hanging")),
}


def count(kind, bodies, steps):
    """Instructions by function, of a whole run."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", PROGRAM, kind, str(bodies), str(steps)],
                       check=True, capture_output=True)
        names, costs, current, skip = {}, {}, None, False
        with open(out, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                match = re.match(r"fn=\((\d+)\)(?: (.*))?", line)
                if match:
                    number, name = match.groups()
                    if name:
                        names[number] = name
                    current = names[number]
                elif line.startswith("cfn="):
                    match = re.match(r"cfn=\((\d+)\)(?: (.*))?", line)
                    if match.group(2):
                        names[match.group(1)] = match.group(2)
                elif line.startswith("calls="):
                    skip = True  # the next line is what the called function took
                elif line[:1].isdigit() or line[:1] in "+-*":
                    if not skip:
                        costs[current] = costs.get(current, 0) + int(line.split()[1])
                    skip = False
    return costs


def per_step(kind, bodies, steps=(8, 40)):
    """Instructions by function, of one step."""
    few, many = (count(kind, bodies, n) for n in steps)
    return {name: (cost - few.get(name, 0)) / (steps[1] - steps[0]) for name, cost in many.items()}


def own_name(function):
    """The name of a function without its parameters, whose types may name any feature."""
    return function.replace("(anonymous namespace)", "").partition("(")[0]


class Cost(unittest.TestCase):
    def test_fixed_bodies_cost_nothing(self):
        few, many = (sum(per_step("fixed", n).values()) for n in (16, 128))
        print(f"fixed: {few:.0f} instructions a step with 16 bodies, {many:.0f} with 128")
        self.assertLessEqual(many - few, 1.0 * 112)  # a word a body would be one instruction

    def test_sleeping_bodies_cost_nothing(self):
        few, many = (sum(per_step("asleep", n).values()) for n in (16, 128))
        print(f"asleep: {few:.0f} instructions a step with 16 bodies, {many:.0f} with 128")
        self.assertLessEqual(many - few, 1.0 * 112)

    def test_each_body_costs_what_the_one_before_did(self):
        for kind in ("free", "spinning", "resting", "hanging"):
            with self.subTest(kind):
                one, two, four = (sum(per_step(kind, n).values()) for n in (64, 128, 256))
                first, second = (two - one) / 64, (four - two) / 128
                print(f"{kind}: {first:.0f} and {second:.0f} instructions a body and step")
                self.assertLess(abs(second / first - 1.0), 0.1)

    def test_absent_features_cost_nothing(self):
        for kind in ("free", "spinning", "resting", "hanging"):
            costs = per_step(kind, 64)
            total = sum(costs.values())
            for feature, (pattern, absent_in) in FEATURES.items():
                if kind not in absent_in:
                    continue
                with self.subTest(kind=kind, feature=feature):
                    used = {name: cost for name, cost in costs.items() if re.search(pattern, own_name(name)) and cost > 0}
                    share = sum(used.values()) / total
                    print(f"{kind}: {feature} take {100 * share:.2f} % of {total:.0f} instructions")
                    self.assertLessEqual(share, 0.005, sorted(used, key=used.get)[-5:])


if __name__ == "__main__":
    unittest.main()
