// Whether the limits of this process leave room for godwitd: below them a start ends somewhere in the middle of a
// library, without a sentence. Thread: pure, but for limits_now. Source: getrlimit(2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace godwit::daemon {

// Measured: 1 GB runs, 600 MB does not always; each thread takes address space that it never uses.
inline constexpr std::uint64_t least_address_space = 900'000'000;
// Measured: 26 in flight, 8 for clients of the control socket, and some for links that come and go.
inline constexpr std::uint64_t least_descriptors = 64;

struct process_limits {
  std::uint64_t address_space = 0; // bytes; RLIMIT_AS
  std::uint64_t descriptors = 0;   // RLIMIT_NOFILE
};

[[nodiscard]] process_limits limits_now();

// Why godwitd can not run with them, as a sentence for people.
[[nodiscard]] std::optional<std::string> objection_to_limits(const process_limits& now);

} // namespace godwit::daemon
