// One flight of a drill with its judges: what goes wrong is made by the drill, what must hold is asked here.
// Thread: one.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

// What a drill by seed adds for each of its numbered faults, so that each is drawn for itself.
inline constexpr std::uint64_t far_from_other_seeds = 0x9e37'79b9'7f4a'7c15;

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

// Flaws that the drills have found and that are not mended yet; each is entered in docs/roadmap.md.
//
// A flaw is known by its case and by its sentence: anything else that goes wrong in such a flight is a flaw as before.
// Thread: constants.
struct known_finding {
  std::string_view in_name; // part of the names of its cases
  std::string_view in_flaw; // part of its sentence
};

[[nodiscard]] std::span<const known_finding> known_findings();

// Moves those of ALL among the flaws of EACH to `known`.
void set_known_aside(flight_outcome& each, std::span<const known_finding> all = known_findings());

// A person has just taken the vehicle of a flight: godwit must see it, and command nothing from then on. Thread: one.

// Into the mode in which a pilot flies, or drives, by hand. False: it is in that one already, and nobody can see it.
[[nodiscard]] bool take_by_hand(flight_simulation& flight);

// MUST_SEE: else it is enough that nothing is commanded, as on the ground.
void expect_left_alone(watched_flight& watched, bool must_see = true);

} // namespace godwit::drill
