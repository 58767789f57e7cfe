// What the failsafe wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/rules.hpp"
#include "actors/failsafe/state.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"

namespace godwit::failsafe {

// To the vehicle, at once: it does not wait for the disk. What became of it comes back as command_settled.
struct command_vehicle {
  static constexpr bool immediate = true;
  std::uint64_t number = 0; // rises with each command, also over a restart
  rule why = rule::operator_link;
  action what = action::return_home;
  std::uint8_t confirmation = 0; // 0 at the first try, one more at each further one

  static constexpr auto fields =
      io::table("failsafe.command_vehicle", io::field("number", &command_vehicle::number),
                io::field("why", &command_vehicle::why), io::field("what", &command_vehicle::what),
                io::field("confirmation", &command_vehicle::confirmation));
};

// To the executor: the flight goes on by this from now on, and the mission ends. Once for each edge that acts.
struct acts {
  rule why = rule::operator_link;
  action what = action::return_home;

  static constexpr auto fields =
      io::table("failsafe.acts", io::field("why", &acts::why), io::field("what", &acts::what));
};

// To the executor: an operator's override has lifted what was done. No command goes out; the operator says what next.
struct lifted {
  rule why = rule::operator_link;
  action what = action::return_home;

  static constexpr auto fields =
      io::table("failsafe.lifted", io::field("why", &lifted::why), io::field("what", &lifted::what));
};

// To the executor: somebody else flies. Failsafes only warn from now on.
struct pilot_seen {
  flight_mode mode;

  static constexpr auto fields = io::table("failsafe.pilot_seen", io::field("mode", &pilot_seen::mode));
};

struct override_answer {
  std::uint64_t key = 0;
  bool taken = false;
  std::string reason; // sentence for people; empty when taken

  static constexpr auto fields =
      io::table("failsafe.override_answer", io::field("key", &override_answer::key),
                io::field("taken", &override_answer::taken), io::field("reason", &override_answer::reason));
};

// To the executor: the limits are watched, or they are refused and the ones from before still count.
struct limits_answer {
  bool taken = false;
  std::string reason; // sentence for people; empty when taken

  static constexpr auto fields = io::table("failsafe.limits_answer", io::field("taken", &limits_answer::taken),
                                           io::field("reason", &limits_answer::reason));
};

// To people.
struct warning {
  io::mavlink::mav_severity severity = io::mavlink::mav_severity::warning;
  std::string text;

  static constexpr auto fields =
      io::table("failsafe.warning", io::field("severity", &warning::severity), io::field("text", &warning::text));
};

enum class wellness { well, impaired, bad };

constexpr auto enum_names(wellness) {
  return io::names<wellness>({{wellness::well, "well"}, {wellness::impaired, "impaired"}, {wellness::bad, "bad"}});
}

// To the health board, at each change.
struct health_changed {
  wellness how = wellness::well;
  std::string reason;

  static constexpr auto fields = io::table("failsafe.health_changed", io::field("how", &health_changed::how),
                                           io::field("reason", &health_changed::reason));
  friend bool operator==(const health_changed&, const health_changed&) = default;
};

// To the journal, in the same turn and not awaited. The last effect of a tick.
struct remember {
  remembered what;
};

using effect = std::variant<command_vehicle, acts, lifted, pilot_seen, override_answer, limits_answer, warning,
                            health_changed, remember>;
using effects = std::vector<effect>;

} // namespace godwit::failsafe
