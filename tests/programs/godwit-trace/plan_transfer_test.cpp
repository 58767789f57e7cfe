#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "io/mavlink/waypoint_file/waypoint_file.hpp"
#include "programs/godwit-trace/plan_transfer.hpp"
#include "tests/support/loopback_vehicle.hpp"

namespace plan_transfer_test {

using namespace godwit;
using namespace godwit::trace_tool;
namespace mavlink = io::mavlink;
namespace mission_server = ground_port::mission_server;

constexpr std::chrono::milliseconds quick_beats{20};

// The first one is a line of home, which an ArduPilot replaces with its own.
std::vector<mavlink::mission_item_int> survey(int count) {
  std::vector<mavlink::mission_item_int> items;
  for (int i = 0; i < count; ++i)
    items.push_back({.seq = static_cast<std::uint16_t>(i),
                     .frame = static_cast<std::uint8_t>(i == 0 ? 0 : 3),
                     .command = mavlink::number(mavlink::mav_cmd::nav_waypoint),
                     .autocontinue = 1,
                     .x = 473'977'418 + 100 * i,
                     .y = 85'455'938,
                     .z = 30});
  return items;
}

// A run of a command: a folder of its own, what it printed, and a stop that nobody has asked for yet.
class plan_transfer : public ::testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "godwit-plan-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    stop_ = ::eventfd(0, EFD_CLOEXEC);
  }
  void TearDown() override {
    ::close(stop_);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  exit_code run(plan_transfer_options options) {
    options.link.streams.clear();
    const auto out_path = folder_ / "out";
    const auto words_path = folder_ / "words";
    const int out_file = ::open(out_path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
    const int words_file = ::open(words_path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
    exit_code result{};
    {
      output out(out_file);
      output words(words_file);
      console to{out, words, false};
      result = run_plan_transfer(options, to, stop_);
    }
    ::close(out_file);
    ::close(words_file);
    printed = text_of(out_path);
    said = text_of(words_path);
    return result;
  }

  static std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // The other end of VEHICLE's link, as soon as it is open.
  static io::link::uri to(const support::loopback_vehicle& vehicle) {
    auto text = vehicle.description();
    for (; text.ends_with(":0"); text = vehicle.description())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return *io::link::parse_uri("udpout" + text.substr(text.find(':')));
  }

  std::filesystem::path folder_;
  int stop_ = -1;
  std::string printed;
  std::string said;
};

struct autopilot_case {
  const char* name;
  mavlink::mav_autopilot autopilot;
  mission_server::server_profile (*server_profile)();
};

const autopilot_case autopilots[] = {
    {"px4", mavlink::mav_autopilot::px4, mission_server::px4_profile},
    {"copter", mavlink::mav_autopilot::ardupilotmega, mission_server::ardupilot_copter_profile},
    {"unknown", mavlink::mav_autopilot::generic, mission_server::plain_profile}};

TEST_F(plan_transfer, a_plan_goes_up_and_comes_back_over_a_real_socket) {
  for (const auto& each : autopilots) {
    SCOPED_TRACE(each.name);
    const support::loopback_vehicle vehicle("udpin://127.0.0.1:0",
                                            {each.autopilot, each.server_profile(), quick_beats});
    plan_transfer_options options;
    options.where = to(vehicle);
    options.what = vehicle_link::upload_plan{mavlink::mav_mission_type::mission, survey(100)};
    ASSERT_EQ(run(options), exit_code::ok) << said;
    EXPECT_NE(printed.find("uploaded 100 items"), std::string::npos) << printed;
    EXPECT_EQ(vehicle.plan(mavlink::mav_mission_type::mission).size(), 100U);
    options.what = vehicle_link::download_plan{mavlink::mav_mission_type::mission};
    options.save_to = folder_ / "down.waypoints";
    ASSERT_EQ(run(options), exit_code::ok) << said;
    const auto down = mavlink::load_waypoint_file(options.save_to);
    ASSERT_TRUE(down) << down.error().message();
    ASSERT_EQ(down->size(), 100U);
    EXPECT_EQ(down->back().x, survey(100).back().x);
    options.what = vehicle_link::clear_plan{mavlink::mav_mission_type::mission};
    ASSERT_EQ(run(options), exit_code::ok) << said;
    EXPECT_LE(vehicle.plan(mavlink::mav_mission_type::mission).size(), 1U) << "an ArduPilot keeps home";
  }
}

TEST_F(plan_transfer, a_plan_without_home_is_not_sent_to_an_ardupilot_which_would_lose_its_first_item) {
  for (const auto& each : autopilots) {
    SCOPED_TRACE(each.name);
    const support::loopback_vehicle vehicle("udpin://127.0.0.1:0",
                                            {each.autopilot, each.server_profile(), quick_beats});
    auto items = survey(3);
    items.front().frame = 3;
    items.front().command = mavlink::number(mavlink::mav_cmd::nav_takeoff);
    plan_transfer_options options;
    options.where = to(vehicle);
    options.what = vehicle_link::upload_plan{mavlink::mav_mission_type::mission, items};
    const bool loses_it = each.autopilot == mavlink::mav_autopilot::ardupilotmega;
    EXPECT_EQ(run(options), loses_it ? exit_code::failed : exit_code::ok) << said;
    EXPECT_EQ(said.find("begins with command 22, which would be lost") != std::string::npos, loses_it) << said;
    EXPECT_EQ(vehicle.plan(mavlink::mav_mission_type::mission).size(), loses_it ? 0U : 3U);
  }
}

TEST_F(plan_transfer, json_is_the_outcome_with_all_its_parts) {
  const support::loopback_vehicle vehicle("udpin://127.0.0.1:0", {.beat_period = quick_beats});
  plan_transfer_options options;
  options.where = to(vehicle);
  options.what = vehicle_link::upload_plan{mavlink::mav_mission_type::mission, survey(3)};
  options.json = true;
  ASSERT_EQ(run(options), exit_code::ok) << said;
  const auto outcome = nlohmann::json::parse(printed);
  EXPECT_EQ(outcome["verdict"], "accepted");
  EXPECT_GT(outcome["duration_ns"].get<std::int64_t>(), 0);
}

TEST_F(plan_transfer, a_refusal_of_the_vehicle_is_a_failure_with_its_reason) {
  auto small = mission_server::px4_profile();
  small.capacity = 10;
  const support::loopback_vehicle vehicle("udpin://127.0.0.1:0", {.server_profile = small, .beat_period = quick_beats});
  plan_transfer_options options;
  options.where = to(vehicle);
  options.what = vehicle_link::upload_plan{mavlink::mav_mission_type::mission, survey(100)};
  EXPECT_EQ(run(options), exit_code::failed);
  EXPECT_NE(said.find("refused"), std::string::npos) << said;
  EXPECT_TRUE(printed.empty());
}

TEST_F(plan_transfer, a_vehicle_that_is_not_there_is_said_in_words) {
  plan_transfer_options options;
  options.where = *io::link::parse_uri("udpin://127.0.0.1:0");
  options.wait_for_vehicle = std::chrono::milliseconds(100);
  options.what = vehicle_link::clear_plan{};
  EXPECT_EQ(run(options), exit_code::failed);
  EXPECT_NE(said.find("no heartbeat of an autopilot"), std::string::npos) << said;
}

TEST_F(plan_transfer, ctrl_c_ends_the_wait_for_a_vehicle) {
  plan_transfer_options options;
  options.where = *io::link::parse_uri("udpin://127.0.0.1:0");
  options.what = vehicle_link::clear_plan{};
  const std::uint64_t one = 1;
  ASSERT_EQ(::write(stop_, &one, sizeof one), static_cast<ssize_t>(sizeof one));
  EXPECT_EQ(run(options), exit_code::failed);
  EXPECT_NE(said.find("stopped"), std::string::npos) << said;
}

} // namespace plan_transfer_test
