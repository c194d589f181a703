#include "page/page_table.hpp"

namespace graze::io {
namespace {

constexpr std::size_t table_alignment = 8;

std::size_t padding_after(std::size_t size) {
  return (table_alignment - size % table_alignment) % table_alignment;
}

}  // namespace

void PageTable::add_bytes(std::string_view name, std::string_view type, std::string_view bytes,
                          std::size_t count) {
  numbers_.append(padding_after(numbers_.size()), '\0');
  arrays_.key(name).open('{').key("type").text(type);
  arrays_.key("offset").whole(numbers_.size()).key("count").whole(count).close('}');
  numbers_ += bytes;
}

void PageTable::add_key(std::string_view name, std::string_view json) {
  keys_.append(",\"").append(name).append("\":").append(json);
}

std::string PageTable::bytes() const {
  std::string header = "{\"arrays\":" + arrays_.line() + "}" + keys_ + "}";
  header.append(padding_after(header.size()), ' ');
  std::string bytes;
  append_little_endian(bytes, static_cast<std::uint32_t>(header.size()));
  append_little_endian(bytes, std::uint32_t{0});
  return bytes + header + numbers_;
}

}  // namespace graze::io
