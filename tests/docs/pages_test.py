#!/usr/bin/env python3
"""Whether what pages say is there: links, anchors, pictures, paths, names, options, and C++ that compiles.

    pages_test.py --source ROOT [--compiler CXX] [--include FOLDER]... [PAGE...]
    pages_test.py --source ROOT --self-test [--compiler CXX] [--include FOLDER]...
    pages_test.py --source ROOT --programs FOLDER
    pages_test.py --run PROGRAM OUTPUT

Without pages: README.md and all pages under docs. Without --compiler code is not compiled. The self test reads
wrong_page.md, in which each mistake is marked, and fails unless exactly these are found. With --programs each block
of C++ that has a `main` is written into the folder as a file, and what the page says that it prints as another; their
names are printed. With --run a program is run and must print what such a file says. Exits 1 for a mistake.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import urllib.parse

sys.dont_write_bytecode = True  # no folder of compiled scripts in the sources

import code_blocks
import names as known
from page import Page

HERE = pathlib.Path(__file__).resolve().parent
FOLDERS = ("core/", "scheduler/", "io/", "tools/", "tests/", "docs/")
MADE = ("build/", "out/")  # what commands make is not in a checkout
ENDINGS = (".hpp", ".cpp", ".inc", ".md", ".sh", ".py", ".txt", ".cmake", ".png", ".svg", ".json", ".in")
UNIQUE_ENDINGS = (".hpp", ".cpp", ".inc", ".md", ".sh", ".py", ".cmake")  # of names without a folder
USER_PAGES = {"README.md", "quickstart.md", "embedding.md", "answers.md", "choosing.md", "troubleshooting.md"}
HISTORY_PAGES = {"tried.md", "changelog.md", "bounding_volumes.md"}  # they speak of names that are gone
OTHER_PROGRAMS = {"cmake", "ctest", "ninja", "git", "apt-get", "pkg-config", "python3", "clang-format", "clang-tidy",
                  "valgrind", "g++", "clang++", "doxygen", "assimp"}
NAME = r"[A-Za-z_]\w*"
PATH = r"[\w.-]+(?:/[\w.-]+)+"


class Checker:
    def __init__(self, root):
        self.root = root
        self.names = known.Names(root)
        self.pages = {}
        self.mistakes = []  # (page, line, kind, message)

    def page(self, path):
        path = path.resolve()
        if path not in self.pages:
            inside = path.is_relative_to(self.root)
            self.pages[path] = Page(path, path.relative_to(self.root).as_posix() if inside else path.name)
        return self.pages[path]

    def add(self, page, line, kind, message):
        self.mistakes.append((page.name, line, kind, message))

    def check(self, page):
        for line, target, is_picture in page.links:
            self.check_link(page, line, target, is_picture)
        for line, span in page.spans:
            self.check_span(page, line, span)
        self.check_names_in_paths(page)
        for first, language, text in page.blocks:
            if language in ("indented", "sh", "bash", "console", "shell"):
                for offset, line in enumerate(text.split("\n")):
                    self.check_command(page, first + offset, line)

    def check_link(self, page, line, target, is_picture):
        if re.match(r"[a-z]+:", target):
            return
        file, _, anchor = urllib.parse.unquote(target).partition("#")
        path = (page.path.parent / file).resolve() if file else page.path
        if not path.exists():
            self.add(page, line, "picture" if is_picture else "link", f"{target}: there is no such file")
        elif anchor and path.suffix == ".md" and anchor not in self.page(path).anchors:
            self.add(page, line, "anchor", f"{target}: that page has no heading of this name")

    def check_span(self, page, line, span):
        words = span.split()
        if not words:
            return
        for word in words:
            self.check_path(page, line, word)
        self.check_options(page, line, words)
        if page.path.name not in HISTORY_PAGES:
            self.check_subcommand(page, line, words)
        if "/" not in span or "::" in span:
            self.check_names(page, line, span)

    def check_command(self, page, line, text):
        """A line of a shell: paths, and what is asked of our own programs."""
        words = text.split("#")[0].split()
        if not words:
            return
        for word in words:
            if word.startswith(FOLDERS):
                self.check_path(page, line, word)
        self.check_subcommand(page, line, words)
        if words[0].rsplit("/", 1)[-1] in known.PROGRAMS or words[0].startswith(FOLDERS):
            self.check_options(page, line, words)

    def check_subcommand(self, page, line, words):
        """What is asked of one of our programs: it must be a command of that program, and not of the other."""
        program = words[0].rsplit("/", 1)[-1]
        if program in known.PROGRAMS and len(words) > 1 and re.fullmatch(r"[a-z]+", words[1]):
            if words[1] not in self.names.commands[program]:
                self.add(page, line, "command", f"{program} has no command {words[1]}")

    def check_options(self, page, line, words):
        if words[0].rsplit("/", 1)[-1] in OTHER_PROGRAMS:
            return
        for word in words:
            found = re.match(r"\[?(--[a-z][a-z0-9-]*)", word)
            if found and found.group(1) not in self.names.options and found.group(1) not in ("--help", "--version"):
                self.add(page, line, "option", f"no command has an option {found.group(1)}")

    def check_path(self, page, line, word):
        word = word.strip("\"'()[],;:").rstrip(".")
        if not re.fullmatch(r"[\w./*{},#…+-]+", word) or word.startswith(("/", "-", *MADE)):
            return
        # Whole words of capitals stand for any name, as do a row of # and dots.
        pattern = re.sub(r"\{[^}]*\}|…|#+|(?<![a-z0-9])[A-Z][A-Z_]+(?![a-z0-9])", "*", word)
        pattern = word if word.startswith(("README", "CMake")) else pattern
        if "/" not in word:
            if word.endswith(UNIQUE_ENDINGS) and not word.startswith("."):
                known_here = re.compile("".join(".*" if part == "*" else re.escape(part)
                                                for part in re.split(r"(\*)", pattern)))
                if not any(known_here.fullmatch(name) for name in self.names.file_names):
                    self.add(page, line, "path", f"no file is called {word}")
            return
        if not (word.startswith(FOLDERS) or word.endswith(ENDINGS)):
            return
        if not word.startswith(FOLDERS) and any(path.endswith("/" + word) for path in self.names.paths):
            return  # the end of a path, where the page has said in which folder
        starts = [self.root, page.path.parent, *(self.root / folder for folder in known.PUBLIC_FOLDERS)]
        try:
            if not any(any(start.glob(pattern.rstrip("/"))) for start in starts):
                self.add(page, line, "path", f"there is no {word}")
        except (ValueError, NotImplementedError):
            self.add(page, line, "path", f"{word} is no path")

    def check_names_in_paths(self, page):
        """Names that a page says to be in a file or folder: `name` in `path`, or `path`: `name`, `other name`."""
        said = [(found.start(), found.group(2), found.group(1))
                for found in re.finditer(rf"`([\w:]+)`\s+in\s+`({PATH})`", page.text)]
        for found in re.finditer(rf"`({PATH})`:((?:(?:(?!\n\n)[^`;|.])*`[\w:]+`(?!\s+in\s+`))+)", page.text):
            said += [(found.start(), found.group(1), name) for name in re.findall(r"`([\w:]+)`", found.group(2))]
        for start, path, name in said:
            words = self.names.words_in(self.root / path) if path.startswith(FOLDERS) else None
            if words and not words.issuperset(re.findall(NAME, name)):
                self.add(page, page.text.count("\n", 0, start) + 1, "name", f"{path} has no `{name}`")

    def check_names(self, page, line, span):
        if page.path.name in HISTORY_PAGES:
            return
        is_user_page = page.path.name in USER_PAGES
        for chain, is_start in re.findall(rf"(?<![\w:])({NAME}(?:::~?{NAME})+)(…?)", span):
            mistake = self.names.mistake_of_chain(chain, bool(is_start))
            if mistake:
                self.add(page, line, "name", mistake)
        if "::" in span:
            return
        one = re.fullmatch(rf"((?:{NAME}(?:\.|->))*)({NAME})(\([^()]*\))?", span)
        if not one or span.endswith((*ENDINGS, ".jsonl", ".html", ".obj", ".ply", ".stl", ".csv", ".glb", ".gltf")):
            return
        word = one.group(2)
        is_type = re.fullmatch(r"(?:[A-Z][a-z0-9]+){2,}", word) is not None
        is_function = one.group(3) is not None
        if is_type or is_function or ("_" in word and re.search(r"[a-z]", word)):
            mistake = self.names.mistake_of_word(word, is_user_page, is_type or is_function)
            if mistake and word not in code_blocks.words(page):
                self.add(page, line, "name", mistake)

    def compile(self, pages, compiler, folders):
        header = (HERE / "page_names.hpp").as_posix()
        texts = [code_blocks.parts_in_one_file(pages, header)]
        texts += [text for page in pages for _, text, _ in code_blocks.programs(page)]
        by_name = {page.name: page for page in pages}
        for text in texts:
            for file, line, message in code_blocks.compile_text(compiler, folders, text):
                page = by_name.get(file)
                if page:
                    self.add(page, line, "code", message)
                else:
                    self.mistakes.append((file, line, "code", message))


def pages_of(root):
    return [root / "README.md", *sorted((root / "docs").rglob("*.md"))]


def self_test(checker, compiler, folders):
    page = checker.page(HERE / "wrong_page.md")
    checker.check(page)
    if compiler:
        checker.compile([page], compiler, folders)
    found = {(line, kind) for _, line, kind, _ in checker.mistakes}
    marked = set()
    for number, line in enumerate(page.path.read_text(encoding="utf-8").split("\n"), 1):
        for kind in re.findall(r"wrong: ([a-z]+)", line):
            if kind != "code" or compiler:
                marked.add((number, kind))
    for line, kind in sorted(marked - found):
        print(f"{page.name}:{line}: a wrong {kind} was not found")
    for line, kind in sorted(found - marked):
        print(f"{page.name}:{line}: a {kind} counts as wrong that is right")
    print(f"{len(marked)} mistakes in {page.name}, {len(marked & found)} found")
    return 0 if found == marked else 1


def write_if_other(path, text):
    """Leaves a file alone that has this text, so that it is not compiled again."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def run_program(program, output):
    """Whether a program succeeds and prints what its page says, where the page says anything."""
    done = subprocess.run([program], stdout=subprocess.PIPE, text=True, errors="replace")
    expected = output.read_text(encoding="utf-8")
    if expected and done.stdout != expected:
        print(f"the page says:\n{expected}the program prints:\n{done.stdout}")
        return 1
    return 1 if done.returncode else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--source", type=pathlib.Path, default=HERE.parent.parent)
    parser.add_argument("--compiler", nargs="?")
    parser.add_argument("--include", action="append", default=[])
    parser.add_argument("--programs", type=pathlib.Path)
    parser.add_argument("--run", nargs=2, type=pathlib.Path, metavar=("PROGRAM", "OUTPUT"))
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    if options.run:
        return run_program(*options.run)
    root = options.source.resolve()
    paths = options.pages or pages_of(root)

    if options.programs:
        options.programs.mkdir(parents=True, exist_ok=True)
        for path in paths:
            for name, text, output in code_blocks.programs(Page(path, path.resolve().relative_to(root).as_posix())):
                write_if_other(options.programs / f"{name}.cpp", text)
                write_if_other(options.programs / f"{name}.txt", output or "")
                print(name)
        return 0

    compiler = options.compiler.split(";") if options.compiler else None
    folders = [folder for one in options.include for folder in one.split(";") if folder]
    checker = Checker(root)
    if options.self_test:
        return self_test(checker, compiler, folders)
    pages = [checker.page(path) for path in paths]
    for page in pages:
        checker.check(page)
    if compiler:
        checker.compile(pages, compiler, folders)
    for name, line, kind, message in checker.mistakes:
        print(f"{name}:{line}: {kind}: {message}")
    print(f"{len(pages)} pages, {len(checker.mistakes)} mistakes")
    return 1 if checker.mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
