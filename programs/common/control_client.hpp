// The other end of the control socket: one question to a running godwitd.
//
// Errors: a sentence: nobody listens, may not, or does not answer in time. Thread: the caller's; blocks.
#pragma once

#include <chrono>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

namespace godwit::control {

inline constexpr std::chrono::seconds patience{8}; // longer than the daemon's own time-out
inline constexpr std::size_t max_answer_bytes = 256 * 1024;

[[nodiscard]] tl::expected<nlohmann::json, std::string> ask_daemon(const std::string& path,
                                                                   const nlohmann::json& question);

} // namespace godwit::control
