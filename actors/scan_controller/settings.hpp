// What can be set about points of interest. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace godwit::scan_controller {

// In any so long a time at most `shown_a_minute` points are shown.
inline constexpr std::int64_t rate_window_ns = 60'000'000'000;

struct settings {
  double min_confidence = 0.4; // below it a point is never shown
  std::uint32_t shown_a_minute = 5;
  std::int64_t window_ms = 60'000; // to decide about a point that is shown
  double merge_within_m = 30;
  // A point that was not seen for so long is not worth a look any more; one that was passed over is shown again only
  // when it is seen so long after.
  std::int64_t keep_ms = 600'000;
  // What the source of sightings looks for, all through a survey. Empty: it is not known, and no pass is told to the
  // map.
  std::vector<std::string> looks_for = {};
  double pass_confidence = 0.8; // that what was there would have been seen
  // There is a camera: a pass counts only while somebody says that it sees the ground.
  bool watches_view = false;
};

// A sentence about what can not be; nothing: it can be used.
[[nodiscard]] std::optional<std::string> objection_to(const settings& configured);

} // namespace godwit::scan_controller
