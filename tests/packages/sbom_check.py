"""Checks a list of parts (SPDX 2.3, JSON): what the format asks for, and whether it is of the files that are linked."""

import json
import re
import subprocess

# Of a document, a package and a relationship, what SPDX 2.3 asks for.
DOCUMENT = {"spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo"}
PACKAGE = {"name", "SPDXID", "downloadLocation"}
RELATIONSHIP = {"spdxElementId", "relationshipType", "relatedSpdxElement"}
IDENTIFIER = r"SPDXRef-[A-Za-z0-9.-]+"
LICENCES = {"MPL-2.0", "Apache-2.0", "BSD-3-Clause", "MIT", "libpng-2.0", "Zlib", "NOASSERTION"}

# The names of shared libraries, up to their version, and of the parts. None stands for the compiler's own and libc.
PARTS = {"libtbb": "onetbb", "libassimp": "assimp", "libz": "zlib", "libpng16": "libpng", "libspdlog": "spdlog",
         "libfmt": "fmt", "libstdc++": None, "libm": None, "libgcc_s": None, "libc": None, "ld-linux-x86-64": None,
         "ld-linux-aarch64": None}


def of_format(document):
    """What the format asks for and is not there."""
    found = [f"the document has no {key}" for key in DOCUMENT - document.keys()]
    if found:
        return found
    made = document["creationInfo"]
    if document["spdxVersion"] != "SPDX-2.3" or document["dataLicense"] != "CC0-1.0":
        found.append("the document is not of SPDX 2.3 under CC0-1.0")
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", made.get("created", "")) or not made.get("creators"):
        found.append("the document does not say who made it, and when")
    if not re.fullmatch(r"https?://[^#\s]+", document["documentNamespace"]):
        found.append("the namespace is no address")
    known = {document["SPDXID"]}
    for package in document["packages"]:
        found += [f"{package.get('name')} has no {key}" for key in PACKAGE - package.keys()]
        if not re.fullmatch(IDENTIFIER, package["SPDXID"]) or package["SPDXID"] in known:
            found.append(f"{package['SPDXID']} is no identifier, or there twice")
        known.add(package["SPDXID"])
        if package["licenseDeclared"] not in LICENCES:
            found.append(f"{package['name']}: SPDX has no licence {package['licenseDeclared']}")
        if not re.fullmatch(r"\d+(\.\d+)+", package.get("versionInfo", "")):
            found.append(f"{package['name']} has no version")
    for relationship in document["relationships"]:
        found += [f"a relationship has no {key}" for key in RELATIONSHIP - relationship.keys()]
        found += [f"a relationship names {relationship[key]}, which is not there" for key in
                  ("spdxElementId", "relatedSpdxElement") if relationship[key] not in known]
    related = {each[key] for each in document["relationships"] for key in ("spdxElementId", "relatedSpdxElement")}
    return found + [f"{identifier} is of nothing" for identifier in sorted(known - related)]


def needed_parts(binary):
    """The parts that a program or a library is linked with."""
    said = subprocess.run(["readelf", "-d", binary], check=True, capture_output=True, text=True).stdout
    names = re.findall(r"\(NEEDED\).*\[([^\]]+?)\.so[^\]]*\]", said)
    return {PARTS.get(name, f"a library {name} that no list knows") for name in names} - {None}


def faults(path, source, binaries):
    """What is wrong with a list. `binaries` are the files of its parts."""
    document = json.loads(path.read_text(encoding="utf-8"))
    found = of_format(document)
    if found:
        return found
    for part, binary in binaries.items():
        linked = {each["relatedSpdxElement"].removeprefix("SPDXRef-") for each in document["relationships"]
                  if each["spdxElementId"] == f"SPDXRef-{part}" and each["relationshipType"] == "DYNAMIC_LINK"}
        found += [f"{part} is linked with {name}, and the list does not say so" for name in needed_parts(binary) - linked]
        found += [f"{part} is not linked with {name}, as the list says" for name in linked - needed_parts(binary)]
    # The page has what its lock does not call a tool of its developers.
    lock = json.loads((source / "tools/viewer/package-lock.json").read_text(encoding="utf-8"))["packages"]
    shipped = {(name.removeprefix("node_modules/"), entry["version"], entry["license"]) for name, entry in lock.items()
               if name and not entry.get("dev")}
    contained = {each["relatedSpdxElement"] for each in document["relationships"] if each["relationshipType"] == "CONTAINS"}
    listed = {(package["name"], package["versionInfo"], package["licenseDeclared"]) for package in document["packages"]
              if package["SPDXID"] in contained}
    if shipped != listed:
        found.append(f"the page has {shipped}, and the list {listed}")
    return found
