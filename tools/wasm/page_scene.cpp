#include "page_scene.hpp"

#include <chrono>
#include <cmath>
#include <concepts>
#include <graze/error.hpp>
#include <graze/scene_enumerators.hpp>
#include <graze/settings_fields.hpp>

#include "page/report_table.hpp"
#include "report/report_fields.hpp"

namespace graze::wasm {
namespace {

// Each of these takes a number for a member of one type, and returns whether members of the type are numbers.

bool take(bool& member, double value) {
  member = value != 0;
  return true;
}
bool take(std::floating_point auto& member, double value) {
  member = value;
  return true;
}
template <std::unsigned_integral Whole>
requires(!std::same_as<Whole, bool>) bool take(Whole& member, double value) {
  member = static_cast<Whole>(value);
  return true;
}
bool take(std::chrono::microseconds& member, double value) {
  member = std::chrono::microseconds(static_cast<std::int64_t>(value));
  return true;
}
template <typename Value>
bool take(std::optional<Value>& member, double value) {
  return take(member.emplace(), value);
}
template <typename Other>
bool take(Other& /*member*/, double /*value*/) {
  return false;
}

bool take_word(NamedEnumeration auto& member, std::string_view word) {
  const auto found = enumerator_named<std::remove_reference_t<decltype(member)>>(word);
  if (found) member = *found;
  return found.has_value();
}
template <typename Other>
bool take_word(Other& /*member*/, std::string_view /*word*/) {
  return false;
}

PositionView view_of(std::span<const double> coordinates) {
  return PositionView(coordinates.data(), coordinates.size() / 3);
}

std::vector<std::uint8_t> bytes_of(std::span<const std::uint32_t> numbers) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t number : numbers) bytes.push_back(static_cast<std::uint8_t>(number));
  return bytes;
}

}  // namespace

bool PageScene::set_number(std::string_view key, double value) {
  bool is_taken = false;
  io::for_each_reported_setting([&](const auto& field) {
    if (io::key_of(field) == key) is_taken = take(settings_.*field.member, value);
  });
  return is_taken;
}

bool PageScene::set_word(std::string_view key, std::string_view word) {
  bool is_taken = false;
  io::for_each_reported_setting([&](const auto& field) {
    if (io::key_of(field) == key) is_taken = take_word(settings_.*field.member, word);
  });
  return is_taken;
}

std::uint32_t PageScene::add_mesh(std::span<const double> rest, std::span<const std::uint32_t> corners,
                                  std::span<const std::uint32_t> corner_counts) {
  meshes_.push_back(std::make_shared<const Mesh>(Mesh::from_polygons(view_of(rest), corners, corner_counts)));
  return static_cast<std::uint32_t>(meshes_.size() - 1);
}

bool PageScene::set_object_number(std::string_view name, double value) {
  bool is_taken = false;
  for_each_field<ObjectSettings>([&](const auto& field) {
    if (field.name == name) is_taken = take(object_settings_.*field.member, value);
  });
  return is_taken;
}

void PageScene::set_face_groups(std::span<const std::uint32_t> groups) {
  object_settings_.face_groups = bytes_of(groups);
}

void PageScene::set_hidden_groups(std::span<const std::uint32_t> groups) {
  object_settings_.hidden_groups = bytes_of(groups);
}

void PageScene::add_object(std::uint32_t page_index, std::uint32_t mesh, Motion motion) {
  object_settings_.motion = motion;
  const ObjectId id = scene().add(meshes_.at(mesh), std::exchange(object_settings_, {}));
  ids_[page_index] = id;
  page_index_of_[id] = page_index;
}

void PageScene::set_positions(std::uint32_t page_index, std::span<const double> positions) {
  scene().set_positions(id_of(page_index), view_of(positions));
}

void PageScene::set_pose(std::uint32_t page_index, const std::array<double, 12>& rows) {
  scene().set_pose_rows(id_of(page_index), rows);
}

void PageScene::ignore(std::uint32_t a, std::uint32_t b) {
  scene().ignore(id_of(a), id_of(b));
}

void PageScene::ignore(std::uint32_t a, std::uint8_t group_a, std::uint32_t b, std::uint8_t group_b) {
  scene().ignore(id_of(a), group_a, id_of(b), group_b);
}

void PageScene::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, double contact_distance, double range,
                         std::span<const double> epsilon) {
  PairRule rule;
  if (!std::isnan(contact_distance)) rule.contact_distance = contact_distance;
  if (!std::isnan(range)) rule.range = range;
  rule.epsilon.assign(epsilon.begin(), epsilon.end());
  scene().set_rule(kind_a, kind_b, rule);
}

const std::string& PageScene::step(std::uint64_t page_frame, std::uint64_t number) {
  const ReportHandle report = scene().step();
  io::ReportBlock block;
  const auto index_of = [&](ObjectId id) -> std::optional<std::uint32_t> {
    const auto found = page_index_of_.find(id);
    return found == page_index_of_.end() ? std::nullopt : std::optional(found->second);
  };
  block.add(page_frame, number, *report, index_of, true);
  return table_ = block.table();
}

Scene& PageScene::scene() {
  if (!scene_) scene_ = std::make_unique<Scene>(settings_);
  return *scene_;
}

ObjectId PageScene::id_of(std::uint32_t page_index) const {
  const auto found = ids_.find(page_index);
  if (found == ids_.end())
    throw Error("the scene has no object " + std::to_string(page_index) + " of the page");
  return found->second;
}

}  // namespace graze::wasm
