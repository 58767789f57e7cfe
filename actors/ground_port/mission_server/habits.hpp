// How a vehicle behaves in plan transfers where the MAVLink text leaves it open, or where it does otherwise.
//
// What an autopilot does is a value of this struct: PX4 1.17 and ArduPilot 4.7 (Rover, Copter, Plane) as they were seen
// on the wire, and `plain`, which is what godwit's own ground port does: by the MAVLink text, atomic, with plan ids.
// One server serves them all, so that a client is tested against the code that also serves ground stations.
// Thread: values.
#pragma once

#include <cstdint>
#include <optional>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port::mission_server {

namespace mavlink = io::mavlink;

inline constexpr std::int64_t ns_per_ms = 1'000'000;

// In which message an item is asked for.
enum class request_kind { mission_request, mission_request_int };

// In answer to an item that is not the one asked for, a repeated one included.
enum class out_of_order { ignored, acknowledged_as_error, asked_for_again };

// In answer to the last item again, when the transfer has been acknowledged.
enum class last_item_again { accepted_again, error, ignored };

// In answer to an item when no transfer is open.
enum class stray_item { error, ignored };

// In answer to MISSION_COUNT from the station whose transfer is open.
enum class count_again { begins_again, begins_again_before_item_1 };

// At the end of its patience.
enum class giving_up { silent, tells };

struct habits {
  request_kind asks_with = request_kind::mission_request_int;
  std::int64_t asks_again_ns = 1'000 * ns_per_ms;
  std::int64_t gives_up_ns = 5'000 * ns_per_ms; // after the last message of the station
  giving_up when_giving_up = giving_up::silent;

  out_of_order when_out_of_order = out_of_order::asked_for_again;
  last_item_again when_last_item_comes_again = last_item_again::accepted_again;
  stray_item when_no_transfer = stray_item::error;
  count_again when_count_comes_again = count_again::begins_again;
  std::optional<mavlink::mav_mission_result> when_busy = mavlink::mav_mission_result::denied; // none: no answer
  bool obeys_cancel = true;

  bool is_busy_while_read = false;   // COUNT is refused until a download is closed, or gives_up_ns
  bool serves_any_item = false;      // in a download: any item, at any time; else in order, after a request list
  bool serves_float_items = true;    // MISSION_ITEM in answer to MISSION_REQUEST; else UNSUPPORTED
  bool takes_float_items = false;    // MISSION_ITEM in an upload
  bool listens_to_everybody = false; // targets 0 and other components of the same system

  // One message of a transfer is taken in each turn of the main loop. 0: at once.
  std::int64_t turn_ns = 0;

  bool is_atomic = true; // the old plan stays until the new one is complete
  bool has_plan_ids = true;
  bool rewrites_items = false;         // as ArduPilot: frame 3 for 6, without the parameters that it does not use
  bool marks_first_as_current = false; // gives `current` 1 back with item 0 of a mission
  std::optional<mavlink::mission_item_int> home; // item 0 of a mission, whatever is uploaded there

  bool clears_all_types_at_once = true;
  bool checks_type = true; // UNSUPPORTED for an unknown mission type; else it is accepted
  bool checks_latitude = true;
  int capacity = 1'000; // items of one plan; more: NO_SPACE
};

[[nodiscard]] habits plain_habits();
[[nodiscard]] habits px4_habits();
[[nodiscard]] habits ardupilot_copter_habits();
[[nodiscard]] habits ardupilot_plane_habits();
[[nodiscard]] habits ardupilot_rover_habits();

} // namespace godwit::ground_port::mission_server
