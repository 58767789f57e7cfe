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
  static constexpr auto fields = io::table(
      "vehicle_link.seen_state", io::field("custom_mode", &seen_state::custom_mode),
      io::field("is_armed", &seen_state::is_armed), io::field("failsafe_command", &seen_state::failsafe_command),
      io::field("foreign_ns", &seen_state::foreign_ns), io::field("looked_ns", &seen_state::looked_ns));
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
  static constexpr auto fields = io::table(
      "vehicle_link.send_command", io::field("command", &send_command::command), io::field("form", &send_command::form),
      io::field("param1", &send_command::param1), io::field("param2", &send_command::param2),
      io::field("param3", &send_command::param3), io::field("param4", &send_command::param4),
      io::field("param5", &send_command::param5), io::field("param6", &send_command::param6),
      io::field("x", &send_command::x), io::field("y", &send_command::y), io::field("z", &send_command::z),
      io::field("frame", &send_command::frame), io::field("confirmation", &send_command::confirmation),
      io::field("target_component", &send_command::target_component),
      io::field("timeout_ms", &send_command::timeout_ms), io::field("copies", &send_command::copies),
      io::field("only_while", &send_command::only_while));
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

constexpr auto enum_names(command_verdict) {
  return io::names<command_verdict>({{command_verdict::accepted, "accepted"},
                                     {command_verdict::refused, "refused"},
                                     {command_verdict::timed_out, "timed_out"},
                                     {command_verdict::not_sent, "not_sent"},
                                     {command_verdict::already_running, "already_running"},
                                     {command_verdict::too_many, "too_many"},
                                     {command_verdict::invalid, "invalid"},
                                     {command_verdict::vehicle_restarted, "vehicle_restarted"},
                                     {command_verdict::outdated, "outdated"}});
}

struct command_outcome {
  std::uint16_t command = 0;
  command_verdict verdict = command_verdict::not_sent;
  std::uint8_t result = 0;         // MAV_RESULT as the vehicle gave it; of use with accepted and refused
  std::int32_t result_param2 = 0;  // as the vehicle gave it
  std::int64_t round_trip_us = -1; // -1: there was no answer
  std::string reason = {};         // sentence for people; empty when accepted
  static constexpr auto fields = io::table(
      "vehicle_link.command_outcome", io::field("command", &command_outcome::command),
      io::field("verdict", &command_outcome::verdict), io::field("result", &command_outcome::result),
      io::field("result_param2", &command_outcome::result_param2),
      io::field("round_trip_us", &command_outcome::round_trip_us), io::field("reason", &command_outcome::reason));
};

// SET_MODE, for vehicles that know no DO_SET_MODE. There is no answer to it: look at the next heartbeat.
struct set_mode {
  std::uint8_t base_mode = 0; // MAV_MODE_FLAG
  std::uint32_t custom_mode = 0;
  std::optional<seen_state> only_while = {}; // as in send_command; else nothing is sent
  static constexpr auto fields =
      io::table("vehicle_link.set_mode", io::field("base_mode", &set_mode::base_mode),
                io::field("custom_mode", &set_mode::custom_mode), io::field("only_while", &set_mode::only_while));
};

// Makes SEQUENCE the current item of the vehicle's mission: DO_SET_MISSION_CURRENT, and MISSION_SET_CURRENT where the
// vehicle does not know that; each in at most copies_of_moving_order. Accepted means that the vehicle acknowledged it,
// or broadcasts this sequence.
struct set_current_item {
  std::uint16_t sequence = 0;                // as the vehicle counts
  std::optional<seen_state> only_while = {}; // as in send_command, and looked at before MISSION_SET_CURRENT again
  static constexpr auto fields =
      io::table("vehicle_link.set_current_item", io::field("sequence", &set_current_item::sequence),
                io::field("only_while", &set_current_item::only_while));
};

// Gives our signing key to the vehicle, or with `off` an all-zero one that ends signing. Only over a link that is
// marked secure, and to a vehicle that stands disarmed. There is no answer to it in MAVLink: that it took effect shows
// in signed frames of the vehicle.
struct set_up_signing {
  bool off = false;
  static constexpr auto fields = io::table("vehicle_link.set_up_signing", io::field("off", &set_up_signing::off));
};

struct signing_answer {
  bool is_sent = false;
  std::string reason; // sentence for people; empty when sent
  static constexpr auto fields =
      io::table("vehicle_link.signing_answer", io::field("is_sent", &signing_answer::is_sent),
                io::field("reason", &signing_answer::reason));
};

} // namespace godwit::vehicle_link
