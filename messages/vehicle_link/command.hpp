// Commands to the vehicle, and what became of them.
//
// ACCEPTED means that the autopilot will try, not that it is done. Each command has exactly one outcome; it is typed,
// so that "refused", "no answer" and "whether it acted is not known" can not be mistaken for each other. vehicle_link
// sends a command in as many copies as it says (one as a rule): who asked decides about trying again, with
// `confirmation` one higher, after looking at the vehicle. Source: MAVLink command protocol, COMMAND_LONG (76),
// COMMAND_INT (75), COMMAND_ACK (77), COMMAND_CANCEL (80).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::vehicle_link {

// In which message a command travels. Positions belong in `in_integers`: a float has 1 m of latitude at best.
enum class command_form { in_floats, in_integers };

constexpr auto enum_names(command_form) {
  return io::names<command_form>(
      {{command_form::in_floats, "COMMAND_LONG"}, {command_form::in_integers, "COMMAND_INT"}});
}

// An order that moves the vehicle goes out in so many copies until its acknowledgement comes, and never again: within
// 200 ms a frame or two may be lost, and nobody has walked up to the vehicle. A copy goes out when the acknowledgement
// of the one before could have come: on a line with a round trip above 200 ms there is none, since it would come to the
// vehicle after what a person does about the first.
inline constexpr std::uint8_t copies_of_moving_order = 3;
inline constexpr std::int64_t copy_after_ms = 80; // at least
inline constexpr std::int64_t copies_within_ms = 200;

// So long a look at the vehicle counts for an order: what was decided on it and has waited longer (for the disk, for a
// process that was stopped) may meet somebody who has come since.
inline constexpr std::int64_t look_counts_ns = 1'000'000'000;

// What the sender of an order knows when it decides.
struct seen_state {
  std::uint32_t custom_mode = 0;      // as the newest heartbeat of the vehicle has it
  bool is_armed = false;              // the same
  std::uint64_t failsafe_command = 0; // the failsafe's last one, in its count; in its own orders: this one
  std::int64_t foreign_ns = 0;        // of the newest foreign_act that it knows of; 0: none
  std::int64_t looked_ns = 0;         // of an order that moves the vehicle: when it was looked at for it; 0: of none
  GODWIT_FIELDS(seen_state, "vehicle_link.seen_state", custom_mode, is_armed, failsafe_command, foreign_ns, looked_ns);
  friend bool operator==(const seen_state&, const seen_state&) = default;
};

struct send_command {
  std::uint16_t command = 0; // MAV_CMD
  command_form form = command_form::in_floats;
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  float param5 = 0;                  // COMMAND_LONG only
  float param6 = 0;                  // COMMAND_LONG only
  std::int32_t x = 0;                // COMMAND_INT only: latitude in 1e-7 degrees, or local
  std::int32_t y = 0;                // COMMAND_INT only: longitude
  float z = 0;                       // param7: altitude in metres in the frame
  std::uint8_t frame = 0;            // MAV_FRAME, COMMAND_INT only
  std::uint8_t confirmation = 0;     // 0 at the first try, one more at each further one
  std::uint8_t target_component = 1; // the autopilot
  std::int64_t timeout_ms = 0;       // 0: the configured one (1 s)
  std::uint8_t copies = 1;           // at most so many, copy_after_ms apart, until the answer comes
  // What the sender knew when it decided: another newest heartbeat here, a command of the failsafe or an act of
  // somebody else that it did not know of, or a look that is too old, and the command is `outdated`. Absent: whatever.
  std::optional<seen_state> only_while;
  GODWIT_FIELDS(send_command, "vehicle_link.send_command", command, form, param1, param2, param3, param4, param5,
                param6, x, y, z, frame, confirmation, target_component, timeout_ms, copies, only_while);
};

enum class command_verdict {
  accepted,
  refused,           // the vehicle said no: `result` says how
  timed_out,         // no answer; whether it acted is not known
  not_sent,          // no vehicle, or the link is down: it did not act
  already_running,   // the same command to the same component waits for its answer: it was not sent
  too_many,          // max_commands_in_flight wait: it was not sent
  invalid,           // it must not be sent to this autopilot; `reason` says why
  vehicle_restarted, // the autopilot started again before it answered; whether it acted is not known
  outdated           // the vehicle is not as it was when it was decided, or the failsafe's (only_while): not sent
};

GODWIT_ENUM_NAMES(command_verdict, accepted, refused, timed_out, not_sent, already_running, too_many, invalid,
                  vehicle_restarted, outdated);

struct command_outcome {
  std::uint16_t command = 0;
  command_verdict verdict = command_verdict::not_sent;
  std::uint8_t result = 0;         // MAV_RESULT as the vehicle gave it; of use with accepted and refused
  std::int32_t result_param2 = 0;  // as the vehicle gave it
  std::int64_t round_trip_us = -1; // -1: there was no answer
  std::string reason = {};         // sentence for people; empty when accepted
  GODWIT_FIELDS(command_outcome, "vehicle_link.command_outcome", command, verdict, result, result_param2, round_trip_us,
                reason);
};

// SET_MODE, for vehicles that know no DO_SET_MODE. There is no answer to it: look at the next heartbeat.
struct set_mode {
  std::uint8_t base_mode = 0; // MAV_MODE_FLAG
  std::uint32_t custom_mode = 0;
  std::optional<seen_state> only_while = {}; // as in send_command; else nothing is sent
  GODWIT_FIELDS(set_mode, "vehicle_link.set_mode", base_mode, custom_mode, only_while);
};

// Makes SEQUENCE the current item of the vehicle's mission: DO_SET_MISSION_CURRENT, and MISSION_SET_CURRENT where the
// vehicle does not know that; each in at most copies_of_moving_order. Accepted means that the vehicle acknowledged it,
// or broadcasts this sequence.
struct set_current_item {
  std::uint16_t sequence = 0;                // as the vehicle counts
  std::optional<seen_state> only_while = {}; // as in send_command, and looked at before MISSION_SET_CURRENT again
  GODWIT_FIELDS(set_current_item, "vehicle_link.set_current_item", sequence, only_while);
};

// Gives our signing key to the vehicle, or with `off` an all-zero one that ends signing. Only over a link that is
// marked secure, and to a vehicle that stands disarmed. There is no answer to it in MAVLink: that it took effect shows
// in signed frames of the vehicle.
struct set_up_signing {
  bool off = false;
  GODWIT_FIELDS(set_up_signing, "vehicle_link.set_up_signing", off);
};

struct signing_answer {
  bool is_sent = false;
  std::string reason; // sentence for people; empty when sent
  GODWIT_FIELDS(signing_answer, "vehicle_link.signing_answer", is_sent, reason);
};

} // namespace godwit::vehicle_link
