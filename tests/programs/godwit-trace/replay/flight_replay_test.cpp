// Actors of whole simulated flights, run again from what was recorded of them: they do the same once more, through
// crashes, kills of an actor and kills of the process. What was changed in the record, as a changed core would have
// done it otherwise, is found at its first message.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <string>

#include <nlohmann/json.hpp>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/scan_mission.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-trace/replay/flight_bench.hpp"
#include "programs/godwit-trace/replay/replay_text.hpp"
#include "tests/support/run_options.hpp"

namespace flight_replay_test {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::trace_tool;
using executor::phase;
using runtime::crash_point;

constexpr const char* replayed[] = {"executor",       "failsafe",        "vehicle_link",      "ground_port",
                                    "mission_client", "operator_bridge", "scan_controller",   "telemetry_stream",
                                    "health",         "fleet_link",      "movement_detector", "landing_watch"};

// Changes what the record has of ACTOR as its own actor sees it.
using alteration = std::function<void(const std::string& actor, const runtime::delivery& each, std::string& body)>;

// What the trace would have, in memory.
class recorded_flight {
public:
  explicit recorded_flight(const flight_simulation::options& wanted, alteration alter = {})
      : flight(as_recorded(wanted), mission_for(wanted.who)), alter_(std::move(alter)) {
    auto& settings = flight.outside().settings;
    fleet_link::settings fleet;
    fleet.broker = io::mqtt::parse_broker_uri("mqtts://fleet.example.org").value();
    fleet.vehicle = "rover-7";
    settings.fleet = fleet;
    if (wanted.who == sim::personality::px4) {
      movement_detector::settings camera;
      camera.uri = "test://ball";
      camera.width_px = 640;
      camera.height_px = 360;
      camera.focal_px = 500;
      settings.camera = camera;
      settings.scan.looks_for = {"vehicle"};
      constexpr double near_m = 30;
      const auto at = seen_in_survey(flight, "", near_m, 1).position;
      flight.outside().eyes.movers.push_back({1, at.latitude_deg, at.longitude_deg});
    }
    flight.record().tell([this](const runtime::delivery& each) { take(each); });
  }

  runtime::replay_summary replay(const std::string& actor, std::uint64_t run, runtime::replay_options options = {}) {
    options.monotonic_to_utc_ns = daemon_process::wall_began_ns;
    auto bench = flight_bench::make(actor, flight.outside().settings, {run, flight.record().seed_of(run)});
    EXPECT_TRUE(bench.has_value()) << bench.error();
    auto& record = runs.at({actor, run});
    record.finish();
    return runtime::replayer((*bench)->bench(), record, options).run([](const runtime::replay_step&) {});
  }

  [[nodiscard]] bool has_run(const std::string& actor, std::uint64_t run) const {
    const auto found = runs.find({actor, run});
    return found != runs.end() && !found->second.inputs().empty();
  }

  flight_simulation flight;
  std::map<std::pair<std::string, std::uint64_t>, runtime::recorded_run> runs; // by actor and run

private:
  static flight_simulation::options as_recorded(flight_simulation::options wanted) {
    wanted.is_recorded = true;
    return wanted;
  }
  // One vehicle surveys, so that eyes and points of interest have something to do.
  static mission::document mission_for(sim::personality who) {
    return who == sim::personality::px4 ? scan_mission(who) : short_mission(who);
  }

  void take(const runtime::delivery& each) {
    for (const auto* actor : replayed) {
      auto own = each;
      std::string body(each.body);
      if (alter_)
        alter_(actor, each, body);
      own.body = body;
      runs.try_emplace({actor, each.run}, actor, flight.record().names()).first->second.add(own);
    }
  }

  alteration alter_;
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
  recorded_flight made({.who = GetParam()});
  ASSERT_TRUE(made.flight.run_until_phase(phase::done, 600)) << made.flight.story();
  for (const auto* actor : replayed) {
    if (!made.has_run(actor, 1))
      continue;
    const auto summary = made.replay(actor, 1);
    EXPECT_TRUE(summary.deviations.empty()) << words_of(summary);
    EXPECT_EQ(summary.left_out, 0U) << words_of(summary);
    EXPECT_GT(summary.inputs, 0U) << words_of(summary);
    RecordProperty(actor, summary_text(summary));
  }
  EXPECT_TRUE(made.flight.record().broken().empty());
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, flight_replay,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

// Crashes at each crash point, kills of actors and kills of the process, wherever they fall.
TEST_P(flight_replay, of_a_flight_with_crashes_and_kills_deviates_nowhere) {
  std::size_t incarnations = 0;
  for (std::uint64_t seed = 1; seed <= (tests::is_full_run() ? 30 : 3); ++seed) {
    recorded_flight made({.who = GetParam(), .seed = seed});
    std::mt19937_64 dice(seed);
    auto next_ns = made.flight.now_ns() + 2'000'000'000;
    (void)made.flight.run_until(
        [&] {
          if (made.flight.now_ns() >= next_ns && made.flight.process() != nullptr) {
            next_ns += 3'000'000'000;
            const auto* actor = replayed[dice() % std::size(replayed)];
            const auto fault = dice() % 8;
            if (fault < 4)
              made.flight.process()->crash_at(actor, static_cast<crash_point>(fault));
            else if (fault < 7)
              (void)made.flight.process()->kill(actor);
            else
              made.flight.kill_process();
          }
          return executor::is_at_rest(made.flight.status().now);
        },
        120);
    (void)fly_with_help(made.flight);
    for (auto& [which, record] : made.runs) {
      if (record.inputs().empty())
        continue;
      const auto summary = made.replay(which.first, which.second);
      EXPECT_TRUE(summary.deviations.empty())
          << "seed " << seed << ", run " << which.second << ", " << which.first << ": " << words_of(summary);
      EXPECT_EQ(summary.left_out, 0U) << which.first << ": " << words_of(summary);
      incarnations += summary.incarnations;
    }
    if (HasFailure())
      return;
  }
  RecordProperty("incarnations", std::to_string(incarnations));
}

// -- what was changed ------------------------------------------------------------------------------------

// A number, a word or a flag of BODY is another one.
bool change(nlohmann::json& body) {
  if (body.is_object() || body.is_array())
    return std::any_of(body.begin(), body.end(), [](auto& each) { return change(each); });
  if (body.is_boolean())
    body = !body.get<bool>();
  else if (body.is_number_unsigned())
    body = body.get<std::uint64_t>() ^ 1U;
  else if (body.is_string())
    body = body.get<std::string>() + "?";
  else
    return false;
  return true;
}

class flight_replay_changed : public testing::TestWithParam<const char*> {};

// As if the core had decided otherwise: one field of one thing that it did is another one.
TEST_P(flight_replay_changed, a_decision_that_was_another_one_is_named_first) {
  constexpr int changed_one = 3; // the first ones are made as an incarnation begins
  int seen = 0;
  std::string changed;
  recorded_flight made({}, [&](const std::string& actor, const runtime::delivery& each, std::string& body) {
    const auto& names = made.flight.record().names();
    if (actor != GetParam() || names.name(each.sender) != actor)
      return;
    const bool is_call = each.id == 0 && names.name(each.type) == "runtime.outside_call";
    auto content = nlohmann::json::parse(body, nullptr, false);
    if ((!is_call && (each.id == 0 || names.name(each.actor) == actor)) || !change(content) || ++seen != changed_one)
      return;
    body = content.dump();
    changed = body;
  });
  ASSERT_TRUE(made.flight.run_until_phase(phase::done, 600)) << made.flight.story();
  ASSERT_FALSE(changed.empty());
  const auto summary = made.replay(GetParam(), 1);
  ASSERT_EQ(summary.deviations.size(), 1U) << words_of(summary);
  const auto& found = summary.deviations[0];
  EXPECT_EQ(found.kind, runtime::deviation_kind::differs) << words_of(summary);
  ASSERT_NE(found.expected, nullptr);
  EXPECT_EQ(found.expected->body, changed);
  EXPECT_EQ(found.fields.size(), 1U) << words_of(summary);
}

INSTANTIATE_TEST_SUITE_P(every_core, flight_replay_changed,
                         testing::Values("executor", "failsafe", "vehicle_link", "ground_port", "mission_client",
                                         "scan_controller", "telemetry_stream", "health", "fleet_link",
                                         "movement_detector"),
                         [](const auto& each) { return std::string(each.param); });

// Other settings are another decision: the same words, and nothing is armed.
TEST(flight_replay_settings, others_deviate) {
  recorded_flight made({.who = sim::personality::rover});
  ASSERT_TRUE(made.flight.run_until_phase(phase::done, 300)) << made.flight.story();
  made.flight.outside().settings.flight.start = executor::start_policy::on_command;
  EXPECT_EQ(made.replay("executor", 1).deviations.size(), 1U);
}

TEST(flight_bench, an_actor_that_can_not_be_replayed_is_refused_with_the_reason) {
  flight_simulation flight({});
  auto settings = flight.outside().settings;
  settings.signing_key_file = "vehicle.key";
  for (const auto* actor : {"vehicle_link", "mapobjects_store", "guardian"}) {
    const auto refused = flight_bench::make(actor, settings, {1, 1});
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().find(std::string(actor) + " can not be replayed: "), std::string::npos)
        << refused.error();
  }
  const auto unknown = flight_bench::make("pilot", settings, {1, 1});
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(unknown.error().find("executor, failsafe"), std::string::npos) << unknown.error();
}

} // namespace flight_replay_test
