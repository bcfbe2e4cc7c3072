#!/usr/bin/env python3
"""Checks the house rules that a script can: who may include whom, what may be called, how files look.

house.py ROOT CHECK runs one check (a function below) and prints every line of the project that breaks it.
"""
import pathlib
import re
import subprocess
import sys

ROOMS = ("engine", "samples", "viewer", "shaders", "tests")
TOP_LEVEL = {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "screenshots", "build", *ROOMS}
FLOORS = {"base_level": 0, "low_level": 1, "util": 2, "high_level": 3}
MAX_LINES = 600

# Results must have the same bits with every C library and instruction set, so the engine and the samples have their
# own functions (pfx/base_level/math/trig.h) where the standard ones may round differently.
FORBIDDEN_CALLS = {
    r"(\bstd|(?<![\w>]))::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|"
    r"cbrt|hypot|fma)f?\s*\(": "a standard function whose rounding is not fixed: use pfx/base_level/math/trig.h",
    r"(?<![\w:.>])(sin|cos|tan|asin|acos|atan|atan2|exp|log|pow|cbrt|hypot|fma)f\s*\(": "a C function whose rounding is not fixed",
    r"\bAngleAxis|\.slerp\s*\(|\bangularDistance\s*\(": "an Eigen function that calls the C library's trigonometry",
    r"(?<![\w:.>])s?rand\s*\(|\bstd::s?rand\b|\brandom_device\b": "a random source that cannot be repeated",
    r"\bstd::\w+_distribution\b|\bstd::shuffle\b": "its result differs between standard libraries",
    r"\b_mm\d*_(rsqrt|rcp|rsqrt14|rcp14)\w*": "an approximation that differs between processors",
    r"\b_mm\d*_f(n?m)(add|sub)\w*": "a fused multiply-add: the other instruction sets round twice",
    r"ffast-math|Ofast|march=native|ffp-contract=(fast|on)|GCC optimize": "a compiler switch that changes results",
}
LEFTOVERS = r"\b(TODO|FIXME|XXX|HACK)\b|#if 0|\bDISABLED_|\bGTEST_SKIP\(\)(?! <<)"


def files(root, rooms, suffixes):
    for room in rooms:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in suffixes and path.is_file():
                yield path


def code_of(text):
    """The text with comments and string contents blanked out, line breaks kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)
    return re.sub(r'^(?!\s*#\s*include)(.*)$', lambda m: re.sub(r'"(\\.|[^"\\\n])*"', '""', m.group(0)), text, flags=re.M)


def numbered(path):
    return enumerate(path.read_text().splitlines(), 1)


def includes(path):
    for number, line in numbered(path):
        match = re.match(r'\s*#\s*include\s+([<"])([^>"]+)[>"]', line)
        if match:
            yield number, match.group(2)


def include_error(room, floor, target):
    """Why a file of this room and floor may not include the target, or None."""
    if target.startswith("compat/") or "physics_effects" in target:
        return None if room == "tests" or floor == "compat" else "the compatibility layer is included by nobody"
    if room in ("engine", "samples") and target.startswith("viewer/"):
        return "an upward include"
    if room in ("engine", "samples") and re.match(r"(GL|GLFW|glad|EGL)/|imgui|stb_", target):
        return "only the viewer touches GL, ImGui or a window"
    if room == "engine":
        if target.startswith(("samples/", "tests/")):
            return "an upward include"
        match = re.match(r"pfx/(\w+)/", target)
        if floor in FLOORS and match and FLOORS.get(match.group(1), 9) > FLOORS[floor]:
            return f"an upward include: {floor} uses {match.group(1)}"
        if floor == "base_level" and target in ("thread", "mutex", "atomic", "future", "condition_variable"):
            return "base_level knows no threads"
    if room != "tests" and target.startswith("tests/"):
        return "tests are included by tests alone"
    if target.startswith(".."):
        return "includes are written from the engine's or the project's root"
    return None


def includes_never_point_upwards(root):
    for path in files(root, ("engine", "samples", "viewer", "tests"), {".h", ".cpp"}):
        parts = path.relative_to(root).parts
        floor = ""
        if parts[0] == "engine":
            floor = parts[2] if parts[1] == "pfx" else parts[1]
        for number, target in includes(path):
            why = include_error(parts[0], floor, target)
            if why:
                yield path, number, f"{target}: {why}"


def calls_give_the_same_bits_everywhere(root):
    for path in files(root, ("engine", "samples"), {".h", ".cpp", ".txt", ".cmake"}):
        code = path.read_text()
        if path.suffix in (".h", ".cpp"):
            code = code_of(code)
        for number, line in enumerate(code.splitlines(), 1):
            for pattern, why in FORBIDDEN_CALLS.items():
                match = re.search(pattern, line)
                if match:
                    yield path, number, f"{match.group(0)} is {why}"


def files_are_short(root):
    for path in files(root, ROOMS, {".h", ".cpp", ".glsl", ".vert", ".frag", ".py", ".sh", ".cmake"}):
        count = len(path.read_text().splitlines())
        if count > MAX_LINES:
            yield path, count, f"{count} lines, at most {MAX_LINES}: is this still one idea?"


def files_open_with_what_they_are(root):
    for path in files(root, ROOMS, {".h", ".cpp"}):
        if path.suffix == ".cpp" and path.with_suffix(".h").exists():
            continue
        if not path.read_text().startswith(("//", "/*")):
            yield path, 1, "does not open with a comment that says what the file is"


def nothing_is_left_unfinished(root):
    for path in files(root, ROOMS, {".h", ".cpp", ".glsl", ".vert", ".frag", ".py", ".sh", ".cmake", ".txt"}):
        if path.name == "house.py":
            continue
        for number, line in numbered(path):
            match = re.search(LEFTOVERS, line)
            if match:
                yield path, number, f"{match.group(0)} is left"


def scripts_can_be_parsed(root):
    for path in [*files(root, ROOMS, {".sh", ".py"}), root / ".ci" / "run"]:
        if path.suffix == ".py":
            try:
                compile(path.read_text(), str(path), "exec")
            except SyntaxError as error:
                yield path, error.lineno, error.msg
        else:
            result = subprocess.run(["bash", "-n", str(path)], capture_output=True, text=True)
            if result.returncode:
                yield path, 1, result.stderr.strip()


def top_level_holds_the_rooms_alone(root):
    for path in sorted(root.iterdir()):
        if path.name not in TOP_LEVEL and not path.name.startswith("."):
            yield path, 1, "is not one of the rooms"


CHECKS = [includes_never_point_upwards, calls_give_the_same_bits_everywhere, files_are_short,
          files_open_with_what_they_are, nothing_is_left_unfinished, scripts_can_be_parsed,
          top_level_holds_the_rooms_alone]


def main():
    checks = {check.__name__: check for check in CHECKS}
    if len(sys.argv) != 3 or sys.argv[2] not in checks:
        sys.exit(f"usage: house.py ROOT {'|'.join(checks)}")
    root = pathlib.Path(sys.argv[1]).resolve()
    broken = list(checks[sys.argv[2]](root))
    for path, number, why in broken:
        print(f"{path.relative_to(root)}:{number}: {why}")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
