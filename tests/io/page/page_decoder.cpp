#include "io/page/page_decoder.hpp"

#include <zlib.h>

#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

std::string gunzip(std::string_view packed) {
  z_stream stream{};
  REQUIRE(inflateInit2(&stream, 16 + MAX_WBITS) == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  std::array<char, 16384> part;
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    bytes.append(part.data(), part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  REQUIRE(state == Z_STREAM_END);
  return bytes;
}

std::string from_base64(std::string_view text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  REQUIRE(text.size() % 4 == 0);
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::size_t bits = 0;
    std::size_t count = 3;
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t digit = text[i + j] == '=' ? 0 : digits.find(text[i + j]);
      REQUIRE(digit != std::string::npos);
      if (text[i + j] == '=') --count;
      bits = bits * 64 + digit;
    }
    for (std::size_t j = 0; j < count; ++j) bytes += static_cast<char>(bits >> (16 - 8 * j) & 255U);
  }
  return bytes;
}

template <typename Number>
Number number_at(std::string_view bytes, std::size_t offset) {
  REQUIRE(offset + sizeof(Number) <= bytes.size());
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

std::map<std::string, std::string> chunks_of_data(std::string_view bytes) {
  std::map<std::string, std::string> chunks;
  std::size_t offset = 8;
  while (offset < bytes.size()) {
    const auto name_bytes = number_at<std::uint32_t>(bytes, offset);
    const auto size = static_cast<std::size_t>(number_at<std::uint64_t>(bytes, offset + 4));
    const std::string name(bytes.substr(offset + 12, name_bytes));
    REQUIRE(offset + 12 + name_bytes + size <= bytes.size());
    REQUIRE(chunks.emplace(name, gunzip(bytes.substr(offset + 12 + name_bytes, size))).second);
    offset += 12 + name_bytes + size;
  }
  return chunks;
}

std::map<std::string, std::string> chunks_of_page(std::string_view text) {
  const std::string_view begin = "<script type=\"application/x-graze-chunk\" data-name=\"";
  std::map<std::string, std::string> chunks;
  for (std::size_t at = text.find(begin); at != std::string_view::npos; at = text.find(begin, at)) {
    at += begin.size();
    const std::size_t quote = text.find("\">", at);
    const std::size_t end = text.find("</script>", quote);
    REQUIRE(end != std::string_view::npos);
    const std::string name(text.substr(at, quote - at));
    REQUIRE(chunks.emplace(name, gunzip(from_base64(text.substr(quote + 2, end - quote - 2)))).second);
    at = end;
  }
  return chunks;
}

std::int32_t unzigzag(std::uint32_t coded) {
  return static_cast<std::int32_t>((coded >> 1U) ^ (0U - (coded & 1U)));
}

/// The numbers of the last of `frames` frames: x of all, y of all, z of all.
std::vector<std::uint32_t> summed(const std::vector<std::uint8_t>& bytes, std::size_t count,
                                  std::size_t frames) {
  std::vector<std::uint32_t> numbers(count, 0);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::uint8_t* const planes = bytes.data() + 4 * count * frame;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t coded = 0;
      for (std::size_t plane = 4; plane-- > 0;) coded = coded << 8U | planes[plane * count + i];
      numbers[i] += static_cast<std::uint32_t>(unzigzag(coded));
    }
  }
  return numbers;
}

DecodedShape decoded_positions(const nlohmann::json& track, const DecodedTable& table, std::size_t vertices,
                               std::size_t frames) {
  const auto bytes = table.numbers<std::uint8_t>(track.at("array"));
  REQUIRE(bytes.size() == 12 * vertices * track.at("frames").size());
  const std::vector<std::uint32_t> numbers = summed(bytes, 3 * vertices, frames);
  DecodedShape shape;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    Eigen::Vector3d point;
    bool is_drawn = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto number = static_cast<std::int32_t>(numbers[axis * vertices + vertex]);
      is_drawn = is_drawn && number != std::numeric_limits<std::int32_t>::min();
      point[static_cast<Eigen::Index>(axis)] =
          track.at("origin").at(axis).get<double>() + track.at("step").get<double>() * number;
    }
    shape.positions.push_back(is_drawn ? std::optional(point) : std::nullopt);
  }
  return shape;
}

}  // namespace

std::map<std::string, std::string> chunks_of(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  return bytes.starts_with("GRZVIEW1") ? chunks_of_data(bytes) : chunks_of_page(bytes);
}

DecodedTable::DecodedTable(const std::string& bytes) {
  const auto header_bytes = number_at<std::uint32_t>(bytes, 0);
  REQUIRE(number_at<std::uint32_t>(bytes, 4) == 0);
  REQUIRE((8 + header_bytes) % 8 == 0);
  header_ = nlohmann::json::parse(bytes.substr(8, header_bytes));
  arrays_ = bytes.substr(8 + header_bytes);
}

DecodedPage::DecodedPage(const std::filesystem::path& file) {
  for (const auto& [name, bytes] : chunks_of(file)) {
    if (name == "head")
      head_ = nlohmann::json::parse(bytes);
    else
      tables_.emplace(name, DecodedTable(bytes));
  }
  const std::size_t blocks = (frame_count() + block() - 1) / block();
  REQUIRE(tables_.size() == head_.at("meshes").size() + 2 * blocks);
}

const DecodedTable& DecodedPage::mesh(std::size_t number) const {
  return tables_.at(head_.at("meshes").at(number).at("chunk"));
}

std::pair<const DecodedTable*, std::size_t> DecodedPage::report(std::uint64_t frame) const {
  return {&tables_.at("report/" + std::to_string(frame / block())),
          static_cast<std::size_t>(frame % block())};
}

const nlohmann::json* DecodedPage::track(std::size_t object, std::uint64_t block) const {
  for (const nlohmann::json& track : tables_.at("motion/" + std::to_string(block)).header().at("tracks"))
    if (track.at("object") == object) return &track;
  return nullptr;
}

std::vector<std::uint64_t> DecodedPage::track_frames(std::size_t object, std::uint64_t block) const {
  const nlohmann::json* const found = track(object, block);
  return found == nullptr ? std::vector<std::uint64_t>()
                          : found->at("frames").get<std::vector<std::uint64_t>>();
}

std::optional<DecodedShape> DecodedPage::shape(std::size_t object, std::uint64_t frame) const {
  const nlohmann::json* const found = track(object, frame / block());
  if (found == nullptr) return std::nullopt;
  const DecodedTable& table = tables_.at("motion/" + std::to_string(frame / block()));
  std::size_t frames = 0;
  for (const std::uint64_t listed : found->at("frames")) frames += listed <= frame ? 1 : 0;
  if (frames == 0) return std::nullopt;
  const nlohmann::json& described = head_.at("objects").at(object);
  if (found->at("kind") == "positions") {
    const std::size_t mesh_number = described.at("mesh");
    return decoded_positions(*found, table, head_.at("meshes").at(mesh_number).at("vertices"), frames);
  }
  DecodedShape shape;
  const auto rows = table.numbers<double>(found->at("array"));
  REQUIRE(rows.size() == 12 * found->at("frames").size());
  std::memcpy(shape.pose.data(), rows.data() + 12 * (frames - 1), sizeof shape.pose);
  return shape;
}

}  // namespace graze::tests
