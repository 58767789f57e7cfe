// The calls of docs/missions-service.md, one function each. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/mission_client/outbox/outbox.hpp"
#include "actors/mission_client/service_port.hpp"
#include "actors/mission_client/settings.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mission_client {

// At most so many reports go out together.
inline constexpr std::size_t reports_per_call = 100;

[[nodiscard]] service_call get_mission(const settings& by, const std::string& mission_id);
// The number of the last report that the service has.
[[nodiscard]] service_call get_progress(const settings& by, const std::string& mission_id);
// Which mission the vehicle is to fly next: a long poll.
[[nodiscard]] service_call get_next(const settings& by, const std::string& vehicle_id);
// The long poll.
[[nodiscard]] service_call get_assignments(const settings& by, const std::string& mission_id, std::int32_t after);
// NEXT is what the last page said; empty: the first. SINCE: the mark of the copy that is here, empty where it has none;
// nothing: the service knows no marks.
[[nodiscard]] service_call get_page(const settings& by, const std::string& mission_id, destination what,
                                    const std::string& next, const std::optional<std::string>& since = {});

// ROWS are one cut of a progress lane; the key follows from theirs.
[[nodiscard]] service_call post_progress(const settings& by, const std::vector<const outbox_row*>& rows);
// A response, a waypoint, a tail or a picture.
[[nodiscard]] service_call post_row(const settings& by, const outbox_row& row);
[[nodiscard]] service_call post_batch(const settings& by, const mapobjects_store::batch& rows);

// For a query (RFC 3986, 2.1): all but the unreserved characters.
[[nodiscard]] std::string percent_encoded(const std::string& text);

} // namespace godwit::mission_client
