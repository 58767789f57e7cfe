// Idempotency keys: fresh ones, and those that follow from what they stand for.
//
// A derived key is a UUID of version 8 (RFC 9562): made by a mixing function that is good against accidents, not
// against somebody who wants two things to have one key; nobody has something to gain from that. Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/random.hpp"

namespace godwit::mission_client {

[[nodiscard]] std::uint64_t hash_of(std::string_view text, std::uint64_t start);

// Small letters and dashes, version 4.
[[nodiscard]] std::string fresh_key(runtime::random_source& random);

// The same parts in the same order: the same key. Any other parts: another one.
[[nodiscard]] std::string derived_key(const std::vector<std::string_view>& parts);

} // namespace godwit::mission_client
