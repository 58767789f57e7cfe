// What became of a transfer, and how far one is.
//
// Each transfer has exactly one outcome, and it is true: `accepted` is said only with a proof that the vehicle has the
// plan, and a failure says what is known of what the vehicle holds now. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::vehicle_link::transfer {

enum class verdict {
  accepted,
  refused,             // the vehicle said no: `result` says how
  timed_out,           // the vehicle was silent for longer than it waits itself; `phase` says when
  cancelled,           // we were asked to stop
  vehicle_holds_other, // all was sent, but what the vehicle gives back is another plan
  not_begun            // nothing was sent: no vehicle, no link, or another transfer is under way
};

GODWIT_ENUM_NAMES(verdict, accepted, refused, timed_out, cancelled, vehicle_holds_other, not_begun);

enum class phase {
  announcing, // MISSION_COUNT waits for the first request
  sending,    // items go up
  resolving,  // all was sent, and the vehicle is asked what it holds
  listing,    // MISSION_REQUEST_LIST waits for the count
  reading,    // items come down
  clearing    // MISSION_CLEAR_ALL waits for its answer
};

constexpr auto enum_names(phase) {
  return io::names<phase>({{phase::announcing, "announcing"},
                           {phase::sending, "sending"},
                           {phase::resolving, "settling"},
                           {phase::listing, "listing"},
                           {phase::reading, "reading"},
                           {phase::clearing, "clearing"}});
}

// Why `accepted` may be said.
enum class proof {
  none,
  acknowledged, // MISSION_ACK, after the vehicle had asked for the first and the last item
  counted,      // MISSION_ACK, and the vehicle holds as many items as the plan has
  plan_id,      // the vehicle's id of its plan has changed, and it holds as many items as the plan has
  read_back     // the plan was read back and means the same
};

GODWIT_ENUM_NAMES(proof, none, acknowledged, counted, plan_id, read_back);

// What the vehicle holds when the transfer has ended.
enum class holding {
  this_plan,
  unchanged, // we have changed nothing
  other,     // looked at: neither this plan nor surely the one before
  unknown    // this plan, the one before, or a mixture where the vehicle replaces item by item
};

GODWIT_ENUM_NAMES(holding, this_plan, unchanged, other, unknown);

struct effort {
  std::uint32_t items_sent = 0;    // with those sent again
  std::uint32_t items_resent = 0;  // of these
  std::uint32_t requests_sent = 0; // in downloads and when reading back
  std::uint32_t warnings = 0;      // MISSION_ACK that did not end anything (ArduPilot's 13 and 1)
  std::uint32_t restarts = 0;      // begun again with MISSION_COUNT
  GODWIT_FIELDS(effort, "vehicle_link.transfer_effort", items_sent, items_resent, requests_sent, warnings, restarts);
  bool operator==(const effort&) const = default;
};

struct outcome {
  transfer::verdict verdict = verdict::timed_out;
  io::mavlink::mav_mission_type mission_type = io::mavlink::mav_mission_type::mission;
  std::uint8_t result = 0;                       // mav_mission_result as the vehicle gave it; of use with `refused`
  transfer::phase phase = phase::announcing;     // where it ended
  transfer::proof proof = proof::none;           // with `accepted`
  transfer::holding holding = holding::unknown;  // of an upload or clear
  std::optional<std::uint16_t> item;             // refused: which; vehicle_holds_other: the first that differs
  std::optional<std::uint32_t> plan_id;          // the vehicle's, where it keeps one
  std::optional<std::uint16_t> items_on_vehicle; // where it was asked
  std::vector<io::mavlink::mission_item_int> items = {}; // of a download that was accepted
  std::int64_t duration_ns = 0;
  transfer::effort effort = {};
  std::string reason = {}; // sentence for people; empty when accepted
  GODWIT_FIELDS(outcome, "vehicle_link.transfer_outcome", verdict, mission_type, result, phase, proof, holding, item,
                plan_id, items_on_vehicle, items, duration_ns, effort, reason);
};

// Item `done` of `total`; never goes down within one transfer.
struct progress {
  std::uint16_t done = 0;
  std::uint16_t total = 0;
  GODWIT_FIELDS(progress, "vehicle_link.transfer_progress", done, total);
  bool operator==(const progress&) const = default;
};

} // namespace godwit::vehicle_link::transfer

namespace godwit::vehicle_link {

// Brings ITEMS to the vehicle as given, numbered from 0: who sends to an ArduPilot puts home in front. No items: the
// plan is cleared. Answered with a transfer::outcome when the transfer is over, which may take as long as the vehicle's
// patience several times.
struct upload_plan {
  io::mavlink::mav_mission_type mission_type = io::mavlink::mav_mission_type::mission;
  std::vector<io::mavlink::mission_item_int> items;
  std::optional<seen_state> only_while = {}; // as in send_command: else it is not begun
  GODWIT_FIELDS(upload_plan, "vehicle_link.upload_plan", mission_type, items, only_while);
};

struct download_plan {
  io::mavlink::mav_mission_type mission_type = io::mavlink::mav_mission_type::mission;
  bool id_suffices = false; // no items are asked for where the vehicle's MISSION_COUNT names the plan (PX4)
  GODWIT_FIELDS(download_plan, "vehicle_link.download_plan", mission_type, id_suffices);
};

struct clear_plan {
  io::mavlink::mav_mission_type mission_type = io::mavlink::mav_mission_type::mission;
  GODWIT_FIELDS(clear_plan, "vehicle_link.clear_plan", mission_type);
};

// The transfer under way ends with `cancelled`.
struct cancel_transfer {
  static constexpr auto fields = io::table("vehicle_link.cancel_transfer");
};

} // namespace godwit::vehicle_link
