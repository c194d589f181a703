"""The names that pages may use: those of the public headers, of the sources, and of the program."""

import re

PUBLIC_FOLDERS = ["core/include", "scheduler/include", "io/include"]
# Where words of user pages may come from: all but the sources of the two libraries behind the public headers.
OUTER_FOLDERS = ["io", "tools", "tests/fuzz", "tests/contract", "tests/docs"]
PROGRAMS = {"graze": "tools/graze/", "graze_studies": "tools/studies/"}  # and where their commands are
SOURCE_FOLDERS = ["core", "scheduler", "io", "tools", "tests"]
SOURCE_ENDINGS = {".cpp", ".hpp", ".inc", ".txt", ".cmake", ".in", ".sh", ".py"}

# Names of others, by their first part.
FOREIGN_SPACES = {"std", "Eigen", "tbb", "oneapi", "oneTBB", "igl", "Catch", "CGAL", "fcl", "JPH", "nlohmann"}

# What is no name of the project's, and why it stands in a page all the same.
ALLOWED = {
    "Release": "a build type of CMake",
    "Debug": "a build type of CMake",
    "RelWithDebInfo": "a build type of CMake",
    "SameMinorVersion": "a word of CMake",
    "GitHub": "a site",
    "MatrixXi": "of Eigen",
    "VectorXd": "of Eigen",
    "UnitScaleFactor": "a property in FBX files",
    "UpAxis": "a property in FBX files",
    "FrontAxis": "a property in FBX files",
    "CoordAxis": "a property in FBX files",
    "extensionsRequired": "a key of glTF files",
    "up_axis": "an element of Collada files",
    "CamelCase": "a way to spell names",
    "snake_case": "a way to spell names",
    "UPPER_CASE": "a way to spell names",
    "trailing_": "a way to spell names",
}


class Names:
    """Words and classes of a checkout, read once."""

    def __init__(self, root):
        self.public_words, self.outer_words, self.words = set(), set(), set()
        self.public_members = {}  # class or enum -> words of its body
        self.members = {}
        self.file_names, self.paths = set(), set()
        self.options = set()
        self.commands = {program: set() for program in PROGRAMS}  # by program
        self.targets = set()
        self.words_by_path = {}
        for folder in SOURCE_FOLDERS:
            for path in sorted((root / folder).rglob("*")):
                if not path.is_file():
                    continue
                self.file_names.add(path.name)
                self.paths.add(path.relative_to(root).as_posix())
                if path.suffix in SOURCE_ENDINGS or path.name.endswith(".json"):
                    self._read(path, path.relative_to(root).as_posix())
        for name in ["CMakeLists.txt", "CMakePresets.json"]:
            self._read(root / name, name)
        for path in [*root.glob("*"), *(root / "docs").rglob("*")]:
            self.file_names.add(path.name)

    def _read(self, path, relative):
        text = path.read_text(encoding="utf-8", errors="replace")
        words = set(re.findall(r"\w+", text))
        self.words |= words
        is_public = any(relative.startswith(folder + "/") for folder in PUBLIC_FOLDERS)
        is_build = path.name.startswith("CMake")
        if is_public or is_build:
            self.public_words |= words
        if is_public or is_build or any(relative.startswith(folder + "/") for folder in OUTER_FOLDERS):
            self.outer_words |= words
        if path.suffix in {".cpp", ".hpp"}:
            for name, body in class_bodies(text):
                self.members.setdefault(name, set()).update(body)
                if is_public:
                    self.public_members.setdefault(name, set()).update(body)
            for name, member in re.findall(r"\b(\w+)::~?(\w+)\b", text):
                if name in self.members:
                    self.members[name].add(member)
        if relative.startswith(("tools/", "tests/")):
            self.options.update(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", text))
        for program, folder in PROGRAMS.items():
            if relative.startswith(folder):
                self.commands[program].update(re.findall(r"add_subcommand\(\s*\"(\w+)\"", text))
        self.targets.update(re.findall(r"\bgraze::(\w+)\s+ALIAS", text))
        self.targets.update(re.findall(r"graze_add_library\((\w+)", text))
        if is_build:
            self.targets.update(re.findall(r"\bgraze::(\w+)", text))

    def words_in(self, path):
        """The words of a file or of all files of a folder; none where it is not there."""
        if path not in self.words_by_path:
            files = [path] if path.is_file() else [file for file in path.rglob("*") if file.is_file()]
            texts = [file.read_text(encoding="utf-8", errors="replace") for file in files]
            self.words_by_path[path] = {word for text in texts for word in re.findall(r"\w+", text)}
        return self.words_by_path[path]

    def mistake_of_chain(self, chain, is_start=False):
        """What is wrong with a name that has `::` in it, or nothing. `is_start`: more letters may follow."""
        parts = [part for part in chain.split("::") if part]
        if not parts or parts[0] in FOREIGN_SPACES:
            return None
        if parts[0] == "graze":
            if len(parts) == 2 and parts[1] in self.targets:
                return None
            parts = [part for part in parts[1:] if part not in ("io", "tools")]
            members = self.public_members
            for part in parts:
                if part not in self.public_words:
                    return f"no public header has `{part}`"
        else:
            members = self.members
        for owner, member in zip(parts, parts[1:]):
            member = member.lstrip("~")
            if owner in members:
                is_there = member in members[owner] or member == owner
                if is_start and member == parts[-1]:
                    is_there = any(word.startswith(member) for word in members[owner])
                if not is_there:
                    return f"`{owner}` has no `{member}`"
            elif owner not in self.words or member not in self.words:
                return f"there is no `{owner}::{member}`"
        return None

    def mistake_of_word(self, word, is_user_page, is_type_or_function):
        """What is wrong with a name of one word, or nothing."""
        if word in ALLOWED:
            return None
        if word not in self.words:
            return f"nothing is called `{word}`"
        if is_user_page and is_type_or_function and word not in self.public_words and word not in self.outer_words:
            return f"no public header has `{word}`"
        return None


def class_bodies(text):
    """(name, words of the body) of each class, struct and enum that a file defines."""
    text = re.sub(r"//(?!/)[^\n]*", "", text)
    for found in re.finditer(r"\b(?:class|struct|enum(?:\s+class)?)\s+(?:[A-Z_]+\s+)?(\w+)[^;{}()]*\{", text):
        depth, end = 1, found.end()
        while end < len(text) and depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        yield found.group(1), set(re.findall(r"\w+", text[found.end():end]))
