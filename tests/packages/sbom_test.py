#!/usr/bin/env python3
"""Whether sbom_check finds what is wrong in a list of parts: each test spoils a right one."""

import copy
import sys
import unittest

sys.dont_write_bytecode = True
import sbom_check

PACKAGE = {"name": "graze", "SPDXID": "SPDXRef-graze", "downloadLocation": "NOASSERTION", "versionInfo": "1.2.3",
           "licenseDeclared": "NOASSERTION"}
RIGHT = {
    "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": "graze-1.2.3",
    "documentNamespace": "https://graze.invalid/spdx/1", "packages": [PACKAGE],
    "creationInfo": {"created": "2026-01-02T03:04:05Z", "creators": ["Tool: test"]},
    "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES",
                       "relatedSpdxElement": "SPDXRef-graze"}],
}


class SbomTest(unittest.TestCase):
    def setUp(self):
        self.document = copy.deepcopy(RIGHT)

    def expect(self, words):
        found = sbom_check.of_format(self.document)
        self.assertTrue(any(words in fault for fault in found), found)

    def test_a_right_list_has_no_fault(self):
        self.assertEqual(sbom_check.of_format(self.document), [])

    def test_each_field_is_asked_for(self):
        for key in sbom_check.DOCUMENT:
            self.document = {name: value for name, value in RIGHT.items() if name != key}
            self.expect(f"the document has no {key}")
        for key in ("name", "downloadLocation"):
            self.document = copy.deepcopy(RIGHT)
            del self.document["packages"][0][key]
            self.expect(f"has no {key}")

    def test_dates_namespaces_and_licences(self):
        self.document["creationInfo"]["created"] = "today"
        self.expect("who made it, and when")
        self.document["documentNamespace"] = "graze"
        self.expect("the namespace is no address")
        self.document["packages"][0]["licenseDeclared"] = "free"
        self.expect("SPDX has no licence free")
        self.document["packages"][0]["versionInfo"] = ""
        self.expect("graze has no version")

    def test_relationships_lead_to_parts(self):
        self.document["packages"].append({**PACKAGE, "SPDXID": "SPDXRef-other"})
        self.expect("SPDXRef-other is of nothing")
        self.document["relationships"][0]["relatedSpdxElement"] = "SPDXRef-third"
        self.expect("names SPDXRef-third, which is not there")
        self.document["packages"].append(PACKAGE)
        self.expect("there twice")

    def test_a_program_is_linked_with_what_its_loader_needs(self):
        self.assertEqual(sbom_check.needed_parts("/bin/sh"), set())


if __name__ == "__main__":
    unittest.main()
