#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

#include <algorithm>
#include <cmath>

#include "programs/godwit-sim/vehicle/world/angle.hpp"

namespace godwit::sim::test {
namespace {

struct speaker {
  std::string operator()(const took_off&) const { return "took off"; }
  std::string operator()(const landed&) const { return "landed"; }
  std::string operator()(const arrived&) const { return "arrived"; }
  std::string operator()(const item_begun& it) const { return "begun " + std::to_string(it.sequence); }
  std::string operator()(const item_reached& it) const { return "reached " + std::to_string(it.sequence); }
  std::string operator()(const item_skipped& it) const {
    return "skipped " + std::to_string(it.sequence) + ": " + it.reason;
  }
  std::string operator()(const command_executed& e) const { return "executed " + std::to_string(e.sequence); }
  std::string operator()(const pictured&) const { return "pictured"; }
  std::string operator()(const load_moved& e) const { return e.is_released ? "released" : "grabbed"; }
  std::string operator()(const mission_completed&) const { return "completed"; }
};

} // namespace

item at(std::uint16_t command, double north_m, double east_m, float z) {
  const auto place = moved(home, {std::atan2(east_m, north_m) / degree, std::hypot(north_m, east_m)});
  item made;
  made.command = command;
  made.frame = 3;
  made.autocontinue = 1;
  made.x = static_cast<std::int32_t>(std::lround(place.latitude_deg * 1e7));
  made.y = static_cast<std::int32_t>(std::lround(place.longitude_deg * 1e7));
  made.z = z;
  return made;
}

item waypoint(double north_m, double east_m, float z, float hold_s) {
  auto made = at(nav_waypoint, north_m, east_m, z);
  made.param1 = hold_s;
  return made;
}

item command(std::uint16_t command, float param1, float param2) {
  item made;
  made.command = command;
  made.frame = 2;
  made.autocontinue = 1;
  made.param1 = param1;
  made.param2 = param2;
  return made;
}

item jump_to(int sequence, int repeats) {
  return command(do_jump, static_cast<float>(sequence), static_cast<float>(repeats));
}

item held(item which) {
  which.autocontinue = 0;
  return which;
}

std::string text_of(const happening& what) { return std::visit(speaker{}, what); }

void trip::follow(const plan& items, int first, int last) {
  vehicle.mission().load(items);
  vehicle.mission().start(first, last);
  vehicle.set_task(task::follow_mission{});
}

void trip::run(double seconds) {
  const std::int64_t end_ns = now_ns + std::llround(seconds * 1e9);
  while (now_ns < end_ns) {
    now_ns = std::min(end_ns, now_ns + craft::step_ns);
    for (const auto& each : vehicle.advance(now_ns)) {
      said.push_back(text_of(each));
      said_at_s.push_back(static_cast<double>(now_ns) * 1e-9);
    }
  }
}

bool trip::run_until(const std::function<bool()>& is_so, double within_s) {
  for (const std::int64_t end_ns = now_ns + std::llround(within_s * 1e9); now_ns < end_ns;) {
    run(static_cast<double>(craft::step_ns) * 1e-9);
    if (is_so())
      return true;
  }
  return false;
}

bool trip::run_until_said(const std::string& what, double within_s) {
  return run_until([&] { return !said.empty() && time_of(what) >= 0; }, within_s);
}

double trip::time_of(const std::string& what) const {
  const auto found = std::find(said.begin(), said.end(), what);
  return found == said.end() ? -1 : said_at_s[static_cast<std::size_t>(found - said.begin())];
}

double trip::from_home_m() const { return between(home, vehicle.where().where).distance_m; }

trip rover() { return trip(rover_craft()); }
trip multirotor() { return trip(multirotor_craft()); }

} // namespace godwit::sim::test
