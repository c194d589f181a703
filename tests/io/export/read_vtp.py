#!/usr/bin/env python3
"""Prints a .vtp file: a line for each array, `PARENT/NAME TYPE COMPONENTS NUMBER…`, and one for the counts of its piece.

The XML is read by a strict parser, and the numbers by Python's own base64 and struct. Doubles are printed so that they
come back to the same bits.
"""
import base64
import struct
import sys
import xml.etree.ElementTree

FORMATS = {"Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B", "UInt32": "I", "UInt64": "Q"}

root = xml.etree.ElementTree.parse(sys.argv[1]).getroot()
assert root.attrib["type"] == "PolyData" and root.attrib["byte_order"] == "LittleEndian", root.attrib
assert root.attrib["header_type"] == "UInt64", root.attrib
(piece,) = root.findall("PolyData/Piece")
print("counts", *(piece.attrib[f"NumberOf{name}"] for name in ("Points", "Verts", "Lines", "Strips", "Polys")))
for parent in piece:
    for array in parent:
        data = base64.b64decode(array.text, validate=True)
        (size,) = struct.unpack_from("<Q", data)
        assert size == len(data) - 8, (array.attrib, size, len(data))
        letter = FORMATS[array.attrib["type"]]
        numbers = struct.unpack_from(f"<{size // struct.calcsize(letter)}{letter}", data, 8)
        print(f"{parent.tag}/{array.attrib['Name']}", array.attrib["type"], array.attrib["NumberOfComponents"],
              *map(repr, numbers))
