// When a call that failed is made again. Nothing here is random: the jitter follows from the key and the number of the
// try, so that a run can be repeated, and vehicles that failed together do not come back together.
//
// Sources: RFC 9110, 10.2.3 (Retry-After); M. Brooker, Exponential Backoff And Jitter (AWS Architecture Blog, 2015).
// Times are nanoseconds. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace godwit::mission_client {

inline constexpr std::int64_t second_ns = 1'000'000'000;
inline constexpr std::int64_t first_pause_ns = second_ns;
// A service that is back is found within five minutes, and 24 h are about 300 tries.
inline constexpr std::int64_t longest_pause_ns = 300 * second_ns;
// A service that asks for more has been set up wrongly.
inline constexpr std::int64_t longest_retry_after_ns = 3'600 * second_ns;
// What has to be delivered is tried for so long after its first failure.
inline constexpr std::int64_t delivery_window_ns = 24 * 3'600 * second_ns;

// Somebody waits for a change: three tries within two seconds.
inline constexpr std::uint32_t change_tries = 3;
inline constexpr std::int64_t change_window_ns = 2 * second_ns;
// Of one that the vehicle flies already: with a try of change_window_ns, a service that is back has it within 5 s.
inline constexpr std::int64_t longest_flown_pause_ns = 2 * second_ns;
inline constexpr std::int64_t first_change_pause_ns = second_ns / 5;

// After the FAILED-th failure in a row (from 1 on): 1 s, 2 s, 4 s, ... up to the longest, changed by at most a fifth.
// RETRY_AFTER_NS is what the service asked for, and the least.
[[nodiscard]] std::int64_t pause_ns(std::uint32_t failed, std::string_view key,
                                    std::optional<std::int64_t> retry_after_ns = {});
// The same for a change: 0.2 s, 0.4 s.
[[nodiscard]] std::int64_t change_pause_ns(std::uint32_t failed, std::string_view key,
                                           std::optional<std::int64_t> retry_after_ns = {});

// The same for a change that is flown: 1 s, then the longest.
[[nodiscard]] std::int64_t flown_pause_ns(std::uint32_t failed, std::string_view key,
                                          std::optional<std::int64_t> retry_after_ns = {});

// Whether a row whose time is NEXT_TRY_NS may be tried. One that lies further ahead than a pause can be long was noted
// under a clock that has been set back since; it is due.
[[nodiscard]] bool is_due(std::int64_t next_try_ns, std::int64_t now_ns);

// Whether a try that fails NOW is the last one. A first failure that lies ahead was noted under another clock, and
// counts as now.
[[nodiscard]] bool has_expired(std::int64_t first_failure_ns, std::int64_t now_ns);

} // namespace godwit::mission_client
