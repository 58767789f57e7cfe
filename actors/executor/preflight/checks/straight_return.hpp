// Says when a failsafe's return, which the autopilot flies straight home, would cross an exclusion fence from
// somewhere on the way of the mission; names the items on the way to which that is so. Degraded where that is asked
// for, else it passes. Skipped where there are no fences, or no plan whose way could be looked at; the check of the
// mission fails then. Thread: pure.
#pragma once

#include <string>
#include <vector>

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

inline constexpr std::size_t max_named_items = 8; // as many as anyone reads

// Of at least one.
[[nodiscard]] std::string crossing_sentence(const std::vector<plan::return_crossing>& all,
                                            const mission::document& mission);

[[nodiscard]] result look_at_straight_return(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
