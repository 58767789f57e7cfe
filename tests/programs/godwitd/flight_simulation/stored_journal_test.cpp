// Journals of a version that wrote one event in each handler, from processes that were killed in flight: they open, and
// the flight goes on. They were written by this simulation, with seed 1, and are read as the disk of its next process.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "io/mavlink/messages/current_mode.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"

namespace stored_journal_test {

using namespace godwit;
using namespace godwit::drill;
using mission::progress_kind;

runtime::recovered records_of(const nlohmann::json& stored) {
  runtime::recovered result;
  if (stored.contains("snapshot")) {
    const auto& s = stored["snapshot"];
    result.snapshot = runtime::snapshot_record{s["number"], s["at_ns"], s["version"], s["body"].dump()};
  }
  for (const auto& each : stored["events"])
    result.events.push_back({each["number"], each["at_ns"], each["type"], each["body"].dump()});
  for (const auto& each : stored["effects"])
    result.effects.push_back({{each["event"], each["n"]}, each["type"], each["body"].dump(), each["answer_to"]});
  for (const auto& each : stored["seen"])
    result.seen.push_back({each["source"], {each["event"], each["n"]}});
  result.last_event = stored["last_event"];
  return result;
}

void load(const std::string& name, runtime::simulated_disk& disk) {
  std::ifstream file(GODWIT_TEST_DATA "/journals/before_one_write/" + name + ".json");
  ASSERT_TRUE(file) << name;
  disk.actors.clear();
  const auto stored = nlohmann::json::parse(file);
  for (const auto& [actor, records] : stored.items())
    disk.actors[actor].kept = records_of(records);
}

class stored_journal : public testing::TestWithParam<sim::personality> {
protected:
  // As the vehicle was when the journals were written: what is told again must be told as it was then.
  flight_simulation flight{{.who = GetParam(), .beats_at_mode_change = false, .vehicle_line = "tcp://127.0.0.1:5760"}};

  // Nor was CURRENT_MODE asked for.
  stored_journal() {
    std::erase_if(flight.outside().settings.link.streams,
                  [](const auto& each) { return each.message == io::mavlink::current_mode::message_id; });
  }

  void go_on_with(const std::string& moment) {
    flight.kill_process();
    load(std::string(io::name_of(GetParam())) + "_" + moment, flight.outside().journal);
    flight.run_for(1);
    for (const auto* each :
         {"executor", "failsafe", "vehicle_link", "ground_port", "mission_client", "mapobjects_store"})
      EXPECT_EQ(flight.process()->crashes(each), 0U) << each << "\n" << flight.story();
    EXPECT_TRUE(fly_with_help(flight)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
};

TEST_P(stored_journal, of_a_flight_under_way_opens_and_the_flight_goes_on) {
  const auto has_been_there = [&] {
    return std::ranges::any_of(
        flight.reports(), [](const auto& each) { return each.kind == progress_kind::reached && each.item_id == "w1"; });
  };
  ASSERT_TRUE(flight.run_until(has_been_there, 120)) << flight.story();
  go_on_with("flying");
}

TEST_P(stored_journal, of_a_start_under_way_opens_and_the_flight_goes_on) {
  ASSERT_TRUE(flight.run_until_phase(executor::phase::starting, 120)) << flight.story();
  go_on_with("starting");
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, stored_journal,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace stored_journal_test
