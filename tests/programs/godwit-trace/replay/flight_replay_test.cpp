// Actors of whole simulated flights, run again from what was recorded of them: they do the same once more, through
// crashes, kills of an actor and kills of the process. What was changed in the record, as a changed core would have
// done it otherwise, is found at its first message.
#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <random>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-trace/replay/flight_desk.hpp"
#include "programs/godwit-trace/replay/replay_text.hpp"
#include "tests/support/run_options.hpp"

namespace {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::trace_tool;
using executor::phase;
using runtime::crash_point;

constexpr const char* replayed[] = {"executor", "failsafe"};

// What the trace would have, in memory.
class recorded_flight {
public:
  explicit recorded_flight(sim::personality who, std::uint64_t seed)
      : flight({.who = who, .seed = seed, .is_recorded = true}) {
    flight.record().tell([this](const runtime::delivery& each) {
      for (const auto* actor : replayed)
        runs.try_emplace({actor, each.run}, actor, flight.record().names()).first->second.add(each);
    });
  }

  runtime::replay_summary replay(const std::string& actor, std::uint64_t run, runtime::replay_options options = {}) {
    options.monotonic_to_utc_ns = daemon_process::wall_began_ns;
    auto desk = flight_desk::make(actor, flight.outside().settings, run);
    EXPECT_TRUE(desk.has_value()) << desk.error();
    auto& record = runs.at({actor, run});
    record.finish();
    return runtime::replayer((*desk)->bench(), record, options).run([](const runtime::replay_step&) {});
  }

  flight_simulation flight;
  std::map<std::pair<std::string, std::uint64_t>, runtime::recorded_run> runs; // by actor and run
};

std::string words_of(const runtime::replay_summary& summary) {
  std::string result = summary_text(summary) + '\n';
  for (const auto& each : summary.notes)
    result += each + '\n';
  for (const auto& each : summary.deviations)
    append_deviation(result, each, paint(false));
  return result;
}

class flight_replay : public testing::TestWithParam<sim::personality> {};

TEST_P(flight_replay, of_a_flight_without_faults_deviates_nowhere) {
  recorded_flight made(GetParam(), 1);
  ASSERT_TRUE(made.flight.run_until_phase(phase::done, 300)) << made.flight.story();
  for (const auto* actor : replayed) {
    const auto summary = made.replay(actor, 1);
    EXPECT_TRUE(summary.deviations.empty()) << words_of(summary);
    EXPECT_EQ(summary.left_out, 0U) << words_of(summary);
    EXPECT_GT(summary.compared, 100U) << words_of(summary);
    EXPECT_TRUE(made.flight.record().broken().empty());
    RecordProperty(actor, summary_text(summary));
  }
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, flight_replay,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

// Crashes at each crash point, kills of both actors and kills of the process, wherever they fall.
TEST_P(flight_replay, of_a_flight_with_crashes_and_kills_deviates_nowhere) {
  std::size_t incarnations = 0;
  for (std::uint64_t seed = 1; seed <= (tests::is_full_run() ? 30 : 3); ++seed) {
    recorded_flight made(GetParam(), seed);
    std::mt19937_64 dice(seed);
    auto next_ns = made.flight.now_ns() + 2'000'000'000;
    (void)made.flight.run_until(
        [&] {
          if (made.flight.now_ns() >= next_ns && made.flight.process() != nullptr) {
            next_ns += 3'000'000'000;
            const auto* actor = replayed[dice() % std::size(replayed)];
            const auto fault = dice() % 6;
            if (fault < 4)
              made.flight.process()->crash_at(actor, static_cast<crash_point>(fault));
            else if (fault == 4)
              (void)made.flight.process()->kill(actor);
            else
              made.flight.kill_process();
          }
          return executor::is_at_rest(made.flight.status().now);
        },
        120);
    (void)fly_with_help(made.flight);
    for (auto& [which, record] : made.runs) {
      const auto summary = made.replay(which.first, which.second);
      EXPECT_TRUE(summary.deviations.empty())
          << "seed " << seed << ", run " << which.second << ": " << words_of(summary);
      EXPECT_EQ(summary.left_out, 0U) << words_of(summary);
      incarnations += summary.incarnations;
    }
    if (HasFailure())
      return;
  }
  RecordProperty("incarnations", std::to_string(incarnations));
}

// As if the core had decided otherwise: one field of one message of the record is another one.
TEST(flight_replay_changed, a_message_that_was_changed_is_named_with_its_field) {
  recorded_flight made(sim::personality::px4, 1);
  std::map<std::string, std::uint64_t> changed; // id of the message, by sender
  made.flight.record().tell([&](const runtime::delivery& each) {
    const auto& names = made.flight.record().names();
    const auto& sender = names.name(each.sender);
    auto altered = each;
    std::string body(each.body);
    const std::string number = "\"command\":";
    if (names.name(each.type) == "vehicle_link.send_command" && sender == "executor" && !changed.contains(sender)) {
      body.insert(body.find(number) + number.size(), "9");
      changed[sender] = each.id;
    }
    altered.body = body;
    made.runs.try_emplace({"executor", each.run}, "executor", made.flight.record().names()).first->second.add(altered);
  });
  ASSERT_TRUE(made.flight.run_until_phase(phase::done, 300)) << made.flight.story();
  ASSERT_TRUE(changed.contains("executor"));
  const auto summary = made.replay("executor", 1);
  ASSERT_EQ(summary.deviations.size(), 1U) << words_of(summary);
  const auto& found = summary.deviations[0];
  EXPECT_EQ(found.kind, runtime::deviation_kind::differs);
  ASSERT_NE(found.expected, nullptr);
  EXPECT_EQ(found.expected->id, changed["executor"]);
  ASSERT_EQ(found.fields.size(), 1U);
  EXPECT_EQ(found.fields[0].field, "command");
  EXPECT_EQ(found.fields[0].expected, "9" + found.fields[0].produced);
}

// Other settings are another decision: the same words, and nothing is armed.
TEST(flight_replay_changed, other_settings_deviate) {
  recorded_flight made(sim::personality::rover, 1);
  ASSERT_TRUE(made.flight.run_until_phase(phase::done, 300)) << made.flight.story();
  made.flight.outside().settings.flight.start = executor::start_policy::on_command;
  EXPECT_EQ(made.replay("executor", 1).deviations.size(), 1U);
}

TEST(flight_desk, actors_whose_inputs_are_not_in_the_trace_are_refused_with_the_reason) {
  flight_simulation flight({});
  for (const auto* actor : {"vehicle_link", "ground_port", "mission_client", "mapobjects_store"}) {
    const auto refused = flight_desk::make(actor, flight.outside().settings, 1);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().find(std::string(actor) + " can not be replayed: "), std::string::npos)
        << refused.error();
  }
  const auto unknown = flight_desk::make("pilot", flight.outside().settings, 1);
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(unknown.error().find("executor, failsafe"), std::string::npos) << unknown.error();
}

} // namespace
