// How the program is: the health of each part, and the worst of all. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::health {

enum class colour {
  green,
  yellow, // it goes on, and a person should know
  red     // something that is wanted does not work
};

GODWIT_ENUM_NAMES(colour, green, yellow, red);

struct part_health {
  std::string part; // an actor, or another part of the program such as the journal
  colour health = colour::green;
  std::string reason;        // sentence for people; may be empty when all is well
  std::int64_t since_ms = 0; // since 1970 (UTC): when it took this colour, as far as this incarnation has seen
  GODWIT_FIELDS(part_health, "health.part", part, health, reason, since_ms);
  friend bool operator==(const part_health&, const part_health&) = default;
};

// Told to listeners when it changes, as a whole: hearing it twice, or not hearing one of two, does no harm.
struct health_status {
  colour worst = colour::green;
  std::int64_t since_ms = 0;      // since the worst of all has this colour
  std::vector<part_health> parts; // the worst first, then by name; a part of which nothing was heard is not there
  GODWIT_FIELDS(health_status, "health.status", worst, since_ms, parts);
  friend bool operator==(const health_status&, const health_status&) = default;
};

struct get_health {
  static constexpr auto fields = io::table("health.get_health");
};

// Make a new report. It is not answered: the report goes to the report_port.
struct make_report {
  static constexpr auto fields = io::table("health.make_report");
};

} // namespace godwit::health
