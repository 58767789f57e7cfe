// The trace as people tell a flight: phases, who has the vehicle, modes, commands, plans, failsafes, restarts, reports.
//
// One row for each type of message that means something to people; the same as before says nothing. Thread: one at a
// time.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::trace_tool {

enum class flight_matter { process, phase, control, vehicle, command, plan, failsafe, actor, report, text };

GODWIT_ENUM_NAMES(flight_matter, process, phase, control, vehicle, command, plan, failsafe, actor, report, text);

struct flight_event {
  std::int64_t at_ns = 0;
  std::uint64_t run = 0;
  std::uint64_t id = 0; // of the message that tells it
  flight_matter matter = flight_matter::text;
  std::string sentence;
  bool is_bad = false;
};

class flight_events {
public:
  explicit flight_events(const runtime::name_table& names);

  // In the order of time. What EACH means to people, if it means something.
  [[nodiscard]] std::optional<flight_event> take(const runtime::delivery& each);

private:
  struct saying {
    flight_matter matter = flight_matter::text;
    std::string sentence;
    bool is_bad = false;
  };
  enum class how_often {
    always,
    when_another, // the same sentence as the last one of its kind says nothing
    once_a_run    // nor does any that was said before
  };
  using reader = std::optional<saying> (*)(const nlohmann::json& message, const runtime::delivery& each,
                                           const runtime::name_table& names);
  struct row {
    const char* type;
    const char* actor; // the one among its receivers that counts; null: whoever
    reader read;
    how_often told;
  };
  static const row rows[];

  const runtime::name_table& names_;
  std::vector<const row*> by_type_; // by the number of the name; null: not known yet, or none
  std::vector<bool> is_looked_up_;
  std::map<const row*, std::string> last_; // sentences
  std::set<std::string> said_;             // of those that are told once a run
  std::uint64_t run_ = 0;
  bool has_begun_ = false;
};

} // namespace godwit::trace_tool
