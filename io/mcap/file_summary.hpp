// What the summary at the end of a closed file says, read without the data before it: the time of its messages, and the
// channels, which a file whose beginning is damaged needs.
//
// Nothing when the file has no sound end: it is being written, its writer was killed, or the end is damaged.
// Errors: io. Thread: one at a time. Source: MCAP specification, section "Summary Section".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

struct summary_channel {
  channel_id id{};
  std::string topic;
};

struct file_summary {
  static constexpr std::uint64_t max_bytes = std::uint64_t{64} << 20; // a longer one is not read

  std::optional<statistics_record> statistics;
  std::vector<summary_channel> channels;
};

[[nodiscard]] result<std::optional<file_summary>> read_summary(const byte_source& source);

} // namespace godwit::io::mcap
