#!/usr/bin/env python3
"""Compares the manual page and the completions of the program graze with what its --help says.

usage: program_pages.py PROGRAM [--write]

The files have parts between lines with "begin" and "end", which this script makes from the help. A part that is not
what the help says is an error. --write puts the parts there. An option that takes a text has to stand in VALUES.
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAN = ROOT / "tools/graze/man/graze.1"
BASH = ROOT / "tools/graze/completion/graze.bash"
ZSH = ROOT / "tools/graze/completion/graze.zsh"
FISH = ROOT / "tools/graze/completion/graze.fish"

MESHES = "json obj ply off stl gltf glb fbx dae x 3ds blend 3mf"
RECORDING = "files: graze"
FRAMES = "words:"  # a range, which nobody can guess
# What completes a text: files by their endings, or words. The key is a command, and an option or nothing.
VALUES = {
    "run": f"files: {MESHES}", "inspect": f"files: {MESHES}",
    "replay": RECORDING, "info": RECORDING, "worst": RECORDING, "cut": RECORDING, "view": RECORDING,
    "picture": RECORDING, "export": RECORDING,
    "run --detail": "words: none closest regions vertices features nearest",
    "run --accuracy": "words: exact within: paper paper:",
    "run --report": "files: jsonl jsonl.gz", "run --record": "files: graze", "run --picture": "files: png",
    "run --html": "files: html grazeview",
    "replay --instruction-set": "words: scalar baseline avx2 avx512",
    "worst --frames": FRAMES, "cut --frames": FRAMES, "export --frames": FRAMES,
    "cut --pair": "words:", "picture --select": "words:",
    "cut --output": "files: graze", "view --output": "files: html grazeview", "picture --output": "files: png",
    "export --csv": "files: csv", "export --distances": "files: csv", "export --paraview": "files: pvd",
    "export --gltf": "files: gltf glb",
}


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout


def entries(text, title):
    """Yields (head, description) of each entry below a title, such as "Options:"."""
    found = re.search(rf"^{title}:\n((?:  .*\n)+)", text, flags=re.MULTILINE)
    head = None
    for line in found.group(1).splitlines() if found else []:
        if line.startswith(" " * 10):
            yield head, line.strip()
            continue
        parts = re.match(r"  (\S.*?)(?:\s{2,}|(?<=\S) (?=[A-Z][a-z]))(\S.*)$", line)
        head = line.strip()
        if parts and (len(parts.group(1)) < 28):
            yield parts.group(1), parts.group(2)


class Option:
    """An option as the help has it: its names, its type, its range, and what it does."""

    def __init__(self, head, text):
        self.text = text
        names, _, value = head.partition(" ")
        self.names = names.split(",")
        self.is_required = "REQUIRED" in value
        self.is_repeated = "..." in value
        value = value.replace("REQUIRED", "").replace("...", "").strip()
        self.type, _, self.range = value.partition(":")
        self.type = self.type.strip()

    @property
    def placeholder(self):
        first = {"UINT": "N", "FLOAT": "X", "TEXT": "TEXT", "TEXT x 2": "TEXT TEXT"}[self.type]
        return first + (" ..." if self.is_repeated else "")


class Help:
    """What the program says of its commands."""

    def __init__(self, program):
        top = help_of(program)
        self.version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
        self.options = [Option(*entry) for entry in entries(top, "Options")]
        self.commands = dict(entries(top, "Subcommands"))
        self.files, self.options_of = {}, {}
        for command in self.commands:
            text = help_of(program, command)
            self.files[command] = next(entries(text, "Positionals"))
            self.options_of[command] = [Option(*entry) for entry in entries(text, "Options")]
            shown = len(re.findall(r"^  -", text, flags=re.MULTILINE))
            if shown != len(self.options_of[command]):
                sys.exit(f"{command}: {len(self.options_of[command])} of {shown} options of the help were read")


def roff(text):
    """The text as roff has it: a minus sign where it was typed, and no line that begins as a request."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def sentence(text):
    return roff(text if text.endswith(".") else text + ".")


def man_option(option):
    names = ", ".join(f"\\fB{roff(name)}\\fR" for name in option.names)
    value = f" \\fI{roff(option.placeholder)}\\fR" if option.type else ""
    lines = [".TP", names + value, sentence(option.text)]
    if option.range:
        lines.append(sentence(f"The number is {option.range.removeprefix('of ')}"))
    if option.is_required:
        lines.append("This option has to be there.")
    return lines


def man_parts(said):
    options, commands = [], []
    for option in said.options:
        options += man_option(option)
    for command, text in said.commands.items():
        head, files = said.files[command]
        name = head.split()[0] + (" ..." if "..." in head else "")
        commands += [".TP", f"\\fBgraze {command}\\fR [\\fIoption\\fR ...] \\fI{roff(name)}\\fR", sentence(text)]
        options += [f".SS Options of graze {command}", f"\\fI{roff(name)}\\fR: {sentence(files[0].lower() + files[1:])}"]
        for option in said.options_of[command]:
            options += man_option(option)
    return {"title": [f'.TH GRAZE 1 "" "graze {said.version}" "User Commands"'], "commands": commands, "options": options}


def bash_parts(said):
    lines = [f"_graze_commands() {{ echo '{' '.join(said.commands)}'; }}", "",
             "# _graze_options COMMAND: the options of a command, or of the program.", "_graze_options() {", "  case $1 in"]
    lines.append(f"    '') echo '{' '.join(name for option in said.options for name in option.names)}' ;;")
    for command, options in said.options_of.items():
        lines.append(f"    {command}) echo '{' '.join(name for option in options for name in option.names)}' ;;")
    lines += ["  esac", "}", "", "# _graze_value 'COMMAND OPTION': what may follow. 'words:' alone stands for what only the "
              "user knows.", "_graze_value() {", "  case $1 in"]
    for command, options in said.options_of.items():
        for option in options:
            if option.type:
                kind = VALUES.get(f"{command} {option.names[-1]}") if option.type.startswith("TEXT") else "words:"
                if kind is None:
                    sys.exit(f"VALUES has no \"{command} {option.names[-1]}\"")
                pattern = " | ".join(f"'{command} {name}'" for name in option.names)
                lines.append(f"    {pattern}) echo '{kind}' ;;")
        lines.append(f"    {command}) echo '{VALUES[command]}' ;;")
    return {"commands": [*lines, "  esac", "}"]}


def kind_of(command, option):
    """What follows an option: the kind of VALUES as a word and a list, or nothing."""
    if not option.type:
        return None
    kind, _, words = VALUES.get(f"{command} {option.names[-1]}", "words:").partition(":")
    return kind, words.split()


def quoted(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def zsh_quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_text(text):
    """A description within brackets of _arguments."""
    return text.replace("\\", "\\\\").replace("]", "\\]").replace("[", "\\[").replace(":", "\\:")


def zsh_value(kind, words):
    if kind == "files":
        return f"file: _graze_files {' '.join(words)}"
    return f"value:({' '.join(words).replace(':', chr(92) + ':')})" if words else "value: "


def zsh_option(command, option):
    names = " ".join(option.names)
    kind = kind_of(command, option)
    value = "".join(f":{zsh_value(*kind)}" for _ in range(2 if option.type.endswith("x 2") else 1)) if kind else ""
    return [zsh_quoted(f"({names}){name}[{zsh_text(option.text)}]{value}") for name in option.names]


def zsh_parts(said):
    lines = ["_graze_commands() {", "  local -a commands=("]
    lines += [f"    {zsh_quoted(command + ':' + text.replace(':', chr(92) + ':'))}" for command, text in said.commands.items()]
    lines += ["  )", "  _describe command commands", "}", "", "# _graze_arguments [COMMAND]: what a command takes, or the program.",
              "_graze_arguments() {", "  case $1 in", "    '')", "      _arguments -C \\"]
    lines += [f"        {line} \\" for option in said.options for line in zsh_option("", option)]
    lines += ["        '1:command:_graze_commands' \\", "        '*::argument:_graze_after_command'", "      ;;"]
    for command, options in said.options_of.items():
        kind, words = VALUES[command].partition(":")[::2]
        count = "*" if "..." in said.files[command][0] else "1"
        lines += [f"    {command})", "      _arguments \\"]
        lines += [f"        {line} \\" for option in options for line in zsh_option(command, option)]
        lines += [f"        {zsh_quoted(count + ':' + zsh_value(kind, words.split()))}", "      ;;"]
    return {"commands": [*lines, "  esac", "}"]}


def fish_option(command, option, condition):
    names = " ".join(f"-{'l' if name.startswith('--') else 's'} {name.lstrip('-')}" for name in option.names)
    kind = kind_of(command, option)
    value = ""
    if kind:
        value = " -x" if kind[0] == "words" else f" -x -a '(__graze_files {' '.join(kind[1])})'"
        if kind[0] == "words" and kind[1]:
            value += f" -a '{' '.join(kind[1])}'"
    return f"complete -c graze -n '{condition}' {names}{value} -d {quoted(option.text)}"


def fish_parts(said):
    lines = [f"complete -c graze -n __fish_use_subcommand -a {command} -d {quoted(text)}"
             for command, text in said.commands.items()]
    lines += [fish_option("", option, "__fish_use_subcommand") for option in said.options]
    for command, options in said.options_of.items():
        condition = f"__fish_seen_subcommand_from {command}"
        endings = VALUES[command].partition(":")[2].strip()
        lines.append(f"complete -c graze -n '{condition}' -a '(__graze_files {endings})'")
        lines += [fish_option(command, option, condition) for option in options]
    return {"commands": lines}


def with_parts(text, mark, parts):
    for name, lines in parts.items():
        begin, end = f"{mark} begin {name}\n", f"{mark} end {name}\n"
        before, _, rest = text.partition(begin)
        _, _, after = rest.partition(end)
        text = before + begin + "".join(line + "\n" for line in lines) + end + after
    return text


def check_values(said):
    """Words of VALUES that the help does not have, and keys of what is gone."""
    known = {f"{command} {name}": option for command, options in said.options_of.items() for option in options
             for name in option.names}
    faults = [f"VALUES has \"{key}\", which the program has not" for key in VALUES
              if " " in key and key not in known or " " not in key and key not in said.commands]
    for key, kind in VALUES.items():
        if kind.startswith("words: ") and key in known:
            faults += [f"{key} takes no {word}" for word in kind.split()[1:] if word not in known[key].text]
    return faults


def main():
    said = Help(sys.argv[1])
    faults = check_values(said)
    for path, mark, parts in ((MAN, '.\\"', man_parts(said)), (BASH, "#", bash_parts(said)), (ZSH, "#", zsh_parts(said)),
                              (FISH, "#", fish_parts(said))):
        old = path.read_text(encoding="utf-8")
        new = with_parts(old, mark, parts)
        if "--write" in sys.argv:
            path.write_text(new, encoding="utf-8")
        elif new != old:
            faults.append(f"{path.relative_to(ROOT)} is not of this program's help; see --write in {pathlib.Path(__file__).name}")
    count = sum(map(len, said.options_of.values()))
    print("\n".join(faults) or f"{len(said.commands)} commands and {count} options are the same")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
