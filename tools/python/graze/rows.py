"""The numpy types of rows, as they lie in the library's memory. A test compares them with graze.h."""

from typing import Any, List, NamedTuple

import numpy as np

from .enums import FeatureKind


class ObjectId(NamedTuple):
    """Names an object of a scene. It is equal to its pair of numbers, such as `tuple(pair["a"])`."""

    index: int = 0  # type: ignore[assignment]
    generation: int = 0


class Feature(NamedTuple):
    """Names one vertex, edge or face of a mesh."""

    kind: FeatureKind
    index: int  # type: ignore[assignment]


def _struct(fields: List[Any]) -> "np.dtype[Any]":
    return np.dtype(fields, align=True)


_POINT = (np.float64, (3,))

ID = _struct([("index", np.uint32), ("generation", np.uint32)])
FEATURE = _struct([("kind", np.uint8), ("index", np.uint32)])
CONTACT = _struct([
    ("kind", np.uint8), ("side_a", np.uint8), ("side_b", np.uint8), ("sunk", np.bool_), ("feature_a", FEATURE),
    ("feature_b", FEATURE), ("point_a", *_POINT), ("point_b", *_POINT), ("normal", *_POINT),
    ("distance", np.float64), ("since", np.uint64)])
BOUNDS = _struct([("lower", np.float64), ("upper", np.float64)])
WITNESS = _struct([("feature_a", FEATURE), ("feature_b", FEATURE), ("point_a", *_POINT), ("point_b", *_POINT)])
WAY_OUT = _struct([("direction", *_POINT), ("point", *_POINT), ("fullness", np.float64),
                   ("thickness", np.float64), ("extent", np.float64)])
PAIR = _struct([
    ("a", ID), ("b", ID), ("user_data_a", np.uint64), ("user_data_b", np.uint64), ("phase", np.uint8),
    ("complete", np.bool_), ("stale", np.bool_), ("contacts_cut", np.bool_), ("inside", np.uint8),
    ("distance", BOUNDS), ("witness", WITNESS), ("first_contact", np.uintp), ("contact_count", np.uintp),
    ("first_region_distance", np.uintp), ("region_distance_count", np.uintp), ("way_out", WAY_OUT),
    ("time_of_impact", np.float64), ("time_of_gap", np.float64), ("first_impact", np.uintp),
    ("impact_count", np.uintp)])
REGION_DISTANCE = _struct([
    ("level", np.uint32), ("region_a", np.uint32), ("region_b", np.uint32), ("vertex_a", np.uint32),
    ("vertex_b", np.uint32), ("point_a", *_POINT), ("point_b", *_POINT), ("distance", np.float64)])
IMPACT = _struct([
    ("kind", np.uint8), ("feature_a", FEATURE), ("feature_b", FEATURE), ("lower", np.float64),
    ("upper", np.float64), ("status", np.uint8)])
CONTACT_GEOMETRY = _struct([
    ("point_a", *_POINT), ("point_b", *_POINT), ("normal", *_POINT), ("push", *_POINT), ("distance", np.float64),
    ("separation", np.float64), ("side_a", np.uint8), ("side_b", np.uint8), ("sunk", np.bool_),
    ("is_interior", np.bool_)])
FOLLOWED_CONTACT = _struct([
    ("feature_a", FEATURE), ("feature_b", FEATURE), ("geometry", CONTACT_GEOMETRY), ("is_known", np.bool_),
    ("steps", np.uint32)])
WEIGHTS = _struct([("count", np.int32), ("vertex", np.uint32, (4,)), ("weight", np.float64, (4,))])
PATCH_PAIR = _struct([
    ("a", ID), ("b", ID), ("inside", np.uint8), ("first_contact", np.uintp), ("contact_count", np.uintp)])
RAY_HIT = _struct([
    ("object", ID), ("t", np.float64), ("point", *_POINT), ("normal", *_POINT), ("feature", FEATURE),
    ("face", np.uint32), ("triangle", np.uint8)])
SPHERE_HIT = _struct([
    ("object", ID), ("t", np.float64), ("centre", *_POINT), ("point", *_POINT), ("normal", *_POINT),
    ("feature", FEATURE)])
CLOSEST_POINT = _struct([
    ("object", ID), ("distance", np.float64), ("point", *_POINT), ("normal", *_POINT), ("feature", FEATURE),
    ("side", np.uint8)])
STATISTICS = _struct([
    *((name, np.uint64) for name in (
        "objects", "objects_unread", "objects_surveyed", "pairs_total", "objects_in_slack", "pairs_close",
        "pairs_filtered", "pairs_fixed", "pairs_by_layer", "pairs_in_group", "pairs_ignored", "pairs_apart",
        "pairs_unchanged", "pairs_tested", "pairs_by_list", "pairs_near", "pairs_in_contact", "contacts", "pairs_cut",
        "contacts_left_out", "region_distances", "region_distances_left_out", "pairs_swept", "impacts",
        "boxes_tested", "region_pairs_tested", "leaf_pairs_tested", "discarded_in_float", "named_in_float",
        "decided_in_double", "exact_decisions", "fronts_left_out")),
    ("regions_expanded", np.uint64, (41,)),
    *((name, np.uint64) for name in (
        "swept_region_pairs", "swept_feature_pairs", "swept_exact_decisions", "object_bytes", "pair_bytes",
        "report_bytes", "thread_bytes")),
    *((name, np.float64) for name in ("read_ms", "pairs_ms", "refit_ms", "jobs_ms", "publish_ms", "step_ms"))])


def object_id(value: Any) -> ObjectId:
    """Returns an id of a field such as `pair["a"]`, or of two numbers."""
    index, generation = value.item() if isinstance(value, np.void) else value
    return ObjectId(int(index), int(generation))


def feature(value: Any) -> Feature:
    """Returns a feature of a field such as `contact["feature_a"]`, or of a kind and an index."""
    kind, index = value.item() if isinstance(value, np.void) else value
    return Feature(FeatureKind(int(kind)), int(index))
