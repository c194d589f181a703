#!/usr/bin/env python3
"""Asks bash's completion of graze what a user would be offered, and compares it with the program's help.

usage: completion_test.py PROGRAM COMPLETION
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, COMPLETION = (str(pathlib.Path(each).resolve()) for each in sys.argv[1:3])
ASK = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _graze; printf "%s\\n" "${COMPREPLY[@]}"'


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], check=True, capture_output=True, text=True).stdout


class CompletionTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in ("scene.json", "a mesh.obj", "run.graze", "part.stl", "picture.png", "notes.txt"):
            pathlib.Path(self.folder.name, name).touch()
        pathlib.Path(self.folder.name, "meshes").mkdir()

    def offered(self, *words):
        """What is offered after these words, of which the last is being typed."""
        done = subprocess.run(["bash", "--norc", "-c", ASK, "bash", COMPLETION, "graze", *words], check=True,
                              capture_output=True, text=True, cwd=self.folder.name)
        self.assertEqual(done.stderr, "")
        return {line for line in done.stdout.splitlines() if line}

    def test_commands(self):
        commands = set(re.findall(r"^  ([a-z]+) ", help_of().partition("Subcommands:")[2], flags=re.MULTILINE))
        self.assertGreater(len(commands), 5)
        self.assertEqual(self.offered(""), commands | {"-h", "--help", "--version"})
        self.assertEqual(self.offered("re"), {"replay"})

    def test_options_of_every_command(self):
        for command in self.offered("") - {"-h", "--help", "--version"}:
            words = re.findall(r"^  (-\S+)", help_of(command), flags=re.MULTILINE)
            options = {name.rstrip(",") for word in words for name in word.split(",")}
            self.assertEqual(self.offered(command, "-"), options, command)
            self.assertEqual(self.offered(command, "file", "--h"), {name for name in options if name.startswith("--h")})

    def test_files_by_their_endings(self):
        self.assertEqual(self.offered("run", ""), {"scene.json", "a mesh.obj", "part.stl", "meshes"})
        self.assertEqual(self.offered("inspect", "a"), {"a mesh.obj"})
        self.assertEqual(self.offered("replay", ""), {"run.graze", "meshes"})
        self.assertEqual(self.offered("run", "scene.json", "--picture", "p"), {"picture.png"})
        self.assertEqual(self.offered("picture", "run.graze", "-o", ""), {"picture.png", "meshes"})

    def test_words_that_an_option_takes(self):
        details = re.search(r"--detail TEXT\s+(.*)", help_of("run"))[1]
        self.assertEqual(self.offered("run", "--detail", ""), set(re.split(r", | or ", details)))
        self.assertEqual(self.offered("replay", "run.graze", "--instruction-set", "avx5"), {"avx512"})
        self.assertEqual(self.offered("run", "--frames", ""), set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
