#include <graze/graze.h>

#include <graze/enumerators.hpp>
#include <graze/recorder.hpp>
#include <graze/scene_enumerators.hpp>

// The names of enumerators. What name_of() returns is a literal, so that a 0 follows it. Its data is null for
// a value without a name.

namespace {

template <typename Enum>
const char* name_or_null(uint8_t value) {
  return name_of(static_cast<Enum>(value)).data();
}

}  // namespace

extern "C" {

const char* graze_feature_kind_name(uint8_t kind) {
  return name_or_null<graze::FeatureKind>(kind);
}
const char* graze_contact_kind_name(uint8_t kind) {
  return name_or_null<graze::ContactKind>(kind);
}
const char* graze_side_name(uint8_t side) {
  return name_or_null<graze::Side>(side);
}
const char* graze_inside_name(uint8_t inside) {
  return name_or_null<graze::Inside>(inside);
}
const char* graze_impact_status_name(uint8_t status) {
  return name_or_null<graze::ImpactStatus>(status);
}
const char* graze_pair_phase_name(uint8_t phase) {
  return name_or_null<graze::PairPhase>(phase);
}
const char* graze_motion_name(uint8_t motion) {
  return name_or_null<graze::Motion>(motion);
}
const char* graze_bind_policy_name(uint8_t policy) {
  return name_or_null<graze::BindPolicy>(policy);
}
const char* graze_arena_policy_name(uint8_t policy) {
  return name_or_null<graze::ArenaPolicy>(policy);
}
const char* graze_accuracy_mode_name(uint8_t mode) {
  return name_or_null<graze::AccuracyMode>(mode);
}
const char* graze_when_behind_name(uint8_t when) {
  return name_or_null<graze::WhenBehind>(when);
}
const char* graze_contact_detail_name(uint8_t detail) {
  return name_or_null<graze::ContactDetail>(detail);
}
const char* graze_diagnostic_kind_name(uint8_t kind) {
  return name_or_null<graze::DiagnosticKind>(kind);
}

}  // extern "C"
