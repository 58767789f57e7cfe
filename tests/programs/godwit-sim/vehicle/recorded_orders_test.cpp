// What real autopilots were seen to answer to commands, parameters, PING and TIMESYNC: the station's frames of each
// recording are given to the simulated vehicle at their recorded times, and it must answer the same in the same order.
//
// Compared are kind, command and result, the names and values of parameters, and the steps of the mission; not times,
// places, or how often something is streamed. The transfers of plans between them are tested with the mission server.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "io/mcap/byte_source.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace recorded_orders_test {

using words = std::vector<std::string>;

struct recorded_frame {
  std::int64_t at_ns = 0; // since the first
  std::vector<std::byte> bytes;
  [[nodiscard]] mavlink::frame_view view() const { return mavlink::frame_view(bytes.data()); }
};

std::vector<recorded_frame> read_recording(const std::string& name) {
  std::vector<recorded_frame> result;
  io::mcap::file_source file;
  if (!file.open(std::string(GODWIT_TEST_DATA) + "/captures/" + name)) {
    ADD_FAILURE() << "no recording " << name;
    return result;
  }
  mavlink::tlog_reader reader(file);
  std::optional<std::uint64_t> first_us;
  for (auto next = reader.next(); next && *next; next = reader.next()) {
    const auto& record = **next;
    first_us = first_us.value_or(record.timestamp_us);
    const auto bytes = record.frame.bytes();
    result.push_back(
        {static_cast<std::int64_t>(record.timestamp_us - *first_us) * 1'000, {bytes.begin(), bytes.end()}});
  }
  return result;
}

template <std::size_t N>
std::string text_of(const std::array<char, N>& text) {
  return {text.begin(), std::find(text.begin(), text.end(), '\0')};
}

std::string short_number(float value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", static_cast<double>(value));
  return text.data();
}

// Where the simulated vehicle is another than the recorded one, and why.
struct deviation {
  std::string recorded;
  std::string simulated;
  std::string reason;
};

struct walk {
  std::string recording;
  personality who;
  std::int64_t until_ns = 0;       // what comes later is about frames that were broken on purpose, or not done
  std::vector<std::string> texts;  // sentences that are compared, by their beginning
  std::vector<std::string> params; // parameters that are compared
  std::vector<deviation> deviations;
};

// A message of the vehicle as a word; empty: it is not compared.
class speller {
public:
  explicit speller(const walk& of) : walk_(of) {}

  std::string spell(const mavlink::frame_view& frame) {
    std::string word;
    mavlink::visit(frame, [&](const auto& message) { word = word_for(message); });
    constexpr std::uint32_t message_interval = 244;
    return frame.id() == message_interval ? "MESSAGE_INTERVAL" : word;
  }

private:
  std::string word_for(const mavlink::command_ack& m) {
    return "ACK " + std::to_string(m.command) + ": " + std::to_string(m.result);
  }
  std::string word_for(const mavlink::autopilot_version&) { return "AUTOPILOT_VERSION"; }
  std::string word_for(const mavlink::protocol_version&) { return "PROTOCOL_VERSION"; }
  std::string word_for(const mavlink::ping& m) { return m.target_system != 0 ? "PING" : ""; }
  std::string word_for(const mavlink::timesync& m) {
    return m.tc1 == 0 ? ""
                      : "TIMESYNC to " + std::to_string(m.target_system) + "/" + std::to_string(m.target_component);
  }
  std::string word_for(const mavlink::param_value& m) {
    const auto name = text_of(m.param_id);
    const bool is_compared = std::find(walk_.params.begin(), walk_.params.end(), name) != walk_.params.end();
    return is_compared ? name + " = " + short_number(m.param_value) : "";
  }
  std::string word_for(const mavlink::statustext& m) {
    const auto text = text_of(m.text);
    const bool is_compared = std::any_of(walk_.texts.begin(), walk_.texts.end(),
                                         [&](const std::string& each) { return text.starts_with(each); });
    return is_compared ? "says " + text : "";
  }
  std::string word_for(const auto&) { return ""; }

  const walk& walk_;
};

words recorded_words(const walk& what, const std::vector<recorded_frame>& frames) {
  speller spelled(what);
  words result;
  for (const auto& each : frames) {
    if (each.at_ns > what.until_ns || each.view().from() != vehicle_id)
      continue;
    auto word = spelled.spell(each.view());
    const auto other = std::find_if(what.deviations.begin(), what.deviations.end(),
                                    [&](const deviation& d) { return d.recorded == word; });
    if (other != what.deviations.end())
      word = other->simulated;
    if (!word.empty())
      result.push_back(word);
  }
  return result;
}

words simulated_words(const walk& what, const std::vector<recorded_frame>& frames, vehicle_world& world) {
  world.beat(false);
  world.mark();
  const auto before = world.all().size();
  const auto began_ns = world.now_ns();
  for (const auto& each : frames) {
    if (each.at_ns > what.until_ns || each.view().from() == vehicle_id)
      continue;
    world.run_for(began_ns + each.at_ns - world.now_ns());
    world.send_frame(each.view());
  }
  world.run_for(100 * ms);
  speller spelled(what);
  words result;
  for (auto i = before; i < world.all().size(); ++i)
    if (auto word = spelled.spell(mavlink::frame_view(world.all()[i].bytes.data())); !word.empty())
      result.push_back(word);
  return result;
}

void expect_alike(const walk& what, const std::vector<recorded_frame>& frames, vehicle_world& world) {
  const auto recorded = recorded_words(what, frames);
  EXPECT_GE(recorded.size(), 8U) << "there must be something to compare";
  EXPECT_EQ(simulated_words(what, frames, world), recorded);
}

// The different things that MISSION_CURRENT said, in order.
words course_of(const words& all) {
  words result;
  std::unique_copy(all.begin(), all.end(), std::back_inserter(result));
  return result;
}

std::string spelled(const mavlink::mission_current& m) {
  return "item " + std::to_string(m.seq) + " of " + std::to_string(m.total) + " state " +
         std::to_string(m.mission_state) + " mode " + std::to_string(m.mission_mode);
}

const std::vector<std::string> px4_flight_texts{"Armed",   "Executing", "Climb",   "Takeoff",
                                                "Landing", "Mission",   "Disarmed"};

TEST(recorded_orders, of_px4_before_and_in_a_mission_are_answered_alike) {
  const walk what{"px4_quad_mission.tlog", personality::px4, 3'600 * s, px4_flight_texts, {}, {}};
  const auto frames = read_recording(what.recording);
  vehicle_world world(vehicle_settings{.who = what.who, .home = {47.3977429, 8.5455936, 488.131}});
  expect_alike(what, frames, world);

  words recorded;
  for (const auto& each : frames)
    if (each.view().id() == mavlink::mission_current::message_id)
      recorded.push_back(spelled(mavlink::decode<mavlink::mission_current>(each.view())));
  words simulated;
  for (const auto& each : world.each<mavlink::mission_current>())
    simulated.push_back(spelled(each));
  EXPECT_EQ(course_of(simulated), course_of(recorded));
}

TEST(recorded_orders, of_px4_probes_are_answered_alike) {
  const walk what{"px4_quad_probes.tlog",
                  personality::px4,
                  78'200 * ms,
                  {"GCS"},
                  {"MIS_TAKEOFF_ALT"},
                  {{"says GCS connection regained\t", "", "it had heard a station before the recording begins"}}};
  const auto frames = read_recording(what.recording);
  vehicle_world world(what.who);
  expect_alike(what, frames, world);
}

TEST(recorded_orders, of_ardupilot_before_a_mission_are_answered_alike) {
  const walk what{"ardurover_mission.tlog", personality::ardupilot, 40'340 * ms, {"No "}, {}, {}};
  const auto frames = read_recording(what.recording);
  vehicle_world world(what.who);
  expect_alike(what, frames, world);
}

TEST(recorded_orders, of_ardupilot_probes_are_answered_alike) {
  const walk what{"ardurover_probes.tlog",
                  personality::ardupilot,
                  66'000 * ms,
                  {"No ", "Ardu", "3d12"},
                  {"WP_SPEED"},
                  {{"says ArduRover V4.7.0-dev (99ea60eb)", "says ArduCopter V4.7.0-dev (99ea60eb)",
                    "a Rover was recorded, a Copter is simulated"},
                   {"WP_SPEED = 5", "", "a parameter of the Rover alone"},
                   {"WP_SPEED = 3.25", "", "a parameter of the Rover alone"},
                   {"WP_SPEED = 7", "", "a parameter of the Rover alone"}}};
  const auto frames = read_recording(what.recording);
  vehicle_world world(what.who);
  expect_alike(what, frames, world);
}

// The station of MAVSDK, whose vehicle answers nothing: it must find ours as it wants it.
TEST(recorded_orders, of_mavsdk_at_its_connection_are_all_taken) {
  const walk what{"mavsdk_client_vs_passive.tlog", personality::px4, 3'600 * s, {}, {}, {}};
  const auto frames = read_recording(what.recording);
  vehicle_world world(what.who);
  const auto said = simulated_words(what, frames, world);
  const auto refused = [](const std::string& word) { return word.starts_with("ACK") && !word.ends_with(": 0"); };
  EXPECT_FALSE(said.empty());
  EXPECT_EQ(std::count_if(said.begin(), said.end(), refused), 0);
}

} // namespace recorded_orders_test
} // namespace godwit::sim::test
