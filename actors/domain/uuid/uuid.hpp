// UUIDs as text. Thread: pure. Source: RFC 9562.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace godwit::ids {

// Small letters and dashes: one form only, because ids are compared as texts.
[[nodiscard]] bool is_uuid(std::string_view text);

// The 128 bits of one, first half first.
using uuid_bits = std::array<std::uint64_t, 2>;
[[nodiscard]] uuid_bits bits_of(std::string_view uuid);

[[nodiscard]] std::string text_of(const uuid_bits& uuid);

// The UUID (version 8) that follows from two others: the same every time, and different for every other pair as surely
// as random ones are. Both are UUIDs; their order matters.
[[nodiscard]] std::string derived_uuid(std::string_view first, std::string_view second);

} // namespace godwit::ids
