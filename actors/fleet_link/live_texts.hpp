// What of the stream goes to the broker while there is one: of each topic the newest text, not more often than is set.
//
//   hub ──take()──> newest of each topic ──next_due()──> the broker
//
// What had to wait for a slow network is overtaken by what is newer, and counted. What the broker keeps (how things
// stand) goes out again with each connection. Pure: the time comes in, as monotonic nanoseconds. Thread: one owner.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "messages/telemetry_stream/types.hpp"

namespace godwit::fleet_link {

using text_ptr = std::shared_ptr<const std::string>; // as the hub of telemetry_stream has it

struct live_row {
  telemetry_stream::topic what = telemetry_stream::topic::clock;
  bool is_kept = false;       // by the broker
  std::int64_t intervals = 1; // at the least between two texts, of the interval that is set
};

// The log stays on the vehicle. A position a second and the rest take some 4 kbit/s (docs/performance.md).
inline constexpr std::array live_rows{
    live_row{telemetry_stream::topic::position, false, 1}, live_row{telemetry_stream::topic::attitude, false, 5},
    live_row{telemetry_stream::topic::battery, false, 5},  live_row{telemetry_stream::topic::gps, false, 5},
    live_row{telemetry_stream::topic::link, true, 1},      live_row{telemetry_stream::topic::home, true, 5},
    live_row{telemetry_stream::topic::flight, true, 1},    live_row{telemetry_stream::topic::authority, true, 1},
    live_row{telemetry_stream::topic::progress, true, 1},  live_row{telemetry_stream::topic::map, true, 5},
    live_row{telemetry_stream::topic::health, true, 5},    live_row{telemetry_stream::topic::points, true, 5},
};

// None: it is of the stream itself, or not sent.
[[nodiscard]] const live_row* row_of_text(std::string_view text);

class live_texts {
public:
  explicit live_texts(std::int64_t interval_ns) : interval_ns_(interval_ns) {}

  void take(text_ptr text);
  // There is a broker from now on.
  void begin_connection();

  struct due {
    const live_row* row = nullptr;
    text_ptr text;
  };
  // Counts as sent; to be asked until there is nothing.
  [[nodiscard]] std::optional<due> next_due(std::int64_t now_ns);
  // What is due now has to wait.
  void hold_back(std::int64_t now_ns);
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

private:
  struct entry {
    text_ptr text;
    bool is_new = false; // it has not gone out
    bool is_held = false;
    std::int64_t next_ns = 0;
  };
  [[nodiscard]] static bool is_due(const entry& each, std::int64_t now_ns) {
    return each.is_new && now_ns >= each.next_ns;
  }

  std::int64_t interval_ns_;
  std::array<entry, live_rows.size()> entries_;
  std::uint64_t skipped_ = 0;
};

} // namespace godwit::fleet_link
