// How many commits of the journal, each of them a wait for the disk, lie between two moments of a flight.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"

namespace commits_test {

using namespace godwit;
using namespace godwit::drill;

class commits : public testing::TestWithParam<sim::personality> {};

constexpr std::uint32_t mission_count = 44; // MAVLink

bool has_event(flight_simulation& flight, const std::string& actor, const std::string& type) {
  const auto& events = flight.outside().journal.actors[actor].kept.events;
  return std::ranges::any_of(events, [&](const auto& each) { return each.type == type; });
}

// Writes of events, by those through whom the mission goes; that an effect was taken is noted beside the way.
TEST_P(commits, from_a_mission_that_is_loaded_to_its_upload_are_at_most_three) {
  flight_simulation flight({.who = GetParam()});
  ASSERT_TRUE(
      flight.run_until([&] { return has_event(flight, "mission_client", "mission_client.mission_fetched"); }, 60))
      << flight.story();
  int writes = 0;
  std::map<std::string, std::int64_t> last;
  const auto count = [&] {
    for (const std::string actor : {"executor", "mission_client"}) {
      const auto now = flight.outside().journal.actors[actor].kept.last_event;
      const auto before = last.try_emplace(actor, now).first->second;
      writes += now != before ? 1 : 0;
      last[actor] = now;
    }
  };
  ASSERT_TRUE(flight.run_until(
      [&] {
        count();
        return std::ranges::any_of(flight.orders(), [](const auto& each) { return each.message_id == mission_count; });
      },
      60))
      << flight.story();
  RecordProperty("writes", writes);
  EXPECT_LE(writes, 3) << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, commits,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace commits_test
