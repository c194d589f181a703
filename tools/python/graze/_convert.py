"""Settings as structs of the library, and the other way round."""

import ctypes
import os
from typing import Any, Optional, Sequence, Tuple

from . import _structs, settings
from ._library import lib
from ._memory import NO_LIMIT, unsigned
from .enums import AccuracyMode, ArenaPolicy, ContactDetail, Motion, WhenBehind
from .errors import Error
from .rows import object_id


def initial(struct: Any, init: Any) -> Any:
    """Returns a struct with the defaults of the library."""
    made = struct()
    init(ctypes.byref(made), ctypes.sizeof(made))
    return made


def empty(struct: Any) -> Any:
    """Returns a struct for a function that fills as much of it as its size says."""
    return struct(struct_size=ctypes.sizeof(struct))


def limit_to_c(value: Optional[int], name: str) -> int:
    if value is None:
        return NO_LIMIT
    number = unsigned(value, 64, name)
    if number == NO_LIMIT:
        raise Error(f"{name} is {number}; None stands for no limit")
    return number


def limit_from_c(value: int) -> Optional[int]:
    return None if value == NO_LIMIT else int(value)


def text_to_c(text: str, name: str) -> bytes:
    if "\0" in text:
        raise Error(f"{name} has a character 0")
    return text.encode()


def path_to_c(path: Any) -> bytes:
    encoded = os.fsencode(path)
    if b"\0" in encoded:
        raise Error("the path has a character 0")
    return encoded


def set_numbers(made: Any, member: str, count_member: str, numbers: Sequence[float]) -> None:
    """Points a member of a struct at a copy of numbers, which the struct keeps."""
    values = list(numbers)
    setattr(made, count_member, len(values))
    if values:
        setattr(made, member, (ctypes.c_double * len(values))(*values))


def set_groups(made: Any, member: str, count_member: str, groups: Sequence[int]) -> None:
    values = group_bytes(groups, member)
    setattr(made, count_member, len(values))
    if values:
        setattr(made, member, (ctypes.c_uint8 * len(values)).from_buffer_copy(values))


def group_bytes(groups: Sequence[int], name: str) -> bytes:
    """Returns groups of faces as bytes, checked."""
    try:
        return bytes(groups if isinstance(groups, bytes) else [unsigned(group, 8, name) for group in groups])
    except TypeError:
        raise Error(f"{name} is no sequence of numbers") from None


def set_accuracy(made: Any, accuracy: settings.Accuracy) -> None:
    made.accuracy = AccuracyMode(accuracy.mode)
    made.tolerance = accuracy.tolerance
    set_numbers(made, "epsilon", "epsilon_count", accuracy.epsilon)


def accuracy_of(read: Any) -> settings.Accuracy:
    return settings.Accuracy(AccuracyMode(read.accuracy), read.tolerance, numbers_of(read))


def numbers_of(read: Any) -> Tuple[float, ...]:
    return tuple(read.epsilon[i] for i in range(read.epsilon_count))


def scene_to_c(given: settings.SceneSettings) -> _structs.SceneSettings:
    made: _structs.SceneSettings = initial(_structs.SceneSettings, lib.scene_settings_init)
    made.contact_distance = given.contact_distance
    made.range = given.range
    made.detail = ContactDetail(given.detail)
    set_accuracy(made, given.accuracy)
    made.arena = ArenaPolicy(given.arena)
    made.ways_out = given.ways_out
    made.threads = unsigned(given.threads, 32, "threads")
    for name in ("time_budget", "work_budget", "max_contacts", "max_contacts_per_pair"):
        setattr(made, name, limit_to_c(getattr(given, name), name))
    made.region_distances = unsigned(given.region_distances, 64, "region_distances")
    made.carrying = unsigned(given.carrying, 64, "carrying")
    made.has_carrying_band = given.carrying_band is not None
    made.carrying_band = given.carrying_band or 0.0
    made.sweep_tolerance = given.sweep_tolerance
    made.swept_gap = given.swept_gap
    return made


def scene_from_c(read: _structs.SceneSettings) -> settings.SceneSettings:
    return settings.SceneSettings(
        contact_distance=read.contact_distance, range=read.range, detail=ContactDetail(read.detail),
        accuracy=accuracy_of(read), threads=read.threads, arena=ArenaPolicy(read.arena),
        time_budget=limit_from_c(read.time_budget), work_budget=limit_from_c(read.work_budget),
        max_contacts=limit_from_c(read.max_contacts), max_contacts_per_pair=limit_from_c(read.max_contacts_per_pair),
        region_distances=read.region_distances, ways_out=read.ways_out, carrying=read.carrying,
        carrying_band=read.carrying_band if read.has_carrying_band else None,
        sweep_tolerance=read.sweep_tolerance, swept_gap=read.swept_gap)


def object_to_c(given: settings.ObjectSettings) -> _structs.ObjectSettings:
    made: _structs.ObjectSettings = initial(_structs.ObjectSettings, lib.object_settings_init)
    made.name = text_to_c(given.name, "the name")
    made.motion = Motion(given.motion)
    for name in ("solid", "self", "self_at_rest", "swept", "queries", "margin", "patch_radius"):
        setattr(made, name, getattr(given, name))
    for name in ("layer", "collides_with", "kind", "self_rings", "patch_faces"):
        setattr(made, name, unsigned(getattr(given, name), 32, name))
    for name in ("group", "user_data"):
        setattr(made, name, unsigned(getattr(given, name), 64, name))
    set_groups(made, "face_groups", "face_group_count", given.face_groups)
    set_groups(made, "hidden_groups", "hidden_group_count", given.hidden_groups)
    return made


def object_from_c(read: _structs.ObjectSettings) -> settings.ObjectSettings:
    return settings.ObjectSettings(
        name=read.name.decode("utf-8", "replace") if read.name else "", motion=Motion(read.motion), layer=read.layer,
        collides_with=read.collides_with, group=read.group, margin=read.margin, kind=read.kind, solid=read.solid,
        user_data=read.user_data, face_groups=tuple(read.face_groups[:read.face_group_count]),
        hidden_groups=tuple(read.hidden_groups[:read.hidden_group_count]), self=read.self,
        self_rings=read.self_rings, self_at_rest=read.self_at_rest, swept=read.swept, queries=read.queries,
        patch_radius=read.patch_radius, patch_faces=read.patch_faces)


def rule_to_c(given: settings.PairRule) -> _structs.PairRule:
    made: _structs.PairRule = initial(_structs.PairRule, lib.pair_rule_init)
    for name in ("contact_distance", "range"):
        value = getattr(given, name)
        setattr(made, "has_" + name, value is not None)
        setattr(made, name, value or 0.0)
    set_numbers(made, "epsilon", "epsilon_count", given.epsilon)
    return made


def capacity_to_c(given: settings.SceneCapacity) -> _structs.SceneCapacity:
    made: _structs.SceneCapacity = initial(_structs.SceneCapacity, lib.scene_capacity_init)
    for name in ("objects", "calls_per_step", "near_pairs", "contacts", "reports", "impacts"):
        setattr(made, name, unsigned(getattr(given, name), 64, name))
    return made


def query_to_c(given: settings.QuerySettings) -> _structs.QuerySettings:
    made: _structs.QuerySettings = initial(_structs.QuerySettings, lib.query_settings_init)
    for name in ("contact_distance", "range", "a_is_solid", "b_is_solid", "ways_out"):
        setattr(made, name, getattr(given, name))
    made.detail = ContactDetail(given.detail)
    set_accuracy(made, given.accuracy)
    made.max_contacts = limit_to_c(given.max_contacts, "max_contacts")
    return made


def filter_to_c(given: Optional[settings.QueryFilter]) -> Any:
    """Returns what a function takes for a filter: None leaves out nothing."""
    if given is None:
        return None
    return ctypes.byref(_structs.QueryFilter(
        unsigned(given.layer, 32, "layer"), unsigned(given.collides_with, 32, "collides_with"), id_to_c(given.ignored)))


def recorder_to_c(given: settings.RecorderSettings) -> _structs.RecorderSettings:
    made: _structs.RecorderSettings = initial(_structs.RecorderSettings, lib.recorder_settings_init)
    made.keyframe_interval = unsigned(given.keyframe_interval, 32, "keyframe_interval")
    made.waiting_frames = unsigned(given.waiting_frames, 32, "waiting_frames")
    made.when_behind = WhenBehind(given.when_behind)
    made.byte_budget = unsigned(given.byte_budget, 64, "byte_budget")
    made.frames = limit_to_c(given.frames, "frames")
    if given.on_diagnostic is not None:
        made.on_diagnostic = path_to_c(given.on_diagnostic)
    return made


def id_to_c(value: Any) -> _structs.Id:
    index, generation = object_id(value)
    return _structs.Id(unsigned(index, 32, "the index of an id"), unsigned(generation, 32, "the generation of an id"))


def feature_to_c(value: Any) -> _structs.Feature:
    kind, index = value.item() if hasattr(value, "item") else value
    return _structs.Feature(unsigned(kind, 8, "the kind of a feature"), unsigned(index, 32, "the index of a feature"))
