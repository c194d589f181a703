#!/usr/bin/env python3
"""Checks that the public headers document every name, and that their comments name nothing that does not exist.

Doxygen warns of most undocumented names and of broken references. It says nothing of enumerators, macros, concepts and
default constructors, nor of names in running text. This program looks for those in Doxygen's XML."""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

SKIPPED = 77
FOREIGN_SPACES = {"std", "Eigen"}
# Words in backticks that are no names of graze.
ALLOWED_WORDS = {
    "Map": "of Eigen",
    "Ref": "of Eigen",
    "Block": "of Eigen",
    "x": "a word in files",
    "y": "a word in files",
    "z": "a word in files",
    "up": "a key of scene files",
    "unit": "a key of scene files",
}


def run_doxygen(doxygen, doxyfile, folder, more=""):
    """The lines that Doxygen complains of. Its XML is in `folder`/xml."""
    settings = folder / "Doxyfile"
    settings.write_text(
        f'@INCLUDE = "{doxyfile}"\nOUTPUT_DIRECTORY = "{folder}"\nGENERATE_HTML = NO\nGENERATE_XML = YES\n'
        f"XML_PROGRAMLISTING = NO\n{more}",
        encoding="utf-8")
    done = subprocess.run([doxygen, settings], capture_output=True, text=True, errors="replace", check=False)
    complaints = [line for line in done.stderr.splitlines() if line.strip()]
    if done.returncode != 0 and not complaints:
        complaints.append(f"{doxygen} ended with {done.returncode}")
    return complaints


def is_documented(element):
    return any("".join(part.itertext()).strip()
               for kind in ("briefdescription", "detaileddescription") for part in element.findall(kind))


def place_of(element):
    location = element.find("location")
    return "" if location is None else f"{location.get('file')}:{location.get('line')}: "


class Reference:
    """The names of Doxygen's XML, and those of them without documentation."""

    def __init__(self, folder):
        self.names = set()
        self.complaints = []
        for path in sorted(folder.glob("*.xml")):
            for compound in ElementTree.parse(path).getroot().findall("compounddef"):
                self._read(compound)

    def _read(self, compound):
        kind = compound.get("kind")
        name = compound.findtext("compoundname")
        if compound.get("prot") == "private":
            return
        if kind in {"class", "struct", "union", "namespace", "group", "concept"}:
            if kind != "group":
                self.names.add(name)
            # Namespaces of others appear where a name of theirs is mentioned.
            if not is_documented(compound) and name.split("::")[0] not in FOREIGN_SPACES:
                self.complaints.append(f"{place_of(compound)}{kind} {name} is not documented")
        for member in compound.iter("memberdef"):
            if member.get("prot") in {"public", "protected"}:
                self._read_member(member, name if kind not in {"group", "file"} else "")

    def _read_member(self, member, owner):
        name = member.findtext("qualifiedname") or member.findtext("name")
        if owner and not name.startswith(owner):
            name = f"{owner}::{name}"
        self.names.add(name)
        what = f"{place_of(member)}{member.get('kind')} {name}"
        if not is_documented(member):
            self.complaints.append(f"{what} is not documented")
        for value in member.findall("enumvalue"):
            self.names.add(f"{name}::{value.findtext('name')}")
            if not is_documented(value):
                self.complaints.append(f"{what}: enumerator {value.findtext('name')} is not documented")

    def has(self, name):
        """Whether a name, or the last parts of one, is there."""
        return any(known == name or known.endswith("::" + name) for known in self.names)


def check_text(path, text, reference, code_words, source):
    """Complains of what the comments of a header name and what does not exist."""
    complaints = []
    for number, line in enumerate(text.splitlines(), 1):
        comment = re.search(r"//[/<]*(.*)", line)
        if comment is None or comment.group(1).startswith("     "):  # code
            continue
        if line.startswith("}  // namespace "):  # the namespace may be an internal one
            continue

        def complain(what, number=number):
            complaints.append(f"{path}:{number}: {what}")

        words = comment.group(1)
        for page in re.findall(r"\bdocs/[\w/.]*\w", words):
            if not (source / page).exists():
                complain(f"there is no {page}")
        for name in re.findall(r"(?<![\w:])[A-Za-z]\w*(?:::\w+)+", words):
            if name.split("::")[0] not in FOREIGN_SPACES and not reference.has(name):
                complain(f"there is no {name}")
        for name in re.findall(r"(?<![\w:.])([a-z]\w*)\(\)", words):
            if not reference.has(name):
                complain(f"there is no function {name}()")
        for name in re.findall(r"`([A-Za-z_]\w*)`", words):
            if name not in code_words and name not in ALLOWED_WORDS and not reference.has(name):
                complain(f"there is no `{name}`")
    return complaints


def check(doxygen, doxyfile, source, headers, more=""):
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        complaints = run_doxygen(doxygen, doxyfile, folder, more)
        if not (folder / "xml" / "index.xml").exists():
            return complaints + ["Doxygen wrote nothing"]
        reference = Reference(folder / "xml")
    complaints += reference.complaints
    texts = {header: header.read_text(encoding="utf-8") for header in headers}
    code_words = {word for text in texts.values() for word in re.findall(r"\w+", re.sub(r"//.*", "", text))}
    for header, text in texts.items():
        complaints += check_text(header, text, reference, code_words, source)
    return complaints


def public_headers(source):
    folders = [source / library / "include" for library in ("core", "scheduler", "io")]
    return sorted(path for folder in folders for path in folder.rglob("*.hpp"))


def excluded_names(doxyfile):
    """The file names that the Doxyfile leaves out."""
    text = pathlib.Path(doxyfile).read_text(encoding="utf-8")
    patterns = re.search(r"^EXCLUDE_PATTERNS = ((?:.*\\\n)*.*)$", text, re.MULTILINE)
    return set(re.findall(r"[\w]+\.hpp", patterns.group(1))) if patterns else set()


def self_test(doxygen, doxyfile, source):
    """wrong_names.hpp says in a comment beside each line what has to be complained of."""
    header = pathlib.Path(__file__).with_name("wrong_names.hpp")
    complaints = check(doxygen, doxyfile, source, [header], f'INPUT = "{header}"\nEXCLUDE_PATTERNS =\n')
    found = {int(match.group(1)) for complaint in complaints
             if (match := re.search(r"wrong_names\.hpp:(\d+)", complaint))}
    lines = header.read_text(encoding="utf-8").splitlines()
    wanted = {number for number, line in enumerate(lines, 1) if line.endswith("// wrong")}
    problems = [f"{header}:{line}: no complaint" for line in sorted(wanted - found)]
    problems += [f"{header}:{line}: a complaint too many" for line in sorted(found - wanted)]
    if not wanted:
        problems.append(f"{header}: no line is wrong")
    return problems + (complaints if problems else [])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--doxygen", default="doxygen")
    parser.add_argument("--doxyfile", required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if not options.doxygen or options.doxygen.endswith("NOTFOUND"):
        print("Doxygen is not installed: skipped")
        return SKIPPED
    if options.self_test:
        complaints = self_test(options.doxygen, options.doxyfile, options.source)
    else:
        excluded = excluded_names(options.doxyfile)
        headers = [path for path in public_headers(options.source) if path.name not in excluded]
        complaints = check(options.doxygen, options.doxyfile, options.source, headers)
        first_page = pathlib.Path(__file__).with_name("reference.dox")
        for page in re.findall(r"@graze_page\{([^,}]*),", first_page.read_text(encoding="utf-8")):
            if not (options.source / page).exists():
                complaints.append(f"{first_page}: there is no {page}")
        print(f"{len(headers)} headers")
    for complaint in dict.fromkeys(complaints):
        print(complaint)
    return 1 if complaints else 0


sys.exit(main())
