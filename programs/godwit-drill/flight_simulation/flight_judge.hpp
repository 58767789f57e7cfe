// What must hold of every flight, whatever has happened in it. Thread: one.
#pragma once

#include <cstdint>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"

namespace godwit::drill {

// Of what the service has got: no report named an item that it does not know, none is missing or doubled, they came in
// order, no generation or index goes back, nothing comes of a revision after its completion; when the mission is done
// each of its items was told. A report that the service has already may come again, with the same content: its answer
// was lost. Empty: it holds; else a sentence.
[[nodiscard]] std::string flaw_of_reports(flight_simulation& flight);

// The same of one mission of several that is done: its reports, as the service has them, count from 1 without a gap,
// tell of each of its items, and end with its completion. Empty: it holds.
[[nodiscard]] std::string flaw_of_mission(flight_simulation& flight, const std::string& mission_id);

// Reports that are missing, or items that no report tells of although the mission is done; and what was told twice.
struct report_counts {
  std::uint64_t lost = 0;
  std::uint64_t doubled = 0;
};
[[nodiscard]] report_counts count_reports(flight_simulation& flight);

// A mission that is done ends on the ground, near where its last item leads. Empty: it does, or is not done.
[[nodiscard]] std::string flaw_of_place(flight_simulation& flight);

// What a report says was reached the vehicle had been at; nothing took its plan from it while it was armed; and no plan
// and no start went out before its intent was on the disk. Empty: it is so.
[[nodiscard]] std::string flaw_of_truth(flight_simulation& flight);

// It has its end, or waits for a person and says for what.
[[nodiscard]] std::string flaw_of_end(const flight_simulation& flight);

[[nodiscard]] bool moves_vehicle(const vehicle_order& order);
// Orders since SINCE_NS that move the vehicle or could: modes, arming, starts, another item, another plan. Not the mode
// that takes the mission mode from a vehicle on the ground, so that nothing moves by itself.
[[nodiscard]] int moves_since(const flight_simulation& flight, std::int64_t since_ns);
// Those of them that are no transfer of a plan: a vehicle that stands may be brought one.
[[nodiscard]] int starts_since(const flight_simulation& flight, std::int64_t since_ns);
// Of those what begins the plan: MISSION_START, or the mission mode, by which a PX4 is started.
[[nodiscard]] int missions_started_since(const flight_simulation& flight, std::int64_t since_ns);

} // namespace godwit::drill
