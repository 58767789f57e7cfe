// Items, plans, and a vehicle whose happenings can be compared as text. For tests.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/flight/flight.hpp"
#include "programs/godwit-sim/vehicle/flight/item_place.hpp"

namespace godwit::sim::test {

using item = io::mavlink::mission_item_int;
using plan = std::vector<item>;

constexpr position home{47, 8, 400};
constexpr std::int64_t second_ns = 1'000'000'000;

// COMMAND at a place NORTH and EAST of home, Z metres above home.
item at(std::uint16_t command, double north_m, double east_m, float z = 10);
item waypoint(double north_m, double east_m, float z = 10, float hold_s = 0);
// Without a place: for DO commands, delays and returns.
item command(std::uint16_t command, float param1 = 0, float param2 = 0);
item jump_to(int sequence, int repeats);
item held(item which); // autocontinue 0

// Such as "begun 0", "reached 0", "skipped 1: command 201 is not known", "took off", "landed", "arrived", "completed".
std::string text_of(const happening& what);

// A vehicle and what it said, with the time of each in seconds.
struct trip {
  explicit trip(const craft& what) : vehicle(what, home) {}

  flight vehicle;
  std::vector<std::string> said;
  std::vector<double> said_at_s;
  std::int64_t now_ns = 0;

  // Follows the mission from FIRST on.
  void follow(const plan& items, int first = 0, int last = -1);
  void run(double seconds);
  // Step by step. False: it was not so within the time.
  [[nodiscard]] bool run_until(const std::function<bool()>& is_so, double within_s = 600);
  [[nodiscard]] bool run_until_said(const std::string& what, double within_s = 600);
  [[nodiscard]] double time_of(const std::string& what) const; // -1: never said
  [[nodiscard]] double from_home_m() const;
};

trip rover();
trip multirotor();

} // namespace godwit::sim::test
