// What of what others say is worth an event: that something is otherwise than it was seen last.
//
//   flight_status, failsafe_status, health_status, children ──> noted, or nothing
//
// The data of an event is what the topic of the same name shows (docs/actors/fleet_link.md). Pure. Thread: any.
#pragma once

#include <optional>
#include <string>

#include "actors/fleet_link/state.hpp"
#include "messages/scan_controller/point.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::fleet_link {

[[nodiscard]] std::optional<noted> news_of_process(const sight& seen, const std::string& process);
[[nodiscard]] std::optional<noted> news_of(const sight& seen, const executor::flight_status& now);
[[nodiscard]] std::optional<noted> news_of(const sight& seen, const failsafe::failsafe_status& now);
[[nodiscard]] std::optional<noted> news_of(const sight& seen, const health::health_status& now);
[[nodiscard]] std::optional<noted> news_of(const sight& seen, const runtime::children& now);
[[nodiscard]] noted news_of(const scan_controller::point_shown& now);
[[nodiscard]] noted news_of(const scan_controller::point_closed& now);

} // namespace godwit::fleet_link
