// One flight of a drill with its judges: what goes wrong is made by the drill, what must hold is asked here.
// Thread: one.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "programs/godwit-drill/flights/flight_outcome.hpp"

namespace godwit::drill {

enum class flight_ends {
  as_planned,
  or_waits_with_the_rest // of its mission: it can not be flown from where the vehicle stands, and a person knows it
};

// Of all flights of a drill.
struct flight_wishes {
  planted_flaw planted = planted_flaw::none;
  bool tells_story = false; // also of a flight without a flaw
  // Positions a second; as the vehicle's world is fast, when it is not set. Of random flights.
  std::optional<double> stream_hz = {};
  std::string trace_folder = {}; // what its actors did is kept there; empty: it is not
};

class watched_flight {
public:
  // Of short_mission(), or of MISSION.
  watched_flight(const flight_simulation::options& wanted, const flight_wishes& wishes, std::string name,
                 std::string group);
  watched_flight(flight_simulation::options wanted, const mission::document& mission, const flight_wishes& wishes,
                 std::string name, std::string group);

  [[nodiscard]] flight_simulation& flight() { return flight_; }
  [[nodiscard]] flight_outcome& so_far() { return outcome_; }
  // A sentence; empty ones are no flaw.
  void expect(const std::string& flaw);
  // The longest one counts.
  void note_recovery(double ms);
  void note_recovery_since(std::int64_t since_ns); // until now
  // Lets it come to its end with the help of people, and asks all judges; the vehicle must stand where its mission
  // leads.
  [[nodiscard]] flight_outcome finish(flight_ends how = flight_ends::as_planned);
  // The same, where a person has led the vehicle away: it may also wait for a person, and say for what.
  [[nodiscard]] flight_outcome finish_or_wait();
  // As it is now: asks the judges of what has happened so far.
  [[nodiscard]] flight_outcome judge();

private:
  flight_wishes wishes_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  flight_simulation flight_;
  flight_outcome outcome_;
};

} // namespace godwit::drill
