// Whether a survey is flown in one pass, and what the map is told of it. In doubt it was none: an object is not said to
// be gone because nobody looked. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/scan_controller/instant.hpp"
#include "actors/scan_controller/settings.hpp"
#include "actors/scan_controller/state.hpp"
#include "messages/scan_controller/survey_progress.hpp"

namespace godwit::scan_controller {

// Sightings of the last line are on their way for so long.
inline constexpr std::int64_t pass_settles_ns = 10'000'000'000;

// PROCESS: another number in each process.
[[nodiscard]] std::optional<fact> on_survey(const state& s, const settings& configured, const survey_progress& now_at,
                                            std::uint64_t process, instant now);

} // namespace godwit::scan_controller
