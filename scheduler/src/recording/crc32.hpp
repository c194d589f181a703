#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace graze {

/// The CRC-32 of IEEE 802.3, as zlib and PNG have it. `before` is that of the bytes before these.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace graze
