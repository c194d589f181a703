#include "step/call_applier.hpp"

#include <utility>

namespace graze {

void CallApplier::operator()(Diagnostic& diagnostic) {
  diagnostics_.push_back(std::move(diagnostic));
}

// ---- Filters

void CallApplier::operator()(SetRule& call) {
  filter_.set_rule(call.kind_a, call.kind_b, std::move(call.rule));
  concerns_pairs_ = true;
}

void CallApplier::operator()(IgnorePair& call) {
  concerns_pairs_ = true;
  Object* const a = store_.find(call.a);
  Object* const b = store_.find(call.b);
  if (a != nullptr && b != nullptr) filter_.set_ignored(*a, *b, call.ignored);
}

void CallApplier::operator()(IgnoreGroups& call) {
  concerns_pairs_ = true;
  const Object* const a = store_.find(call.a);
  const Object* const b = store_.find(call.b);
  if (a != nullptr && b != nullptr) filter_.set_ignored(*a, call.group_a, *b, call.group_b, call.ignored);
}

// ---- Objects

void CallApplier::operator()(AddObject& call) {
  if (reserve_.is_for_pairs()) reserve_.prepare_surface(*call.surface, call.settings);
  store_.apply(call);
}

void CallApplier::operator()(RemoveObject& call) {
  if (Object* const object = store_.find(call.object)) filter_.forget(*object);
  store_.apply(call);
}

void CallApplier::operator()(ReplaceMesh& call) {
  const Object* const object = store_.find(call.object);
  if (object != nullptr) {
    if (reserve_.is_for_pairs()) reserve_.prepare_surface(*call.surface, object->settings);
    filter_.regroup(*object, call.face_groups);
  }
  store_.apply(call);
}

void CallApplier::operator()(RefusePose& call) {
  diagnostics_.push_back(call.problem);
  store_.apply(call);
}

void CallApplier::operator()(BindPositions& call) {
  store_.apply(call);
  Object* const object = store_.find(call.object);
  if (reserve_.is_for_pairs() && object != nullptr) reserve_.prepare_copy(*object);
}

void CallApplier::operator()(UnbindPositions& call) {
  store_.apply(call, diagnostics_);
}

// ---- Memory

/// A step that repeats rows would not count what is made room for.
void CallApplier::operator()(Reserve& call) {
  concerns_pairs_ = true;
  // If there is no memory for it, it is not tried again: the scene does without it.
  reserve_.reserve(std::exchange(call.capacity, {}));
}

}  // namespace graze
