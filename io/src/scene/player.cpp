#include <algorithm>
#include <array>
#include <graze/error.hpp>
#include <graze/io/error.hpp>
#include <graze/io/player.hpp>
#include <graze/settings_fields.hpp>
#include <unordered_map>
#include <unordered_set>

#include "scene/scene_loading.hpp"
#include "text/opened_files.hpp"
#include "text/out_of_memory.hpp"

namespace graze::io {
namespace {

/// One object's motion: at most one of source and keys.
struct Playback {
  std::unique_ptr<PositionSource> source;
  std::vector<KeyPose> keys;
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< of every frame of `source`
  bool is_deformable = false;
  std::size_t said = 0;                    ///< warnings of `source` that were taken over
  std::vector<Eigen::Vector3d> positions;  ///< of a source: bound to the scene
  const Eigen::Vector3d* bound = nullptr;  ///< what the scene was last told to read
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

std::uint32_t longest_motion(const std::vector<Playback>& playbacks) {
  std::uint32_t frames = 1;
  for (const Playback& playback : playbacks) {
    if (playback.source) frames = std::max(frames, playback.source->frame_count());
    if (!playback.keys.empty()) frames = std::max(frames, playback.keys.back().frame + 1);
  }
  return frames;
}

/// Puts the objects of an entry that is ignored with itself into a group of their own, since n objects have
/// n² pairs. The scene file's own groups are smaller numbers. Where the entry has a group nothing is missing.
void group_ignored(LoadedScene& loaded, const SceneDescription& description) {
  constexpr std::uint64_t first_free_group = std::uint64_t{1} << 32U;
  std::unordered_set<std::string> names;
  for (const IgnoreDescription& ignored : description.ignore)
    if (!ignored.groups && ignored.names[0] == ignored.names[1]) names.insert(ignored.names[0]);
  for (LoadedSceneObject& object : loaded.objects)
    if (object.settings.group == 0 && names.contains(description.objects[object.entry].settings.name))
      object.settings.group = first_free_group + object.entry;
}

Scene make_scene(const SceneDescription& description) {
  try {
    return Scene(description.settings);
  } catch (const Error& error) {
    throw InputError(description.file + ": " + error.what());
  }
}

void read_frame(Playback& playback, std::uint32_t frame, const SceneObject& object) {
  try {
    playback.source->read(std::min(frame, playback.source->frame_count() - 1), playback.positions);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + " (object \"" + object.name + "\", frame " +
                     std::to_string(frame) + ")");
  }
  if (playback.placement.matrix() == Eigen::Matrix4d::Identity()) return;
  for (Eigen::Vector3d& point : playback.positions) point = playback.placement * point;
}

}  // namespace

struct Player::State {
  explicit State(const SceneDescription& description) : scene(make_scene(description)) {
    const OpenedFiles opened;
    LoadedScene loaded = load_scene(description);
    files.assign(opened.paths().begin(), opened.paths().end());
    warnings = std::move(loaded.warnings);
    group_ignored(loaded, description);
    for (LoadedSceneObject& object : loaded.objects) add(object, description.objects[object.entry]);
    index_names(description);
    for (const RuleDescription& rule : description.rules) set_rule(rule);
    for (const IgnoreDescription& ignored : description.ignore) ignore(ignored);
    frame_count = description.frames.value_or(longest_motion(playbacks));
  }

  void add(LoadedSceneObject& loaded, const ObjectDescription& entry);
  void take_warnings(Playback& playback);
  void set_rule(const RuleDescription& rule);
  void ignore(const IgnoreDescription& ignored);
  void ignore_groups(const std::vector<std::size_t>& first, const std::vector<std::size_t>& second,
                     const std::array<std::uint8_t, 2>& groups);
  void count_ignored(std::size_t first, std::size_t second, const std::string& place);
  void index_names(const SceneDescription& description);
  [[nodiscard]] const std::vector<std::size_t>& named(const std::string& name,
                                                      const std::string& where) const;
  void advance_object(std::size_t index, std::uint32_t frame);

  std::vector<SceneObject> objects;
  std::vector<std::size_t> entries;  ///< of each object, the entry of the description that it came from
  /// The objects of each entry by its name, and other objects by their own.
  std::unordered_map<std::string, std::vector<std::size_t>> objects_by_name;
  std::uint64_t ignored_pairs = 0;
  PairFilters filters;
  std::vector<Playback> playbacks;  ///< of each object. It outlives the scene, which reads its positions
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;
  std::uint32_t frame_count = 1;
  Scene scene;
};

void Player::State::add(LoadedSceneObject& loaded, const ObjectDescription& entry) {
  SceneObject object{{}, loaded.settings.name, loaded.mesh};
  try {
    object.id = scene.add(loaded.mesh, loaded.settings);
  } catch (const Error& error) {
    throw InputError(entry.place + ": " + error.what());
  }
  Playback playback;
  playback.source = std::move(loaded.source);
  playback.keys = entry.poses;
  playback.placement = loaded.placement;
  playback.is_deformable = loaded.settings.motion == Motion::deformable;
  take_warnings(playback);
  if (playback.source) playback.positions.assign(loaded.mesh->rest().begin(), loaded.mesh->rest().end());
  if (!playback.is_deformable) {
    playback.pose = entry.transform.pose();
    scene.set_pose(object.id, playback.pose);
  }
  objects.push_back(std::move(object));
  entries.push_back(loaded.entry);
  playbacks.push_back(std::move(playback));
}

void Player::State::take_warnings(Playback& playback) {
  if (!playback.source) return;
  for (const std::string& warning : playback.source->warnings().subspan(playback.said))
    warnings.push_back(warning);
  playback.said = playback.source->warnings().size();
}

void Player::State::index_names(const SceneDescription& description) {
  for (std::size_t index = 0; index < objects.size(); ++index) {
    const std::string& entry_name = description.objects[entries[index]].settings.name;
    objects_by_name[objects[index].name].push_back(index);
    if (!entry_name.empty() && entry_name != objects[index].name)
      objects_by_name[entry_name].push_back(index);
  }
}

/// Throws InputError when all entries together ignore too many pairs. Each pair is kept one by one.
void Player::State::count_ignored(std::size_t first, std::size_t second, const std::string& place) {
  constexpr std::uint64_t most = 1000000;
  ignored_pairs += std::uint64_t{first} * second;
  if (ignored_pairs > most)
    throw InputError(place + ": " + std::to_string(ignored_pairs) + " pairs are ignored up to here, and " +
                     std::to_string(most) +
                     " may be; give the objects a \"group\", or \"layer\" and \"collides_with\"");
}

/// The objects of the entry called `name`, or the one object called so.
const std::vector<std::size_t>& Player::State::named(const std::string& name,
                                                     const std::string& where) const {
  const auto found = objects_by_name.find(name);
  if (found != objects_by_name.end()) return found->second;
  std::string known;
  for (const SceneObject& object : objects) known += (known.empty() ? "" : ", ") + object.name;
  throw InputError(where + ": no object is called \"" + name + "\"; the scene has " + known);
}

void Player::State::set_rule(const RuleDescription& rule) {
  scene.set_rule(rule.kinds[0], rule.kinds[1], rule);
  std::erase_if(filters.rules, [&](const PairFilters::KindRule& other) {
    return std::minmax(other.kind_a, other.kind_b) == std::minmax(rule.kinds[0], rule.kinds[1]);
  });
  filters.rules.push_back({rule.kinds[0], rule.kinds[1], rule});
}

void Player::State::ignore(const IgnoreDescription& ignored) {
  const auto& first = named(ignored.names[0], ignored.place);
  const auto& second = named(ignored.names[1], ignored.place);
  if (ignored.groups) {
    count_ignored(first.size(), second.size(), ignored.place);
    return ignore_groups(first, second, *ignored.groups);
  }
  if (&first == &second && first.size() == 1)
    throw InputError(ignored.place + ": names one object twice; name two objects");
  if (&first == &second) return;  // group_ignored() has given them a group
  count_ignored(first.size(), second.size(), ignored.place);
  for (const std::size_t a : first)
    for (const std::size_t b : second) {
      if (a == b) continue;
      scene.ignore(objects[a].id, objects[b].id);
      filters.ignored.emplace_back(objects[a].id, objects[b].id);
    }
}

void Player::State::ignore_groups(const std::vector<std::size_t>& first,
                                  const std::vector<std::size_t>& second,
                                  const std::array<std::uint8_t, 2>& groups) {
  for (const std::size_t a : first)
    for (const std::size_t b : second) {
      scene.ignore(objects[a].id, groups[0], objects[b].id, groups[1]);
      filters.ignored_groups.push_back({{objects[a].id, groups[0]}, {objects[b].id, groups[1]}});
    }
}

void Player::State::advance_object(std::size_t index, std::uint32_t frame) {
  Playback& playback = playbacks[index];
  const ObjectId id = objects[index].id;
  if (playback.source) {
    read_frame(playback, frame, objects[index]);
    take_warnings(playback);
    if (playback.bound != playback.positions.data()) scene.bind_positions(id, playback.positions);
    playback.bound = playback.positions.data();
  }
  if (!playback.keys.empty()) {
    playback.pose = pose_at(playback.keys, frame);
    scene.set_pose(id, playback.pose);
  }
}

Player::Player(const SceneDescription& description)
    : state_(with_memory_for(description.file, [&] { return std::make_unique<State>(description); })) {}
Player::~Player() = default;
Player::Player(Player&&) noexcept = default;
Player& Player::operator=(Player&&) noexcept = default;

Scene& Player::scene() {
  return state_->scene;
}
std::span<const SceneObject> Player::objects() const {
  return state_->objects;
}
const PairFilters& Player::pair_filters() const {
  return state_->filters;
}
std::uint32_t Player::frame_count() const {
  return state_->frame_count;
}
std::span<const std::string> Player::warnings() const {
  return state_->warnings;
}
std::span<const std::filesystem::path> Player::files() const {
  return state_->files;
}

void Player::advance(std::uint32_t frame) {
  for (std::size_t index = 0; index < state_->objects.size(); ++index)
    with_memory_for(state_->objects[index].name, [&] { state_->advance_object(index, frame); });
}

const Eigen::Isometry3d& Player::pose(std::size_t index) const {
  return state_->playbacks[index].pose;
}

void Player::read_positions(std::size_t index, std::vector<Eigen::Vector3d>& positions) const {
  const Playback& playback = state_->playbacks[index];
  if (playback.source) {
    positions = playback.positions;
    return;
  }
  const auto rest = state_->objects[index].mesh->rest();
  positions.assign(rest.begin(), rest.end());
  if (playback.is_deformable) return;
  for (Eigen::Vector3d& point : positions) point = playback.pose * point;
}

}  // namespace graze::io
