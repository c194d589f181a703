#include "gltf/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "gltf/gltf_json.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

constexpr std::uint64_t most_elements = std::uint64_t{1} << 32U;
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 40U;

enum class Component : std::uint16_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

std::optional<Component> component_from(std::uint64_t number) {
  if (number < 5120 || number > 5126 || number == 5124) return std::nullopt;
  return static_cast<Component>(number);
}

std::size_t size_of(Component component) {
  switch (component) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    case Component::uint32:
    case Component::float32:
      break;
  }
  return 4;
}

template <typename Number>
double value_at(const char* bytes, bool is_normalised) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  if (!is_normalised) return static_cast<double>(number);
  const double fraction =
      static_cast<double>(number) / static_cast<double>(std::numeric_limits<Number>::max());
  return std::max(fraction, -1.0);
}

double value_at(Component component, const char* bytes, bool is_normalised) {
  switch (component) {
    case Component::int8:
      return value_at<std::int8_t>(bytes, is_normalised);
    case Component::uint8:
      return value_at<std::uint8_t>(bytes, is_normalised);
    case Component::int16:
      return value_at<std::int16_t>(bytes, is_normalised);
    case Component::uint16:
      return value_at<std::uint16_t>(bytes, is_normalised);
    case Component::uint32:
      return value_at<std::uint32_t>(bytes, is_normalised);
    case Component::float32:
      break;
  }
  return value_at<float>(bytes, false);
}

std::size_t width_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 16;
}

/// Elements side by side in a view, `stride` bytes apart.
struct Layout {
  Component component = Component::float32;
  std::size_t width = 1;
  std::uint64_t offset = 0;
  std::uint64_t stride = 0;
  bool is_normalised = false;

  [[nodiscard]] std::uint64_t element_bytes() const { return size_of(component) * width; }
};

class AccessorReader {
 public:
  AccessorReader(GltfDocument& document, const json& number, const char* type, const std::string& json_path)
      : document_(document),
        accessor_(element(document.list("accessors"), number)),
        type_(type),
        json_path_(json_path) {
    if (!accessor_.is_object())
      document.fail_at(json_path, "its accessor does not exist; export the file again");
    here_ = joined("accessors[", number.get<std::uint64_t>(), "]");
  }

  /// Reads the format and the count, and no element. There are bytes for so many elements.
  void open() {
    const std::string type = text_of(member(accessor_, "type"));
    if (type != type_)
      document_.fail_at(
          json_path_, joined("expected an accessor of ", type_, ", got '", type, "'; export the file again"));
    layout_.component = component_of(accessor_, here_);
    layout_.width = width_of(type_);
    layout_.is_normalised = member(accessor_, "normalized") == true;
    layout_.offset = document_.whole_number(accessor_, "byteOffset", here_, most_bytes, 0);
    count_ = document_.whole_number(accessor_, "count", here_, most_elements, 0);
    const json& view = member(accessor_, "bufferView");
    if (view.is_null())
      check_zeros();
    else
      bytes_of(view, layout_, count_, here_);
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }

  /// Reads the elements of these numbers, which ascend. It reads all where there are none.
  GltfNumbers read(const GltfElements* elements) {
    if (elements != nullptr && !elements->empty() && elements->back() >= count_)
      document_.fail_at(here_, joined("there is no element ", elements->back(), "; export the file again"));
    const json& view = member(accessor_, "bufferView");
    GltfNumbers numbers{layout_.width, {}};
    if (view.is_null())
      numbers.values = zeros(elements);
    else
      numbers.values = read_elements(view, layout_, count_, elements, here_);
    if (member(accessor_, "sparse").is_object()) replace_sparse(numbers, elements);
    return numbers;
  }

 private:
  [[nodiscard]] Component component_of(const json& object, const std::string& json_path) const {
    const auto component = component_from(number_of(member(object, "componentType")));
    if (!component)
      document_.fail_at(joined(json_path, ".componentType"),
                        "expected 5120, 5121, 5122, 5123, 5125 or 5126; export the file again");
    return *component;
  }

  /// An accessor without a view is of zeros. It has no bytes that would limit its count.
  void check_zeros() {
    const std::uint64_t bytes = document_.total_bytes();
    if (count_ > bytes)
      document_.fail_at(here_, joined(count_, " elements are more than ", bytes,
                                      " bytes of buffers can mean; correct the count"));
  }

  std::vector<double> zeros(const GltfElements* elements) {
    const std::uint64_t wanted = elements == nullptr ? count_ : elements->size();
    document_.count_read(wanted * layout_.width, here_);
    return std::vector<double>(wanted * layout_.width, 0.0);
  }

  /// The bytes of a view, which hold so many elements.
  std::string_view bytes_of(const json& view, Layout& layout, std::uint64_t count,
                            const std::string& json_path) {
    const std::string_view bytes = document_.view_bytes(view, json_path);
    const json& entry = element(document_.list("bufferViews"), view);
    layout.stride = document_.whole_number(entry, "byteStride", json_path, 65535, 0);
    if (layout.stride == 0) layout.stride = layout.element_bytes();
    if (count > 0 && layout.offset + (count - 1) * layout.stride + layout.element_bytes() > bytes.size())
      document_.fail_at(json_path, joined(count, " elements do not fit into the ", bytes.size(),
                                          " bytes of its bufferView; export the file again"));
    return bytes;
  }

  std::vector<double> read_elements(const json& view, Layout layout, std::uint64_t count,
                                    const GltfElements* elements, const std::string& json_path) {
    const std::string_view bytes = bytes_of(view, layout, count, json_path);
    const std::uint64_t wanted = elements == nullptr ? count : elements->size();
    document_.count_read(wanted * layout.width, json_path);
    std::vector<double> values;
    values.reserve(wanted * layout.width);
    const std::size_t size = size_of(layout.component);
    for (std::uint64_t index = 0; index < wanted; ++index) {
      const std::uint64_t number = elements == nullptr ? index : (*elements)[index];
      const char* const start = bytes.data() + layout.offset + number * layout.stride;
      for (std::size_t i = 0; i < layout.width; ++i)
        values.push_back(value_at(layout.component, start + i * size, layout.is_normalised));
    }
    return values;
  }

  void replace_sparse(GltfNumbers& numbers, const GltfElements* elements) {
    const json& sparse = member(accessor_, "sparse");
    const std::string json_path = joined(here_, ".sparse");
    const std::uint64_t replaced = document_.whole_number(sparse, "count", json_path, most_elements, 0);
    const json& indices = member(sparse, "indices");
    const json& values = member(sparse, "values");
    Layout index_layout;
    index_layout.component = component_of(indices, joined(json_path, ".indices"));
    index_layout.offset = document_.whole_number(indices, "byteOffset", json_path, most_bytes, 0);
    Layout value_layout = layout_;
    value_layout.offset = document_.whole_number(values, "byteOffset", json_path, most_bytes, 0);
    const auto where =
        read_elements(member(indices, "bufferView"), index_layout, replaced, nullptr, json_path);
    const auto what = read_elements(member(values, "bufferView"), value_layout, replaced, nullptr, json_path);
    for (std::uint64_t i = 0; i < replaced; ++i) {
      if (!(where[i] >= 0 && where[i] < static_cast<double>(count_)))
        document_.fail_at(json_path, joined("it replaces an element that is not among the ", count_,
                                            "; export the file again"));
      const auto position = position_of(static_cast<std::uint64_t>(where[i]), elements);
      if (!position) continue;
      const auto first = what.begin() + static_cast<std::ptrdiff_t>(i * layout_.width);
      std::copy_n(first, layout_.width,
                  numbers.values.begin() + static_cast<std::ptrdiff_t>(*position * layout_.width));
    }
  }

  /// Where an element is among those that are read.
  static std::optional<std::uint64_t> position_of(std::uint64_t number, const GltfElements* elements) {
    if (elements == nullptr) return number;
    const auto found = std::ranges::lower_bound(*elements, number);
    if (found == elements->end() || *found != number) return std::nullopt;
    return static_cast<std::uint64_t>(found - elements->begin());
  }

  GltfDocument& document_;
  const json& accessor_;
  std::string_view type_;
  const std::string& json_path_;
  std::string here_;
  Layout layout_;
  std::uint64_t count_ = 0;
};

}  // namespace

std::size_t accessor_count(const GltfDocument& document, const json& number) {
  return number_of(member(element(document.list("accessors"), number), "count"));
}

GltfNumbers read_accessor(GltfDocument& document, const json& number, const char* type,
                          const std::string& json_path) {
  AccessorReader reader(document, number, type, json_path);
  reader.open();
  return reader.read(nullptr);
}

GltfNumbers read_accessor(GltfDocument& document, const json& number, const char* type,
                          const std::string& json_path, const GltfElements& elements) {
  AccessorReader reader(document, number, type, json_path);
  reader.open();
  return reader.read(&elements);
}

std::uint64_t element_count(GltfDocument& document, const json& number, const char* type,
                            const std::string& json_path) {
  AccessorReader reader(document, number, type, json_path);
  reader.open();
  return reader.count();
}

}  // namespace graze::io
