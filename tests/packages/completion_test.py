#!/usr/bin/env python3
"""Asks a shell's completion of graze what a user would be offered, and compares it with the program's help.

usage: completion_test.py PROGRAM FOLDER SHELL

SHELL is bash, zsh or fish. FOLDER has graze.SHELL. The exit code is 77 where the shell is missing.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SHELL = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[3]
COMPLETION = str(pathlib.Path(sys.argv[2], f"graze.{SHELL}").resolve())
BASH = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _graze; printf "%s\\n" "${COMPREPLY[@]}"'
ZSH = str(pathlib.Path(__file__).resolve().with_name("offered.zsh"))
DUMP = tempfile.NamedTemporaryFile()  # what zsh knows of all completions, since to find it takes seconds
FISH = "source $argv[1]; complete -C $argv[2] | string replace -r '\\t.*' ''; true"


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], check=True, capture_output=True, text=True).stdout


def question(words):
    """The command that asks the shell. All but bash take a line."""
    line = " ".join(["graze", *words])
    return {"bash": ["bash", "--norc", "-c", BASH, "bash", COMPLETION, "graze", *words],
            "zsh": ["zsh", "-f", ZSH, COMPLETION, line, DUMP.name],
            "fish": ["fish", "--no-config", "-c", FISH, COMPLETION, line]}[SHELL]


class CompletionTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in ("scene.json", "a mesh.obj", "run.graze", "part.stl", "picture.png", "notes.txt"):
            pathlib.Path(self.folder.name, name).touch()
        pathlib.Path(self.folder.name, "meshes").mkdir()

    def offered(self, *words):
        """What is offered after these words, of which the last is being typed."""
        done = subprocess.run(question(words), check=True, capture_output=True, text=True, cwd=self.folder.name, timeout=60)
        self.assertEqual(done.stderr, "")
        return {line.rstrip("/").replace("\\ ", " ") for line in done.stdout.splitlines() if line}

    def test_syntax(self):
        subprocess.run([SHELL, "-n", COMPLETION], check=True)

    def test_commands(self):
        commands = set(re.findall(r"^  ([a-z]+) ", help_of().partition("Subcommands:")[2], flags=re.MULTILINE))
        options = {"-h", "--help", "--version"}
        self.assertGreater(len(commands), 5)
        # The others offer options after a minus sign alone.
        self.assertEqual(self.offered(""), commands | (options if SHELL == "bash" else set()))
        self.assertEqual(self.offered("-"), options)
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
    if not shutil.which(SHELL):
        print(f"skipped: {SHELL} is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
