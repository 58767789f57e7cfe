// What happens in a run, in one sentence each. Thread: pure.
#pragma once

#include <optional>
#include <string>

#include "messages/mission_client/types.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "programs/godwitd/ground_run/core.hpp"

namespace godwit::ground_run {

[[nodiscard]] std::string sentence_of(const mission_client::mission_loaded& news);
// With what to do about it.
[[nodiscard]] std::string sentence_of(const mission_client::mission_refused& news);
[[nodiscard]] std::string sentence_of(const mission_client::map_pulled& news, std::optional<double> pull_s);
// Of a pull that an earlier run has ended.
[[nodiscard]] std::string sentence_of(mission_client::pull_state ended);
[[nodiscard]] std::string sentence_of(const sighting_counts& counts);
// Why the delivery does not get on, and what to do about it.
[[nodiscard]] std::string delivery_sentence(const mission_client::service_status& now);
// What was not delivered and is kept; ON_MAP: rows that the map still has for the mission.
[[nodiscard]] std::string kept_sentence(const mission_client::mission_resolved& news, std::uint64_t on_map);
[[nodiscard]] std::string sentence_of(const mission_client::change_outcome& news);
[[nodiscard]] std::string sentence_of(const vehicle_link::connection_changed& news);

} // namespace godwit::ground_run
