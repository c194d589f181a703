"""Compares the structs and functions that the package declares with graze.h and with the library."""

import ctypes
import pathlib
import re
import unittest

import numpy as np

import graze
from graze import _convert, _functions, _library, _structs, rows, settings

lib = _library.lib
HEADER = pathlib.Path(__file__).resolve().parents[2] / "scheduler/c/include/graze/graze.h"
NUMBERS = {
    "bool": ctypes.c_bool, "double": ctypes.c_double, "float": ctypes.c_float, "size_t": ctypes.c_size_t,
    "int32_t": ctypes.c_int32, "uint8_t": ctypes.c_uint8, "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64,
    "graze_status": ctypes.c_int32}
# The struct of the package for each struct of C. What is called by its handle has none.
CALLED = {
    "id": _structs.Id, "feature": _structs.Feature, "bounds": _structs.Bounds, "witness": _structs.Witness,
    "way_out": _structs.WayOut, "diagnostic": _structs.Diagnostic, "positions": _structs.Positions,
    "scene_settings": _structs.SceneSettings, "object_settings": _structs.ObjectSettings,
    "pair_rule": _structs.PairRule, "scene_capacity": _structs.SceneCapacity,
    "query_settings": _structs.QuerySettings, "query_result": _structs.QueryResult,
    "query_filter": _structs.QueryFilter, "recorder_settings": _structs.RecorderSettings,
    "recorder_statistics": _structs.RecorderStatistics, "recorded_frame": _structs.RecordedFrame,
    "replay_difference": _structs.ReplayDifference,
    "patch": _structs.Patch, "patch_answer": _structs.PatchAnswer}
ROWS = {
    "id": rows.ID, "feature": rows.FEATURE, "contact": rows.CONTACT, "bounds": rows.BOUNDS,
    "witness": rows.WITNESS, "way_out": rows.WAY_OUT, "pair": rows.PAIR, "region_distance": rows.REGION_DISTANCE,
    "impact": rows.IMPACT, "contact_geometry": rows.CONTACT_GEOMETRY, "followed_contact": rows.FOLLOWED_CONTACT, "weights": rows.WEIGHTS,
    "patch_pair": rows.PATCH_PAIR, "ray_hit": rows.RAY_HIT, "sphere_hit": rows.SPHERE_HIT, "closest_point": rows.CLOSEST_POINT,
    "statistics": rows.STATISTICS}
UNUSED = {"task_scheduler"}  # functions of C that call back; a scene from Python takes oneTBB


def header_text():
    text = HEADER.read_text(encoding="utf-8")
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)


def type_of(declaration, structs):
    """Returns the ctypes type of a member without its name, such as `double [3]`."""
    array = re.search(r"\[(\d+)\]", declaration)
    if "*" in declaration or "(" in declaration:
        return ctypes.c_void_p
    name = declaration.replace("const ", "").split()[0]
    one = NUMBERS.get(name) or structs[name.removeprefix("graze_")]
    return one * int(array[1]) if array else one


def structs_of_header():
    """Returns ctypes structs that are made of the header alone."""
    found = {}
    for body, name in re.findall(r"typedef struct \{(.*?)\} graze_(\w+);", header_text(), flags=re.DOTALL):
        fields = []
        for line in [part.strip() for part in body.split(";") if part.strip()]:
            member = re.search(r"\(\*(\w+)\)|(\w+)\s*(?:\[\d+\])?$", line)
            name_of_member = member[1] or member[2]
            fields.append((name_of_member, type_of(line.replace(name_of_member, "", 1) if member[1] else
                                                   re.sub(r"\w+(\s*(\[\d+\])?)$", r"\1", line), found)))
        found[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
    return found


def places(struct):
    """Returns name, offset and size of each member."""
    return [(name, getattr(struct, name).offset, getattr(struct, name).size) for name, *_ in struct._fields_]


def values(struct):
    """Returns the members of a struct. Of pointers it says whether they are null."""
    found = [getattr(struct, name) for name, *_ in struct._fields_]
    return [value if isinstance(value, (int, float, bytes)) else bool(value) for value in found]


class LayoutTest(unittest.TestCase):
    def setUp(self):
        self.header = structs_of_header()

    def test_every_struct_of_the_header_is_known(self):
        self.assertEqual(set(self.header), set(CALLED) | set(ROWS) | UNUSED)

    def test_structs_have_the_members_of_the_header(self):
        for name, struct in CALLED.items():
            with self.subTest(name):
                self.assertEqual(places(struct), places(self.header[name]))
                self.assertEqual(ctypes.sizeof(struct), ctypes.sizeof(self.header[name]))

    def test_rows_have_the_members_of_the_header(self):
        for name, dtype in ROWS.items():
            with self.subTest(name):
                found = [(field, dtype.fields[field][1], dtype.fields[field][0].itemsize) for field in dtype.names]
                self.assertEqual(found, places(self.header[name]))
                self.assertEqual(dtype.itemsize, ctypes.sizeof(self.header[name]))
                self.assertEqual([np.dtype(member[1]).base.kind for member in self.header[name]._fields_],
                                 [dtype.fields[field][0].base.kind for field in dtype.names])

    def test_functions_are_those_of_the_header(self):
        declared = re.findall(r"GRAZE_C_API\s+([\w \*]+?)\bgraze_(\w+)\(([^;]*?)\);", header_text())
        self.assertEqual({name for _, name, _ in declared}, set(_functions.FUNCTIONS))
        for result, name, arguments in declared:
            with self.subTest(name):
                self.check_function(result, arguments, *_functions.FUNCTIONS[name])

    def check_function(self, result, arguments, known_result, known_arguments):
        given = [] if arguments.strip() in ("", "void") else arguments.split(",")
        self.assertEqual(len(given), len(known_arguments))
        for text, known in zip([result, *given], [known_result, *known_arguments]):
            if "*" in text or "[" in text:
                self.assertIn(known, (ctypes.c_void_p, ctypes.c_char_p))
            elif text.strip() == "void":
                self.assertIsNone(known)
            else:
                self.assertEqual(ctypes.sizeof(known), ctypes.sizeof(type_of(text.strip() + " ", self.header)))
                self.assertEqual(known._fields_ if hasattr(known, "_fields_") else known,
                                 CALLED[text.split()[0].removeprefix("graze_")]._fields_
                                 if text.split()[0].removeprefix("graze_") in CALLED else NUMBERS[text.split()[0]])


class LibrarySizeTest(unittest.TestCase):
    """The library itself says how large its structs are, where a caller's are larger."""

    def size_in_library(self, struct, init, use):
        larger = type("larger", (struct,), {"_fields_": [("beyond", ctypes.c_uint64)]})
        made = larger()
        init(ctypes.byref(made), ctypes.sizeof(made))
        made.beyond = 1
        with self.assertRaises(graze.Error) as caught:
            use(ctypes.byref(made))
        return int(re.search(r"here it has (\d+)", str(caught.exception))[1])

    def test_sizes_of_settings(self):
        room = ctypes.c_void_p()
        mesh = graze.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        with graze.Scene() as scene:
            uses = [
                (_structs.SceneSettings, lib.scene_settings_init,
                 lambda given: lib.scene_new(given, None, ctypes.byref(room))),
                (_structs.ObjectSettings, lib.object_settings_init,
                 lambda given: lib.scene_add(scene._pointer, mesh._pointer, given, ctypes.byref(_structs.Id()))),
                (_structs.PairRule, lib.pair_rule_init, lambda given: lib.scene_set_rule(scene._pointer, 0, 0, given)),
                (_structs.SceneCapacity, lib.scene_capacity_init,
                 lambda given: lib.scene_reserve(scene._pointer, given)),
                (_structs.QuerySettings, lib.query_settings_init,
                 lambda given: lib.query_new(mesh._pointer, mesh._pointer, given, ctypes.byref(room))),
                (_structs.RecorderSettings, lib.recorder_settings_init,
                 lambda given: lib.recorder_new_ring(scene._pointer, given, ctypes.byref(room)))]
            for struct, init, use in uses:
                with self.subTest(struct.__name__):
                    self.assertEqual(self.size_in_library(struct, init, use), ctypes.sizeof(struct))

    def test_size_of_statistics(self):
        with graze.Scene() as scene:
            report = scene.step()
        room = (ctypes.c_uint8 * 2048)(*[0xAB] * 2048)
        lib.report_statistics(report._pointer, room, len(room))
        written = len(bytes(room).rstrip(b"\xab"))
        self.assertEqual(written, rows.STATISTICS.itemsize)


class ValueTest(unittest.TestCase):
    def test_enumerators_have_the_names_of_the_library(self):
        for name in ("FeatureKind", "ContactKind", "Side", "Inside", "ImpactStatus", "PairPhase", "Motion",
                     "BindPolicy", "ArenaPolicy", "AccuracyMode", "WhenBehind", "ContactDetail", "DiagnosticKind"):
            with self.subTest(name):
                call = getattr(lib, re.sub(r"(?<!^)([A-Z])", r"_\1", name).lower() + "_name")
                enum = getattr(graze, name)
                self.assertEqual([call(value).decode().upper() for value in range(len(enum))],
                                 [enum(value).name for value in range(len(enum))])
                self.assertIsNone(call(len(enum)))

    def test_default_settings_are_those_of_the_library(self):
        scene = _convert.initial(_structs.SceneSettings, lib.scene_settings_init)
        self.assertEqual(_convert.scene_from_c(scene), settings.SceneSettings())
        made = _convert.initial(_structs.ObjectSettings, lib.object_settings_init)
        self.assertEqual(_convert.object_from_c(made), settings.ObjectSettings())
        for struct, init, given in (
                (_structs.PairRule, lib.pair_rule_init, _convert.rule_to_c(settings.PairRule())),
                (_structs.SceneCapacity, lib.scene_capacity_init, _convert.capacity_to_c(settings.SceneCapacity())),
                (_structs.QuerySettings, lib.query_settings_init, _convert.query_to_c(settings.QuerySettings())),
                (_structs.RecorderSettings, lib.recorder_settings_init,
                 _convert.recorder_to_c(settings.RecorderSettings()))):
            with self.subTest(struct.__name__):
                self.assertEqual(values(_convert.initial(struct, init)), values(given))

    def test_settings_survive_the_library(self):
        given = graze.SceneSettings(
            contact_distance=0.5, range=2.0, detail=graze.ContactDetail.NEAREST, threads=2,
            arena=graze.ArenaPolicy.CALLERS, accuracy=graze.Accuracy.within(0.25), time_budget=1000,
            work_budget=77, max_contacts=5, max_contacts_per_pair=3, region_distances=9, ways_out=True, carrying=4,
            carrying_band=0.125, sweep_tolerance=1e-3, swept_gap=0.0625)
        with graze.Scene(given) as scene:
            self.assertEqual(scene.settings, given)
        with graze.Scene(detail=graze.ContactDetail.REGIONS, accuracy=graze.Accuracy.paper([3, 2])) as scene:
            self.assertEqual(scene.settings.accuracy, graze.Accuracy.paper([3, 2]))

    def test_object_settings_survive_the_library(self):
        mesh = graze.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        given = graze.ObjectSettings(
            name="Gewebe \u00e4", motion=graze.Motion.RIGID, layer=6, collides_with=5, group=2**63, margin=0.5,
            kind=255, user_data=2**64 - 1, face_groups=(9,), hidden_groups=(1, 2), self=True, self_rings=3,
            self_at_rest=True, swept=True, queries=True, patch_radius=0.75, patch_faces=99)
        with graze.Scene() as scene:
            added = scene.add(mesh, given)
            self.assertEqual(scene.object_settings(added), given)
            self.assertEqual(scene.name(added), given.name)


if __name__ == "__main__":
    unittest.main()
