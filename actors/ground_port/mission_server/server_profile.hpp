// How a vehicle behaves in plan transfers where the MAVLink text leaves it open, or where it does otherwise.
//
// What an autopilot does is a value of this struct: PX4 1.17 and ArduPilot 4.7 (Rover, Copter, Plane) as they were seen
// on the wire, and as their sources have it where they were not; and `plain`, which is what godwit's own ground port
// does: by the MAVLink text, atomic, with plan ids. One server serves them all, so that a client is tested against the
// code that also serves ground stations. Thread: values.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "actors/domain/mission/commands/command_table.hpp"
#include "actors/ground_port/mission_server/texts.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/time_units.hpp"

namespace godwit::ground_port::mission_server {

// In which message an item is asked for.
enum class request_kind { mission_request, mission_request_int };

// In answer to an item that is not the one asked for, a repeated one included.
enum class out_of_order { ignored, acknowledged_as_error, asked_for_again };

// In answer to the last item again, when the transfer has been acknowledged.
enum class last_item_again { accepted_again, error, ignored };

// In answer to an item when no transfer is open.
enum class stray_item { error, ignored };

// In answer to an item of a station while another has a transfer. `by_order`: INVALID_SEQUENCE if it is not the one
// that the other was asked for, else DENIED.
enum class foreign_item { error, ignored, by_order };

// In answer to MISSION_COUNT from the station whose upload is open. `asks_again_before_item_1`: the new count is not
// taken; the item is asked for again if it is the first one, else the vehicle is busy.
enum class count_again { begins_again, asks_again_before_item_1 };

// At the end of its patience.
enum class giving_up { silent, tells };

// While a plan is being downloaded: who has to wait. `everybody`: an upload or a clear of the reader itself as well,
// until it has closed the download.
enum class while_read { nobody_waits, others_wait, everybody_waits };

// MISSION_WRITE_PARTIAL_LIST, which replaces some items of a plan that is held.
enum class partial_list { unsupported, ignored, taken };

// Which messages are for the vehicle: those with its address; with component 0 of its system as well; with any
// component of its system, and with system 0.
enum class accepted_address { own_address, component_0_too, everything };

// How a fence is judged: that polygons have 3 vertices at least and as many as they say, and circles a radius.
struct fence_profile {
  mavlink::mav_mission_result refusal = mavlink::mav_mission_result::invalid_param1;
  bool counts_vertices_only = false; // does not compare them with what follows, and takes any circle
  bool judges_at_the_end = false;    // and keeps the old fence until then, whatever it does with missions
};

struct server_profile {
  request_kind asks_with = request_kind::mission_request_int;
  bool asks_in_both_ways = true; // by turns when there is no answer: some stations know only the older request
  std::int64_t asks_again_ns = 1'000 * ns_per_ms;
  std::int64_t gives_up_ns = 5'000 * ns_per_ms; // after the last message of the station
  giving_up when_giving_up = giving_up::silent;

  out_of_order when_out_of_order = out_of_order::asked_for_again;
  last_item_again when_last_item_comes_again = last_item_again::accepted_again;
  stray_item when_no_transfer = stray_item::error;
  foreign_item when_item_is_foreign = foreign_item::error;
  count_again when_count_comes_again = count_again::begins_again;

  // What is answered to MISSION_COUNT, MISSION_REQUEST_LIST and MISSION_CLEAR_ALL while another transfer is open;
  // none: nothing.
  std::optional<mavlink::mav_mission_result> when_busy = mavlink::mav_mission_result::denied;
  std::optional<mavlink::mav_mission_result> when_list_is_refused = mavlink::mav_mission_result::denied;
  std::optional<mavlink::mav_mission_result> when_clear_is_refused = mavlink::mav_mission_result::denied;
  bool obeys_cancel = true;

  bool refused_count_ends_upload = true; // of the station that sent it

  while_read when_read = while_read::others_wait;
  bool list_ends_a_full_download = false; // of which each item was given, and which was not acknowledged
  bool serves_earlier_items = true;       // in order, and again what was served; else only the last one again
  bool serves_any_item = false;           // in a download: any item, at any time; else in order, after a request list
  bool tells_count_to_the_lost = false;   // MISSION_COUNT before the refusal of an item that is not there
  bool serves_float_items = true;         // MISSION_ITEM in answer to MISSION_REQUEST; else UNSUPPORTED
  bool takes_float_items = false;         // MISSION_ITEM in an upload
  partial_list when_partial = partial_list::unsupported;
  accepted_address accepts = accepted_address::own_address;

  // One message of a transfer is taken in each turn of the main loop. 0: at once.
  std::int64_t turn_ns = 0;

  bool is_atomic = true; // the old plan stays until the new one is complete
  bool has_plan_ids = true;
  bool rewrites_items = false; // as ArduPilot: frame 3 for 6, without the parameters that it does not use
  bool marks_current = false;  // gives `current` 1 back with the item of the mission at which the vehicle is
  std::optional<mavlink::mission_item_int> home; // item 0 of a mission, whatever is uploaded there

  bool clears_all_types_at_once = true;
  // While the mission is flown; none: it is cleared all the same.
  std::optional<mavlink::mav_mission_result> when_cleared_in_flight = mavlink::mav_mission_result::denied;
  std::optional<mavlink::mav_mission_result> when_counted_0_in_flight = mavlink::mav_mission_result::denied;
  // An item with a command that this vehicle refuses by the table of commands is UNSUPPORTED; none: all that can be an
  // item is taken.
  std::optional<mission::vehicle_profile> profile;
  std::vector<std::uint16_t> also_takes = {}; // as items of a mission: commands that the table does not have
  bool checks_type = true; // UNSUPPORTED for an unknown mission type; else it is cleared, and has no space
  bool checks_latitude = true;
  fence_profile fence;
  int capacity = 1'000; // items of one plan; more: NO_SPACE
  std::span<const text_row> texts = plain_texts();
};

[[nodiscard]] server_profile plain_profile();
[[nodiscard]] server_profile px4_profile();
[[nodiscard]] server_profile ardupilot_copter_profile();
[[nodiscard]] server_profile ardupilot_plane_profile();
[[nodiscard]] server_profile ardupilot_rover_profile();

} // namespace godwit::ground_port::mission_server
