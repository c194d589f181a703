"""The C++ of pages, made into files that a compiler reads. docs/contributing.md has the rules."""

import re
import subprocess

CPP = ("cpp", "c++")
PROGRAM = re.compile(r"\bint\s+main\s*\(")
# A block with a function or a class at the left margin stands outside of functions.
OUTSIDE = re.compile(
    r"^(?:template\b|(?:class|struct|enum)\s+\w+"
    r"|(?!else\b|return\b|new\b)[A-Za-z_][\w:<>,&* ]*?[\s&*]\w+\([^;]*\)\s*(?:const\s*)?\{)",
    re.M)


def is_program(block):
    return PROGRAM.search(block[2]) is not None


def cpp_blocks(page):
    return [block for block in page.blocks if block[1] in CPP]


def words(page):
    """The names that a page's own code has: the compiler knows them."""
    return set(re.findall(r"\w+", "\n".join(text for _, _, text in cpp_blocks(page))))


def parts_in_one_file(pages, names_header):
    """One file with the blocks of all pages that are no programs, each page in a namespace of its own."""
    includes, bodies = [f'#include "{names_header}"'], []
    for number, page in enumerate(pages):
        outside, inside = [], []
        for line, _, text in [block for block in cpp_blocks(page) if not is_program(block)]:
            code = []
            for one in text.split("\n"):
                is_include = one.lstrip().startswith("#include")
                if is_include:
                    includes.append(one.strip())
                code.append("" if is_include else one)
            is_outside = OUTSIDE.search(text) is not None
            (outside if is_outside else inside).append([f'#line {line} "{page.name}"', *code])
        if not outside and not inside:
            continue
        bodies.append(f"namespace page_{number} {{")
        for code in outside:
            bodies.extend(code)
        # A block within the one before: it sees what that declared, and may declare the same names anew.
        bodies.append("void blocks() {")
        for code in inside:
            bodies.extend(["{", *code])
        bodies.extend(["}" * (len(inside) + 1), "}"])
    return "\n".join([*dict.fromkeys(includes), *bodies, ""])


def programs(page):
    """(name, text, output or None) of each block that is a program. A block of text after it is what it prints."""
    stem = re.sub(r"\W", "_", page.path.stem).lower()
    found = []
    for block, after in zip(page.blocks, [*page.blocks[1:], (0, "", "")]):
        line, language, text = block
        if language in CPP and is_program(block):
            output = after[2] + "\n" if after[1] == "text" else None
            found.append((f"{stem}_{len(found) + 1}", f'#line {line} "{page.name}"\n{text}\n', output))
    return found


def compile_text(compiler, folders, text):
    """(file, line, message) of each error."""
    command = [*compiler, "-std=c++20", "-fsyntax-only", "-w", "-fno-diagnostics-color", "-x", "c++"]
    for folder in folders:
        command += ["-isystem", folder]
    done = subprocess.run([*command, "-"], input=text, capture_output=True, text=True, errors="replace")
    errors = re.findall(r"^(.+?):(\d+)(?::\d+)?: (?:fatal )?error: (.*)$", done.stderr, flags=re.M)
    if done.returncode != 0 and not errors:
        errors = [("the compiler", "0", done.stderr.strip().split("\n")[-1] if done.stderr.strip() else "failed")]
    return [(file, int(line), message) for file, line, message in errors]
