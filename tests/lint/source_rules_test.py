#!/usr/bin/env python3
"""Tests source_rules.py on small trees that break its rules, and on some that keep them."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # no folder of compiled scripts in the sources

import source_rules


class SourceRulesTest(unittest.TestCase):
    def problems(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return source_rules.check(root)

    def test_a_word_of_the_code_in_a_message(self):
        found = self.problems({"io/src/a.cpp": '#include "text/json_path.hpp"\n\nfail(joined(": its joints "\n'
                                               '  "json_path it, so"));\n'})
        self.assertEqual(found, ["io/src/a.cpp:3: a message holds the name json_path of the code"])

    def test_a_word_of_the_code_in_a_raw_message(self):
        self.assertEqual(len(self.problems({"scheduler/src/a.cpp": 'f(R"(write "new_thing": 1 here)");'})), 1)

    def test_words_that_users_know(self):
        self.assertEqual(self.problems({
            "io/include/graze/io/a.hpp": "int max_contacts = 0;",
            "io/src/a.cpp": 'f("max_contacts is 0"); f("end_header"); f("the header has no end_header");\n'
                            '// a comment says "its json_path is wrong"\n'
                            'f("<a byte_order=1>"); f("%zu_x and --no_option are no names"); f("json_path");',
        }), [])

    def test_files_that_are_opened_unseen(self):
        found = self.problems({"io/src/a.cpp": "void f() {\n  std::ifstream stream(path);\n}\n",
                               "io/src/b.cpp": "OpenedFiles::add(path);\nstd::ifstream stream(path);\n",
                               "io/src/c.cpp": "std::ifstream stream = open_input(path);  // std::ifstream(path)\n"})
        self.assertEqual([problem.split(": ")[0] for problem in found], ["io/src/a.cpp:2"])

    def test_commands_that_print_by_themselves(self):
        found = self.problems({"tools/graze/recording/a.cpp": 'std::printf("%s", name);\n',
                               "tools/studies/bench/b.cpp": 'std::printf("%s", name);\n',
                               "tools/graze/c.cpp": 'say("%s", name);\n'})
        self.assertEqual([problem.split(": ")[0] for problem in found], ["tools/graze/recording/a.cpp:1"])

    def test_arguments_that_draw_random_numbers(self):
        found = self.problems({"tests/a.cpp": "Vector3d v(way(random), way(random), 0);\n"
                                              "Vector3d w{way(random), way(random), 0};\n"
                                              "f(random, g(random));\n",
                               "tools/b.cpp": "\nf(2 * random.between(0, 1), 5, random.below(3));\n"
                                              "// f(random.below(1), random.below(2))\n"
                                              "f(random.below(1)); g(random.below(2), 3);\n"})
        self.assertEqual([problem.split(": ")[0] for problem in found], ["tests/a.cpp:1", "tools/b.cpp:2"])

    def test_what_not_every_compiler_has(self):
        found = self.problems({"core/src/a.cpp": "#pragma once\n// __builtin_sqrt(x)\nreturn __builtin_sqrt(x);\n[[gnu::pure]] f();\n",
                               "core/src/b.inc": "using Two [[nodiscard]] = int;\n#pragma GCC unroll 8\nContacts& __restrict out = x;\n",
                               "scheduler/src/c.hpp": "#  include <immintrin.h>\n_mm256_add_ps(a, b);\n",
                               "core/src/kernels/vectors.hpp": "__builtin_shufflevector(a, b, 0, 1);\n",
                               "io/src/d.cpp": "__builtin_expect(x, 1);\n"})
        self.assertEqual([problem.split(": ")[0] for problem in found],
                         ["core/src/a.cpp:3", "core/src/a.cpp:4", "core/src/b.inc:2", "core/src/b.inc:3",
                          "scheduler/src/c.hpp:1", "scheduler/src/c.hpp:2"])

    def test_folders_of_many_files(self):
        counts = {"tools/a": 30, "tools/a/b": 31, "core/src/c": 31, "tests/d": 31, "docs/e": 31}
        found = self.problems({f"{folder}/{index}.hpp": "" for folder, count in counts.items() for index in range(count)})
        self.assertEqual([problem.split(": ")[0] for problem in found], ["core/src/c", "tests/d", "tools/a/b"])


if __name__ == "__main__":
    unittest.main()
