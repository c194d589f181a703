"""The structs of graze.h that are passed one at a time. Rows of arrays are in `rows`."""

import ctypes
from ctypes import POINTER, c_bool, c_char_p, c_double, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p


class Id(ctypes.Structure):
    _fields_ = [("index", c_uint32), ("generation", c_uint32)]


class Feature(ctypes.Structure):
    _fields_ = [("kind", c_uint8), ("index", c_uint32)]


class Bounds(ctypes.Structure):
    _fields_ = [("lower", c_double), ("upper", c_double)]


class Witness(ctypes.Structure):
    _fields_ = [("feature_a", Feature), ("feature_b", Feature), ("point_a", c_double * 3), ("point_b", c_double * 3)]


class WayOut(ctypes.Structure):
    _fields_ = [("direction", c_double * 3), ("point", c_double * 3), ("fullness", c_double),
                ("thickness", c_double), ("extent", c_double)]


class Diagnostic(ctypes.Structure):
    _fields_ = [("object", Id), ("kind", c_uint8), ("message", c_char_p)]


class Positions(ctypes.Structure):
    _fields_ = [("first", c_void_p), ("count", c_size_t), ("stride_bytes", c_size_t),
                ("coordinate_stride_bytes", c_size_t), ("is_double", c_bool)]


class SceneSettings(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("contact_distance", c_double), ("range", c_double), ("detail", c_uint8),
        ("accuracy", c_uint8), ("arena", c_uint8), ("ways_out", c_bool), ("has_carrying_band", c_bool),
        ("threads", c_uint32), ("tolerance", c_double), ("epsilon", POINTER(c_double)), ("epsilon_count", c_size_t),
        ("time_budget", c_uint64), ("work_budget", c_uint64), ("max_contacts", c_uint64),
        ("max_contacts_per_pair", c_uint64), ("region_distances", c_size_t), ("carrying", c_size_t),
        ("carrying_band", c_double), ("sweep_tolerance", c_double), ("swept_gap", c_double)]


class ObjectSettings(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("name", c_char_p), ("motion", c_uint8), ("solid", c_bool), ("self", c_bool),
        ("self_at_rest", c_bool), ("swept", c_bool), ("queries", c_bool), ("layer", c_uint32),
        ("collides_with", c_uint32), ("kind", c_uint32), ("self_rings", c_uint32), ("group", c_uint64),
        ("margin", c_double), ("user_data", c_uint64), ("face_groups", POINTER(c_uint8)),
        ("face_group_count", c_size_t), ("hidden_groups", POINTER(c_uint8)), ("hidden_group_count", c_size_t),
        ("patch_radius", c_double), ("patch_faces", c_uint32)]


class PairRule(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("has_contact_distance", c_bool), ("has_range", c_bool),
                ("contact_distance", c_double), ("range", c_double), ("epsilon", POINTER(c_double)),
                ("epsilon_count", c_size_t)]


class SceneCapacity(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("objects", c_size_t), ("calls_per_step", c_size_t),
                ("near_pairs", c_size_t), ("contacts", c_size_t), ("reports", c_size_t), ("impacts", c_size_t)]


class QuerySettings(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("contact_distance", c_double), ("range", c_double), ("detail", c_uint8),
        ("accuracy", c_uint8), ("a_is_solid", c_bool), ("b_is_solid", c_bool), ("ways_out", c_bool),
        ("tolerance", c_double), ("epsilon", POINTER(c_double)), ("epsilon_count", c_size_t),
        ("max_contacts", c_uint64)]


class QueryResult(ctypes.Structure):
    _fields_ = [("in_contact", c_bool), ("is_in_range", c_bool), ("contacts_cut", c_bool), ("inside", c_uint8),
                ("distance", Bounds), ("witness", Witness), ("way_out", WayOut), ("contacts", c_void_p),
                ("contact_count", c_size_t)]


class QueryFilter(ctypes.Structure):
    _fields_ = [("layer", c_uint32), ("collides_with", c_uint32), ("ignored", Id)]


class RecorderSettings(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("keyframe_interval", c_uint32), ("waiting_frames", c_uint32),
                ("when_behind", c_uint8), ("byte_budget", c_size_t), ("frames", c_uint64),
                ("on_diagnostic", c_char_p)]


class RecorderStatistics(ctypes.Structure):
    _fields_ = [("frames", c_uint64), ("dropped", c_uint64), ("bytes", c_uint64)]


class RecordedFrame(ctypes.Structure):
    _fields_ = [("frame", c_uint64), ("tag", c_uint64), ("pairs", c_size_t), ("pairs_in_contact", c_size_t),
                ("contacts", c_uint64), ("diagnostics", c_uint64), ("dropped_before", c_uint64),
                ("has_keyframe", c_bool), ("complete", c_bool), ("step_ms", c_double)]


class ReplayDifference(ctypes.Structure):
    _fields_ = [("frame", c_uint64), ("pair", c_char_p), ("recorded", c_char_p), ("replayed", c_char_p)]


class Patch(ctypes.Structure):
    _fields_ = [("exists", c_bool), ("is_cut", c_bool), ("radius", c_double), ("face_count", c_size_t),
                ("objects", c_void_p), ("object_count", c_size_t)]


class PatchAnswer(ctypes.Structure):
    _fields_ = [("complete", c_bool), ("threshold", c_double), ("validity", c_double)]
