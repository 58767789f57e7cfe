// What of ground_port must survive a crash: the plans that stations have uploaded, the last MISSION_START and its
// answer, the start item, and how far signing time is used up.
//
//   event                    effects, once it is on the disk
//   plan_noted               plan_taken or plan_cleared to the executor, then plan_resolved: the ACK may go out
//   start_noted, asked       start_mission to the executor
//   start_noted, resolved     start_resolved: the COMMAND_ACK and the text go out
//   start_item_noted         start_item_resolved: the answer goes out
//   signing_time_reserved    itself: the permission to use it
//
// So a station hears of nothing that a crash could take back, and the executor is asked once in effect for each start
// that is meant. A transfer in progress is not kept. Thread: plain values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "messages/executor/types.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::ground_port {

// An item of a plan as it is kept on the disk: exactly as it came.
//
// Its id is a checksum of every bit, and JSON carries neither infinities nor the bits of a NaN (many stations send NaN
// for "any yaw"). So the floats are kept as the integers with the same bits. Thread: values.
struct kept_item {
  std::uint16_t command = 0;
  std::uint8_t frame = 0;
  std::uint8_t current = 0;
  std::uint8_t autocontinue = 0;
  std::uint8_t mission_type = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::array<std::uint32_t, 5> float_bits{}; // param1 to param4, z
  GODWIT_FIELDS(kept_item, "ground_port.kept_item", command, frame, current, autocontinue, mission_type, x, y,
                float_bits);
};

// Without the address; the sequence of an item is its place in the list.
[[nodiscard]] std::vector<kept_item> keep(const std::vector<io::mavlink::mission_item_int>& items);
[[nodiscard]] std::vector<io::mavlink::mission_item_int> restore(const std::vector<kept_item>& items);

// All signing times of this link below the ceiling may have been used. Units: 10 us since 2015-01-01 UTC.
struct signing_time_reserved {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  std::uint64_t ceiling = 0;
  GODWIT_FIELDS(signing_time_reserved, "ground_port.signing_time_reserved", ceiling);
};

// The plan of this type is this one now; without items: none.
struct plan_noted {
  std::uint64_t ticket = 0; // tells which plan_resolved belongs to it
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  std::uint32_t plan_id = 0;
  std::vector<kept_item> items;
  std::optional<std::uint16_t> start_item; // of a mission, where the station marked one
  bool from_executor = false;              // which then need not be told
  executor::station by;
  std::optional<io::mavlink::mission_ack> ack; // what the station waits for; of CLEAR_ALL with the last type alone
  GODWIT_FIELDS(plan_noted, "ground_port.plan_noted", ticket, type, plan_id, items, start_item, from_executor, by, ack);
};

struct plan_resolved {
  std::uint64_t ticket = 0;
  std::optional<io::mavlink::mission_ack> ack;
  std::int64_t at_ns = 0; // ns since 1970 (UTC)
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  std::uint32_t plan_id = 0; // 0: of a clear
  GODWIT_FIELDS(plan_resolved, "ground_port.plan_settled", ticket, ack, at_ns, type, plan_id);
};

// A MISSION_START that was given to the executor, and what became of it.
struct start_record {
  executor::start_mission asked;                                                    // its key tells starts apart
  std::uint16_t command = io::mavlink::number(io::mavlink::mav_cmd::mission_start); // that is answered; 0: none is
  std::uint8_t asked_component = 0; // of the vehicle's system, which answers
  float first_item = 0;             // as the station sent them
  float last_item = 0;
  std::int64_t asked_at_ns = 0; // ns since 1970 (UTC)
  bool is_resolved = false;
  bool is_answered = false;        // resolved by the executor, and not because it was silent
  bool is_correction = false;      // it answered after its silence had resolved it
  std::uint8_t result = 0;         // MAV_RESULT, when resolved
  std::string text;                // for STATUSTEXT, when resolved
  std::int64_t resolved_at_ns = 0; // ns since 1970 (UTC)
  static constexpr auto fields = io::table(
      "ground_port.start_record", io::field("asked", &start_record::asked),
      io::field("command", &start_record::command), io::field("asked_component", &start_record::asked_component),
      io::field("first_item", &start_record::first_item), io::field("last_item", &start_record::last_item),
      io::field("asked_at_ns", &start_record::asked_at_ns), io::field("is_settled", &start_record::is_resolved),
      io::field("is_answered", &start_record::is_answered), io::field("is_correction", &start_record::is_correction),
      io::field("result", &start_record::result), io::field("text", &start_record::text),
      io::field("settled_at_ns", &start_record::resolved_at_ns));
};

struct start_noted {
  start_record record;
  GODWIT_FIELDS(start_noted, "ground_port.start_noted", record);
};

struct start_resolved {
  start_record record;
  GODWIT_FIELDS(start_resolved, "ground_port.start_settled", record);
};

// The mission is not running, and will begin here. Without an index: the choice is used up.
struct start_item_noted {
  std::uint64_t ticket = 0; // tells which start_item_resolved belongs to it
  std::optional<std::uint16_t> index;
  std::optional<io::mavlink::command_ack> ack; // none: it was asked for without a command
  GODWIT_FIELDS(start_item_noted, "ground_port.start_item_noted", ticket, index, ack);
};

struct start_item_resolved {
  std::uint64_t ticket = 0;
  std::optional<std::uint16_t> index;
  std::optional<io::mavlink::command_ack> ack;
  std::int64_t at_ns = 0; // ns since 1970 (UTC)
  GODWIT_FIELDS(start_item_resolved, "ground_port.start_item_settled", ticket, index, ack, at_ns);
};

struct kept_plan {
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  std::uint32_t plan_id = 0;
  std::vector<kept_item> items;
  GODWIT_FIELDS(kept_plan, "ground_port.kept_plan", type, plan_id, items);
};

// A station shows this mission: it has uploaded it, also where that was not taken. 0: none.
struct plan_view {
  executor::station by;
  std::uint32_t plan_id = 0;
  GODWIT_FIELDS(plan_view, "ground_port.plan_view", by, plan_id);
};

// As many as stations are known at all; at the bound the one that was noted longest ago makes room.
inline constexpr std::size_t max_plan_views = 16;
void note_view(std::vector<plan_view>& among, const plan_view& what);

struct state {
  std::uint64_t signing_ceiling = 0;
  std::vector<kept_plan> plans;            // at most one of each type; a type without a plan is absent
  std::optional<std::uint16_t> start_item; // chosen by a station, and no start has used it yet
  std::optional<start_record> last_start;
  std::vector<plan_view> views; // by uploads
  static constexpr int version = 1;
  GODWIT_FIELDS(state, "ground_port.state", signing_ceiling, plans, start_item, last_start, views);
};

struct durable_core {
  using state = ground_port::state;
  using event = std::variant<signing_time_reserved, plan_noted, start_noted, start_item_noted>;
  using effect = std::variant<signing_time_reserved, executor::plan_taken, executor::plan_cleared, plan_resolved,
                              executor::start_mission, start_resolved, start_item_resolved>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t now_ns);
  // What is owed is in the journal.
  [[nodiscard]] static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

} // namespace godwit::ground_port
