// Text from outside to a JSON document, within bounds: bytes, values, levels, lengths of texts, no key twice in an
// object, no character U+0000.
//
// Nothing that comes later has to fear a document that is deep or long. A whole number beyond 64 bits with a sign
// becomes a number with a fraction, which is no whole number to whoever asks for one. Errors: as values, with line and
// column where it is not JSON. Thread: pure.
#pragma once

#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "actors/domain/mission/error.hpp"

namespace godwit::mission {

// A document holds at most one value for so many of the bytes that it may have. A value costs up to 150 bytes of memory
// however short it is written, and what the contract allows has one for 20 bytes at most.
inline constexpr std::size_t bytes_a_value = 16;

[[nodiscard]] tl::expected<nlohmann::json, document_error> parse_document(std::string_view text, std::size_t max_bytes);

} // namespace godwit::mission
