"""Finds where surfaces touch, or are about to: the library graze, from Python.

A `Scene` holds objects with a `Mesh` each. A step answers for all pairs of them with a `Report`, whose rows are numpy
arrays over the library's own memory. docs/python.md has a program and the rules.
"""

from ._library import instruction_set, library_version, max_threads, use_instruction_set
from ._version import __version__
from .collision import CollisionManager, ContactData, DistanceData
from .enums import (AccuracyMode, ArenaPolicy, BindPolicy, ContactDetail, ContactKind, DiagnosticKind, FeatureKind,
                    ImpactStatus, Inside, Motion, PairPhase, Side, WhenBehind)
from .errors import Error
from .mesh import Mesh, MeshOddities
from .patch import Patch, PatchAnswer
from .query import QueryResult, RepeatedQuery, query
from .recorder import Recorder, RecorderStatistics
from .recording import RecordedFrame, Recording, Replay, ReplayDifference, ReplayObject
from .report import Diagnostic, Report
from .response import (
    SurfaceWeights, evaluate, evaluate_features, follow, in_normal_cone, pushes, separations, weights)
from .rows import (CLOSEST_POINT, CONTACT, CONTACT_GEOMETRY, FEATURE, FOLLOWED_CONTACT, ID, IMPACT, PAIR, PATCH_PAIR,
                   RAY_HIT, REGION_DISTANCE, SPHERE_HIT, STATISTICS, WAY_OUT, WITNESS, Feature, ObjectId)
from .scene import Scene
from .scene_query import MeshProbe, SceneQuery
from .settings import (Accuracy, ObjectSettings, PairRule, QueryFilter, QuerySettings, RecorderSettings, SceneCapacity,
                       SceneSettings)

__all__ = [
    "Accuracy", "AccuracyMode", "ArenaPolicy", "BindPolicy", "CLOSEST_POINT", "CONTACT", "CONTACT_GEOMETRY",
    "CollisionManager", "ContactData", "ContactDetail", "ContactKind", "Diagnostic", "DiagnosticKind",
    "DistanceData", "Error", "FEATURE", "FOLLOWED_CONTACT", "Feature", "FeatureKind", "ID", "IMPACT",
    "ImpactStatus", "Inside", "Mesh", "MeshOddities", "MeshProbe", "Motion", "ObjectId", "ObjectSettings", "PAIR",
    "PATCH_PAIR", "PairPhase", "PairRule", "Patch", "PatchAnswer", "QueryFilter", "QueryResult", "QuerySettings", "RAY_HIT", "REGION_DISTANCE",
    "RecordedFrame", "Recorder", "RecorderSettings", "RecorderStatistics", "Recording", "RepeatedQuery", "Replay",
    "ReplayDifference", "ReplayObject", "Report", "SPHERE_HIT", "STATISTICS", "Scene", "SceneCapacity",
    "SceneQuery", "SceneSettings", "Side", "SurfaceWeights", "WAY_OUT", "WITNESS", "WhenBehind", "__version__",
    "evaluate", "evaluate_features", "follow", "in_normal_cone", "instruction_set", "library_version",
    "max_threads", "pushes", "query", "separations", "use_instruction_set", "weights"]
