// Whether a survey is flown in one pass, and what the map is told of it. In doubt it was none: an object is not said to
// be gone because nobody looked. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "actors/scan_controller/settings.hpp"
#include "actors/scan_controller/state.hpp"
#include "io/time_units.hpp"
#include "messages/scan_controller/view.hpp"

namespace godwit::scan_controller {

// Sightings of the last line are on their way for so long.
inline constexpr std::int64_t pass_settles_ns = 10'000'000'000;

// PROCESS: another number in each process.
[[nodiscard]] std::optional<fact> on_survey(const state& s, const settings& configured, const survey_progress& now_at,
                                            std::uint64_t process, instant now);

// A view is believed for so long.
inline constexpr std::int64_t view_lasts_ns = 2'000'000'000;

// Whether the ground was seen of late, and whether it has to be. Not durable: a new incarnation believes it for as long
// as a view lasts, and hears within that.
struct view_watch {
  std::int64_t seen_until_ns = 0; // monotonic
  std::string reason;             // why it is not seen
  bool is_on_lines = true;        // of the survey; on the way to the first one nobody needs to see

  void on_view(const view& said, std::int64_t now_ns);
};

// A pass that is open and of which a part was not seen. Nothing: all was.
[[nodiscard]] std::optional<fact> on_view(const state& s, const settings& configured, const view_watch& watch,
                                          std::int64_t now_ns);

} // namespace godwit::scan_controller
