// The answers that were given under an idempotency key, so that a repetition gets the same one and changes nothing.
// Errors: kept by the file. Thread: the file's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

// A vehicle repeats for 24 hours; the contract asks for twice that.
inline constexpr std::int64_t keep_answers_s = 48 * 3600;

struct kept_answer {
  std::string digest;
  answer what;
};

// Of all that makes a request the same: SHA-256 in hexadecimal digits.
[[nodiscard]] std::string digest_of(std::string_view method, std::string_view path, std::string_view body);

[[nodiscard]] std::optional<kept_answer> find_answer(service_file& file, const std::string& key);
void count_replay(service_file& file, const std::string& key);
void keep_answer(service_file& file, const std::string& key, const kept_answer& given, std::int64_t now_s);
// Those that are older than keep_answers_s.
void forget_answers(service_file& file, std::int64_t now_s);
[[nodiscard]] std::uint64_t replays(service_file& file);

} // namespace godwit::sim::missions
