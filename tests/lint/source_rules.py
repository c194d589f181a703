#!/usr/bin/env python3
"""Checks rules that the sources keep and no compiler knows.

1. No message for users holds a name of the code. Such a name is a word like `json_path`. Allowed are names that users
   know: those of public headers, and keys of files.
2. Readers of graze::io open files by `open_input` alone, or tell `OpenedFiles` what they open. So no output can be
   written over a file that was read.
3. Commands that read files of others print by `say` and `say_aside` alone, which spell out control characters.
4. A function has at most one argument that draws a random number. Compilers evaluate arguments in any order, so the
   scenes of two builds would differ. Within braces the order is that of the text.
5. No folder of sources has more than 30 files: a larger one has folders by subject.
6. core and scheduler use what a compiler has beyond C++20 in the files of EXTENSIONS alone. There each use has a portable
   form beside it, or stands where the compiler is known.

Prints each place where a rule is broken; the exit code is 1 where there is one.
"""

import argparse
import pathlib
import re
import sys

LIBRARIES = ["core", "scheduler", "io"]
MOST_FILES = 30  # in a folder
EXTENSIONS = {
    "core/include/graze/export.hpp",  # but for Windows
    "core/include/graze/link_guard.hpp",  # with GCC's standard library
    "core/internal/core/base/compiler.hpp", "core/internal/core/base/floating_point_scope.hpp",
    "core/internal/core/base/prefetch.hpp", "core/src/arithmetic/exact.cpp", "core/src/kernels/vectors.hpp",
    "core/src/kernels/registers.inc", "core/src/kernels/block_kernels.inc",  # for instruction sets of x86
    "core/src/kernels/instruction_set.cpp",  # with kernels of x86
}
EXTENSION = (r"__builtin_|__attribute__|\[\[gnu::|\[\[clang::|#\s*pragma (?!once)|\b_Pragma|__int128|__extension__|__restrict\b"
             r"|\basm\b|\b__asm|\b_mm\d*_|\bvector_size\b|\b__m\d|intrin\.h")
COMMANDS = ["tools/graze", "tools/graze/recording", "tools/program"]  # the files in them, not the folders below

# A comment, a raw text, a text, a character.
TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<text>(?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\]|\\.)\'',
    re.DOTALL)
ARGUMENT = r"(?:[^(){};]|\((?:[^(){};]|\([^(){};]*\))*\))*?"
DRAW = r"(?:\brandom\.\w+\(|\b\w+\((?:random|engine)\b)"
TWO_DRAWS = re.compile(rf"[\w>]\({ARGUMENT}{DRAW}{ARGUMENT}\){ARGUMENT},{ARGUMENT}{DRAW}")
CODE_WORD = re.compile(r"(?<![\w.%-])[A-Za-z]\w*_\w+")
INCLUDE_LINE = re.compile(r"^[ \t]*#[ \t]*include[^\n]*", re.MULTILINE)


def literals(source):
    """The texts of a source with their lines. Texts with nothing but blanks between them are one."""
    source = INCLUDE_LINE.sub("", source)
    found = []
    end = None
    for match in TOKEN.finditer(source):
        text = match["raw"] if match["raw"] is not None else match["text"]
        if text is None:
            continue
        if end is not None and not source[end:match.start()].strip():
            found[-1] = (found[-1][0], found[-1][1] + text)
        else:
            found.append((source.count("\n", 0, match.start()) + 1, text))
        end = match.end()
    return found


def is_sentence(text):
    return " " in text.strip() and "<" not in text  # not a key, and no XML


def words_of_code(source, known):
    """Lines and words of messages that are not in `known`."""
    return [(line, word) for line, text in literals(source) if is_sentence(text)
            for word in CODE_WORD.findall(text) if word not in known]


def without_comments(source):
    return TOKEN.sub(lambda match: re.sub(r"[^\n]", " ", match[0]) if match[0].startswith("/") else match[0], source)


def lines_with(source, pattern):
    return [number for number, line in enumerate(without_comments(source).split("\n"), 1) if re.search(pattern, line)]


def sources(folder, is_deep):
    files = folder.rglob("*") if is_deep else folder.glob("*")
    return sorted(file for file in files if file.suffix in (".cpp", ".hpp", ".inc"))


def known_words(root, files):
    """Names of public headers, and keys: texts that are one word."""
    known = set()
    for library in LIBRARIES:
        for header in sources(root / library / "include", True):
            known.update(re.findall(r"\w+", header.read_text(encoding="utf-8")))
    for file in files:
        known.update(text for _, text in literals(file.read_text(encoding="utf-8")) if re.fullmatch(r"\w+", text))
    return known


def check(root):
    """The problems of a tree, a line each."""
    library_files = [file for library in LIBRARIES for file in sources(root / library, True)]
    command_files = [file for folder in COMMANDS for file in sources(root / folder, False)]
    files = library_files + command_files
    known = known_words(root, files)
    problems = []
    for file in files:
        source = file.read_text(encoding="utf-8")
        name = file.relative_to(root).as_posix()
        for line, word in words_of_code(source, known):
            problems.append(f"{name}:{line}: a message holds the name {word} of the code")
        if name.startswith("io/src/") and "open_input(" not in source and "OpenedFiles::add(" not in source:
            problems += [f"{name}:{line}: a file is opened without a word to OpenedFiles; use open_input"
                         for line in lines_with(source, r"\bifstream\b|\bfopen\(|\bgzopen\(")]
        if name.startswith(("core/", "scheduler/")) and name not in EXTENSIONS:
            problems += [f"{name}:{line}: uses what not every compiler has (core/base/compiler.hpp, kernels/vectors.hpp)"
                         for line in lines_with(source, EXTENSION)]
        if file in command_files and file.name != "progress.cpp":
            problems += [f"{name}:{line}: prints by itself; use say or say_aside (output/terminal.hpp)"
                         for line in lines_with(source, r"\bf?printf\(|\bf?puts\(|\bcout\b|\bcerr\b")]
    for folder in ["tests", "tools"]:
        for file in sources(root / folder, True):
            source = without_comments(file.read_text(encoding="utf-8"))
            problems += [f"{file.relative_to(root).as_posix()}:{source.count(chr(10), 0, match.start()) + 1}: "
                         "two arguments draw random numbers, in any order" for match in TWO_DRAWS.finditer(source)]
    for folder in sorted(path for top in [*LIBRARIES, "tools", "tests"] for path in (root / top).rglob("*")
                         if path.is_dir()):
        count = sum(path.is_file() for path in folder.iterdir())
        if count > MOST_FILES and "node_modules" not in folder.parts:
            problems.append(f"{folder.relative_to(root).as_posix()}: {count} files are more than {MOST_FILES}; "
                            "sort them into folders by subject")
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    problems = check(parser.parse_args().root)
    print("\n".join(problems) or "the sources keep the rules")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
