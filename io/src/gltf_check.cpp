#include "gltf_check.hpp"

#include "file_bytes.hpp"
#include "gltf_json.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

class GltfCheck {
 public:
  GltfCheck(const std::filesystem::path& path, const json& document) : path_(path), document_(document) {}

  void run() const {
    check_sparse_accessors();
    std::size_t number = 0;
    for (const auto& mesh : member(document_, "meshes")) check_mesh(joined("meshes[", number++, "]"), mesh);
    number = 0;
    for (const auto& skin : member(document_, "skins")) check_skin(joined("skins[", number++, "]"), skin);
    number = 0;
    for (const auto& animation : member(document_, "animations"))
      check_animation(joined("animations[", number++, "]"), animation);
  }

 private:
  [[nodiscard]] const json& accessor(const json& number) const {
    return element(member(document_, "accessors"), number);
  }

  [[nodiscard]] std::uint64_t count_of(const json& number) const {
    return number_of(member(accessor(number), "count"));
  }

  void require(bool holds, const std::string& place, const std::string& what) const {
    if (!holds) fail(path_, joined(place, ": ", what));
  }

  void require_floats(const json& number, const std::string& place) const {
    constexpr std::uint64_t float_component = 5126;
    require(number.is_null() || number_of(member(accessor(number), "componentType")) == float_component,
            place, "only float numbers are read here; export without quantisation");
  }

  /// assimp makes a sparse accessor of the size that the file says. More elements than bytes there can be
  /// none.
  void check_sparse_accessors() const {
    std::uint64_t buffer_bytes = 0;
    for (const auto& buffer : member(document_, "buffers"))
      buffer_bytes += number_of(member(buffer, "byteLength"));
    std::size_t number = 0;
    for (const auto& entry : member(document_, "accessors")) {
      const std::uint64_t count = number_of(member(entry, "count"));
      require(!member(entry, "sparse").is_object() || count <= buffer_bytes,
              joined("accessors[", number, "]"),
              joined(count, " elements are more than ", buffer_bytes,
                     " bytes of buffers can mean; correct the count"));
      ++number;
    }
  }

  void check_mesh(const std::string& place, const json& mesh) const {
    std::size_t number = 0;
    for (const auto& primitive : member(mesh, "primitives")) {
      const std::string here = joined(place, ".primitives[", number++, "]");
      const json& attributes = member(primitive, "attributes");
      const json& position = member(attributes, "POSITION");
      require_floats(position, joined(here, ".attributes.POSITION"));
      if (attributes.is_object())
        for (const auto& [name, value] : attributes.items())
          if (name.starts_with("WEIGHTS_")) require_floats(value, joined(here, ".attributes.", name));
      std::size_t target_number = 0;
      for (const auto& target : member(primitive, "targets")) {
        const json& moved = member(target, "POSITION");
        const std::string target_place = joined(here, ".targets[", target_number++, "].POSITION");
        require_floats(moved, target_place);
        require(moved.is_null() || count_of(moved) == count_of(position), target_place,
                "the target has another number of vertices than the mesh; export it again");
      }
    }
  }

  void check_skin(const std::string& place, const json& skin) const {
    const json& matrices = member(skin, "inverseBindMatrices");
    require_floats(matrices, joined(place, ".inverseBindMatrices"));
    require(matrices.is_null() || count_of(matrices) >= member(skin, "joints").size(), place,
            "there are fewer inverse bind matrices than joints; export it again");
  }

  void check_animation(const std::string& place, const json& animation) const {
    std::size_t number = 0;
    for (const auto& sampler : member(animation, "samplers")) {
      const std::string here = joined(place, ".samplers[", number++, "]");
      const json& input = member(sampler, "input");
      const json& output = member(sampler, "output");
      require_floats(input, joined(here, ".input"));
      require_floats(output, joined(here, ".output"));
      // A cubic spline has two tangents with each value.
      const std::uint64_t values = text_of(member(sampler, "interpolation")) == "CUBICSPLINE" ? 3 : 1;
      require(count_of(input) > 0 && count_of(output) / values >= count_of(input), here,
              "there are fewer values than keys, or no keys; export it again");
    }
  }

  const std::filesystem::path& path_;
  const json& document_;
};

}  // namespace

void check_gltf(const std::filesystem::path& path, const json& document) {
  GltfCheck(path, document).run();
}

}  // namespace graze::io
