"""The enumerations. Their values are those of the C interface, so they compare with fields of arrays."""

from enum import IntEnum


class FeatureKind(IntEnum):
    """The kinds of features of a mesh. The value is its dimension."""

    VERTEX = 0
    EDGE = 1
    FACE = 2


class ContactKind(IntEnum):
    """Says in whose insides the two points of a contact lie: vertices, edges or faces."""

    VV = 0
    VE = 1
    VF = 2
    EE = 3
    EF = 4
    FF = 5


class Side(IntEnum):
    """Says on which side of a surface a point lies."""

    NONE = 0
    FRONT = 1
    BACK = 2


class Inside(IntEnum):
    """Says whether one object of a pair is inside the other, where one of them is a solid."""

    NONE = 0
    A_IN_B = 1
    B_IN_A = 2
    CROSSING = 3


class ImpactStatus(IntEnum):
    """Says how certain it is that two features meet between two steps."""

    CERTAIN = 0
    POSSIBLE = 1
    AT_START = 2


class PairPhase(IntEnum):
    """Says whether a pair is in contact now, and whether it was in the report before."""

    NEAR = 0
    BEGAN = 1
    TOUCHING = 2
    ENDED = 3


class Motion(IntEnum):
    """Says how an object may move. Pairs of two fixed objects are never tested."""

    DEFORMABLE = 0
    RIGID = 1
    FIXED = 2


class BindPolicy(IntEnum):
    """Says when steps read bound memory: always, or after `Scene.positions_changed`."""

    EVERY_STEP = 0
    WHEN_TOLD = 1


class ArenaPolicy(IntEnum):
    """Says in which arena of oneTBB a step runs: the scene's own, or that of the calling thread."""

    OWN = 0
    CALLERS = 1


class AccuracyMode(IntEnum):
    """The three ways to be exact, see `Accuracy`."""

    EXACT = 0
    WITHIN = 1
    PAPER = 2


class WhenBehind(IntEnum):
    """Says what a step does while all frames of its recorder wait: drop its frame, or wait."""

    DROP = 0
    WAIT = 1


class ContactDetail(IntEnum):
    """Says what a report lists of each pair in contact. docs/choosing.md compares the details."""

    NONE = 0
    CLOSEST = 1
    REGIONS = 2
    VERTICES = 3
    FEATURES = 4
    NEAREST = 5


class DiagnosticKind(IntEnum):
    """The kinds of bad input that a step reports."""

    STALE_ID = 0
    WRONG_COUNT = 1
    NULL_MEMORY = 2
    MISALIGNED_MEMORY = 3
    WRONG_MOTION = 4
    BAD_POSE = 5
    NOT_FINITE = 6
    TOO_LARGE = 7
    BROKEN_PROMISE = 8
    BAD_PAIR = 9
    BAD_RULE = 10
    OUT_OF_MEMORY = 11
