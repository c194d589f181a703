"""Settings of scenes, objects, rules, queries and recorders, as dataclasses.

The C++ structs of the same names say in full what a member means. A limit that is None is none.
"""

import math
import os
from dataclasses import dataclass, field
from typing import Optional, Sequence, Tuple, Union

from .enums import AccuracyMode, ArenaPolicy, ContactDetail, Motion, WhenBehind
from .rows import ObjectId

ALL_LAYERS = 2**32 - 1


@dataclass(frozen=True)
class Accuracy:
    """Says how exact answers are. Take `Accuracy()`, `Accuracy.within(...)` or `Accuracy.paper(...)`."""

    mode: AccuracyMode = AccuracyMode.EXACT
    tolerance: float = 0.0
    epsilon: Tuple[float, ...] = ()

    @staticmethod
    def exact() -> "Accuracy":
        """Asks for contacts, phases and distances as in real arithmetic."""
        return Accuracy()

    @staticmethod
    def within(tolerance: float) -> "Accuracy":
        """Lets the two bounds of a distance be up to `tolerance` apart where nothing touches."""
        return Accuracy(AccuracyMode.WITHIN, tolerance)

    @staticmethod
    def paper(epsilon: Sequence[float] = ()) -> "Accuracy":
        """Asks for the paper's own test, with a number for each level of regions."""
        return Accuracy(AccuracyMode.PAPER, 0.0, tuple(epsilon))


@dataclass
class SceneSettings:
    """The settings of a scene. Distances are in the caller's units, `time_budget` is in microseconds."""

    contact_distance: float = 0.0
    range: float = 0.0
    detail: ContactDetail = ContactDetail.FEATURES
    accuracy: Accuracy = field(default_factory=Accuracy)
    threads: int = 0
    arena: ArenaPolicy = ArenaPolicy.OWN
    time_budget: Optional[int] = None
    work_budget: Optional[int] = None
    max_contacts: Optional[int] = None
    max_contacts_per_pair: Optional[int] = None
    region_distances: int = 0
    ways_out: bool = False
    carrying: int = 0
    carrying_band: Optional[float] = None
    sweep_tolerance: float = 1e-6
    swept_gap: float = 0.0


@dataclass
class ObjectSettings:
    """Describes one object to `Scene.add`. Groups are numbers from 0 to 255, `face_groups` one for each face."""

    name: str = ""
    motion: Motion = Motion.DEFORMABLE
    layer: int = 1
    collides_with: int = ALL_LAYERS
    group: int = 0
    margin: float = 0.0
    kind: int = 0
    solid: bool = False
    user_data: int = 0
    face_groups: Sequence[int] = ()
    hidden_groups: Sequence[int] = ()
    self: bool = False
    self_rings: int = 1
    self_at_rest: bool = False
    swept: bool = False
    queries: bool = False
    patch_radius: float = 0.0
    patch_faces: int = 16384


@dataclass
class PairRule:
    """Gives thresholds to the pairs of two kinds of objects. What is None stays that of the scene."""

    contact_distance: Optional[float] = None
    range: Optional[float] = None
    epsilon: Sequence[float] = ()


@dataclass
class SceneCapacity:
    """Says how much room `Scene.reserve` makes ahead of time."""

    objects: int = 0
    calls_per_step: int = 0
    near_pairs: int = 0
    contacts: int = 0
    reports: int = 0
    impacts: int = 0


@dataclass
class QuerySettings:
    """The settings of a question about two surfaces without a scene."""

    contact_distance: float = 0.0
    range: float = math.inf
    detail: ContactDetail = ContactDetail.FEATURES
    accuracy: Accuracy = field(default_factory=Accuracy)
    a_is_solid: bool = False
    b_is_solid: bool = False
    ways_out: bool = False
    max_contacts: Optional[int] = None


@dataclass
class QueryFilter:
    """Says which objects a question is about that is asked of a report."""

    layer: int = ALL_LAYERS
    collides_with: int = ALL_LAYERS
    ignored: ObjectId = ObjectId()


@dataclass
class RecorderSettings:
    """The settings of a recorder. The last three count for a ring: `byte_budget` is in bytes."""

    keyframe_interval: int = 64
    waiting_frames: int = 32
    when_behind: WhenBehind = WhenBehind.DROP
    byte_budget: int = 256 << 20
    frames: Optional[int] = None
    on_diagnostic: Optional[Union[str, "os.PathLike[str]"]] = None
