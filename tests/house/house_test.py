#!/usr/bin/env python3
"""Each check of house.py finds a planted fault, and is silent about the faultless twin beside it."""
import pathlib
import tempfile
import unittest

import house

HEAD = "// What this is.\n"


class HouseTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)
        self.write(".ci/run", "#!/usr/bin/env bash\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def faults(self, check):
        return [f"{path.relative_to(self.root)}:{number}" for path, number, _ in check(self.root)]

    def test_upward_includes(self):
        self.write("engine/pfx/base_level/a.h", HEAD + '#include "pfx/low_level/b.h"\n#include "pfx/base_level/c.h"\n')
        self.write("engine/pfx/util/d.h", HEAD + '#include "pfx/low_level/b.h"\n#include "pfx/high_level/e.h"\n')
        self.write("samples/f.cpp", HEAD + '#include "pfx/high_level/e.h"\n#include "viewer/g.h"\n')
        self.write("viewer/g.h", HEAD + '#include "samples/f.h"\n#include "compat/physics_effects.h"\n')
        self.write("engine/compat/h.h", HEAD + '#include "compat/physics_effects.h"\n')
        self.assertEqual(self.faults(house.includes_never_point_upwards),
                         ["engine/pfx/base_level/a.h:2", "engine/pfx/util/d.h:3", "samples/f.cpp:3", "viewer/g.h:3"])

    def test_forbidden_calls(self):
        lines = ["float a = std::sin(x);", "float b = pfx::sin(x) + sin(x);", "float c = sqrtf(x) + sinf(x);",
                 "// std::sin(x) in a comment", 'log("std::cos(x)");', "auto r = _mm_rsqrt_ps(v);", "int i = rand();",
                 "float s = std::sqrt(x) + std::abs(x);", "float t = ::cos(x);", "Eigen::AngleAxisf q(a, v);",
                 "float d = brand();", "__m128 f = _mm_fmadd_ps(a, b, c);"]
        self.write("engine/pfx/util/a.cpp", "\n".join(lines) + "\n")
        self.assertEqual(self.faults(house.calls_give_the_same_bits_everywhere),
                         [f"engine/pfx/util/a.cpp:{n}" for n in (1, 3, 6, 7, 9, 10, 12)])

    def test_long_files(self):
        self.write("viewer/long.cpp", HEAD * (house.MAX_LINES + 1))
        self.write("viewer/short.cpp", HEAD * house.MAX_LINES)
        self.assertEqual(self.faults(house.files_are_short), [f"viewer/long.cpp:{house.MAX_LINES + 1}"])

    def test_head_comments(self):
        self.write("viewer/with.h", HEAD)
        self.write("viewer/with.cpp", "int a;\n")
        self.write("viewer/without.h", "#pragma once\n")
        self.assertEqual(self.faults(house.files_open_with_what_they_are), ["viewer/without.h:1"])

    def test_leftovers(self):
        self.write("samples/a.cpp", HEAD + "// TO" + "DO: finish\nint todo_list;\n")
        self.assertEqual(self.faults(house.nothing_is_left_unfinished), ["samples/a.cpp:2"])

    def test_broken_scripts(self):
        self.write("tests/good.sh", "if true; then echo; fi\n")
        self.write("tests/bad.sh", "if true; then echo\n")
        self.write("tests/bad.py", "def f(:\n")
        self.assertEqual(self.faults(house.scripts_can_be_parsed), ["tests/bad.py:1", "tests/bad.sh:1"])

    def test_strangers_at_the_top(self):
        self.write("engine/a.h", HEAD)
        self.write("notes.txt", "")
        self.assertEqual(self.faults(house.top_level_holds_the_rooms_alone), ["notes.txt:1"])


if __name__ == "__main__":
    unittest.main()
