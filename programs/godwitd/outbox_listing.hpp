// What is owed to the missions service, read from the journal without writing to it: beside a running daemon, or after
// it has gone.
//
// Delivered rows are counted and not listed. Errors: a sentence that names the file and the remedy. Thread: the
// caller's; blocks on the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "runtime/journal/records.hpp"

namespace godwit::daemon {

inline constexpr std::size_t max_listed_rows = 20'000; // as many as an outbox may hold

struct listed_row {
  runtime::outbox_row row;
  std::string mission_id; // empty: the body does not say
};

struct outbox_listing {
  std::vector<listed_row> rows; // oldest first
  std::int64_t delivered = 0;   // that are still kept
  bool is_cut = false;          // there are more than max_listed_rows
};

[[nodiscard]] tl::expected<outbox_listing, std::string> read_outbox(const std::string& journal);

// A table for people. NOW_NS since 1970 (UTC).
[[nodiscard]] std::string table_of(const outbox_listing& listing, std::int64_t now_ns);
// For programs: {"rows": [...], "delivered": N, "is_cut": false}, times as RFC 3339.
[[nodiscard]] nlohmann::json json_of(const outbox_listing& listing, std::int64_t now_ns);

// Durations for people. Thread: pure.

// "0.4 s", "12 s", "3 min", "5 h 20 min", "3 days"; of a negative one "0 s".
[[nodiscard]] std::string duration_text(std::int64_t duration_ns);

} // namespace godwit::daemon
