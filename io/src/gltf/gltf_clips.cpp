#include "gltf/gltf_clips.hpp"

#include <algorithm>
#include <cmath>

#include "gltf/gltf_accessor.hpp"
#include "gltf/gltf_json.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

Interpolation interpolation_of(const json& sampler) {
  const std::string name = text_of(member(sampler, "interpolation"));
  if (name == "STEP") return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubic : Interpolation::linear;
}

/// The keys of a sampler. A value of it is `size` numbers, at `offset` of the numbers of its key.
struct Keys {
  std::vector<double> seconds;
  std::vector<std::size_t> order;  ///< of keys by time, those at no finite time left out
  GltfNumbers output;
  Interpolation interpolation = Interpolation::linear;
  std::size_t numbers_a_key = 0;  ///< of one value, or of one tangent

  /// A number of a key's value. Of cubic keys the tangents stand before (`which` 0) and after (2) it.
  [[nodiscard]] const double* at(std::size_t key, std::size_t which, std::size_t offset) const {
    const std::size_t values = interpolation == Interpolation::cubic ? 3 : 1;
    const std::size_t index = values == 3 ? 3 * key + which : key;
    return output.values.data() + index * numbers_a_key + offset;
  }
};

double value_from(const double* numbers, double /*unused*/) {
  return numbers[0];
}
Eigen::Vector3d value_from(const double* numbers, const Eigen::Vector3d& /*unused*/) {
  return {numbers[0], numbers[1], numbers[2]};
}
Eigen::Quaterniond value_from(const double* numbers, const Eigen::Quaterniond& /*unused*/) {
  return {numbers[3], numbers[0], numbers[1], numbers[2]};
}

bool is_finite(double value) {
  return std::isfinite(value);
}
bool is_finite(const Eigen::Vector3d& value) {
  return value.allFinite();
}
bool is_finite(const Eigen::Quaterniond& value) {
  return value.coeffs().allFinite();
}

/// Whether a value can be taken. A rotation then has the length 1.
template <typename Value>
bool make_usable(Value& value) {
  return is_finite(value);
}
bool make_usable(Eigen::Quaterniond& value) {
  const double norm = value.norm();
  if (!(norm > 0) || !std::isfinite(norm)) return false;
  value.normalize();
  return true;
}

/// Keys whose value is not finite are left out.
template <typename Value>
Track<Value> make_track(const Keys& keys, std::size_t offset, const Value& zero) {
  Track<Value> track;
  track.interpolation = keys.interpolation;
  for (const std::size_t key : keys.order) {
    Value value = value_from(keys.at(key, 1, offset), zero);
    if (!make_usable(value)) continue;
    if (keys.interpolation == Interpolation::cubic) {
      const Value before = value_from(keys.at(key, 0, offset), zero);
      const Value after = value_from(keys.at(key, 2, offset), zero);
      track.in_tangents.push_back(is_finite(before) ? before : zero);
      track.out_tangents.push_back(is_finite(after) ? after : zero);
    }
    track.seconds.push_back(keys.seconds[key]);
    track.values.push_back(value);
  }
  return track;
}

class GltfClipReader {
 public:
  GltfClipReader(GltfDocument& document, const GltfNodes& nodes, const json& source, std::string json_path)
      : document_(document), nodes_(nodes), source_(source), json_path_(std::move(json_path)) {}

  Clip read() {
    clip_.name = text_of(member(source_, "name"));
    std::size_t number = 0;
    for (const json& channel : member(source_, "channels"))
      add_channel(channel, joined(json_path_, ".channels[", number++, "]"));
    return std::move(clip_);
  }

 private:
  void add_channel(const json& channel, const std::string& json_path) {
    const json& target = member(channel, "target");
    const json& node = member(target, "node");
    const std::string path = text_of(member(target, "path"));
    const json& samplers = member(source_, "samplers");
    const json& sampler = element(samplers, member(channel, "sampler"));
    if (!sampler.is_object())
      document_.fail_at(json_path, "its sampler does not exist; export the file again");
    const std::string here = joined(json_path_, ".samplers[", number_of(member(channel, "sampler")), "]");
    if (node.is_null()) return;
    if (!element(document_.list("nodes"), node).is_object())
      document_.fail_at(json_path, "its node does not exist; export the file again");
    const std::uint32_t number = nodes_.number_of[node.get<std::size_t>()];
    if (path == "translation")
      clip_.node_motions[number].translation =
          make_track<Eigen::Vector3d>(read_keys(sampler, "VEC3", here), 0, Eigen::Vector3d::Zero());
    if (path == "scale")
      clip_.node_motions[number].scale =
          make_track<Eigen::Vector3d>(read_keys(sampler, "VEC3", here), 0, Eigen::Vector3d::Zero());
    if (path == "rotation")
      clip_.node_motions[number].rotation =
          make_track<Eigen::Quaterniond>(read_keys(sampler, "VEC4", here), 0, Eigen::Quaterniond(0, 0, 0, 0));
    if (path == "weights") {
      const Keys keys = read_keys(sampler, "SCALAR", here);
      constexpr std::uint64_t numbers_of_track = 14;
      document_.count_kept(numbers_of_track * keys.numbers_a_key, here);
      auto& tracks = clip_.morph_weights[number];
      tracks.clear();
      for (std::size_t target_number = 0; target_number < keys.numbers_a_key; ++target_number)
        tracks.push_back(make_track<double>(keys, target_number, 0.0));
    }
  }

  Keys read_keys(const json& sampler, const char* type, const std::string& json_path) {
    const json& input = member(sampler, "input");
    const json& output = member(sampler, "output");
    Keys keys;
    keys.interpolation = interpolation_of(sampler);
    const std::size_t values = keys.interpolation == Interpolation::cubic ? 3 : 1;
    const std::size_t count = accessor_count(document_, input);
    if (count == 0 || accessor_count(document_, output) / values < count)
      document_.fail_at(json_path, "there are fewer values than keys, or no keys; export it again");
    keys.seconds = read_accessor(document_, input, "SCALAR", joined(json_path, ".input")).values;
    keys.output = read_accessor(document_, output, type, joined(json_path, ".output"));
    keys.numbers_a_key = keys.output.width;
    if (keys.output.width == 1) keys.numbers_a_key = keys.output.count() / values / count;
    document_.count_kept(keys.seconds.size() + keys.output.values.size(), json_path);
    sort(keys);
    return keys;
  }

  void sort(Keys& keys) {
    for (std::size_t key = 0; key < keys.seconds.size(); ++key)
      if (std::isfinite(keys.seconds[key])) keys.order.push_back(key);
    std::ranges::stable_sort(keys.order, {}, [&](std::size_t key) { return keys.seconds[key]; });
    if (!keys.order.empty()) clip_.seconds = std::max(clip_.seconds, keys.seconds[keys.order.back()]);
  }

  GltfDocument& document_;
  const GltfNodes& nodes_;
  const json& source_;
  std::string json_path_;
  Clip clip_;
};

}  // namespace

std::vector<Clip> read_gltf_clips(GltfDocument& document, const GltfNodes& nodes) {
  std::vector<Clip> clips;
  std::size_t number = 0;
  for (const json& animation : document.list("animations"))
    clips.push_back(GltfClipReader(document, nodes, animation, joined("animations[", number++, "]")).read());
  return clips;
}

}  // namespace graze::io
