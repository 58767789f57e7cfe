// The camera of the simulated vehicle over RTSP, opened as godwit-eyes opens a camera. In real time: ten seconds.
#include "programs/godwit-sim/camera_server/vehicle_camera.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "io/video/source.hpp"

namespace vehicle_camera_test {

using namespace godwit;
using namespace godwit::sim;
using namespace std::chrono_literals;

bool wait_for(const std::function<bool()>& what, std::chrono::seconds most) {
  const auto until = std::chrono::steady_clock::now() + most;
  while (!what() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(10ms);
  return what();
}

TEST(vehicle_camera, its_pictures_come_over_rtsp_and_come_back_within_two_seconds_of_a_cut) {
  camera_place where;
  where.port = 0;
  where.movers = 3;
  where.north_m = 0;
  where.east_m = 0;
  where.spread_m = 5;
  const position home{47.397742, 8.545594, 488};
  const auto truth = std::filesystem::temp_directory_path() / ("godwit_truth_" + std::to_string(::getpid()));
  auto opened = vehicle_camera::open(where, home, truth.string(), [&] {
    vehicle_picture now;
    now.where = home;
    now.where.altitude_m += 40;
    return now;
  });
  ASSERT_TRUE(opened) << opened.error();
  const auto uri = "rtsp://127.0.0.1:" + std::to_string((*opened)->port()) + "/camera";
  io::video::source eyes(io::video::parse_camera_uri(uri).value(), {}, [] {});
  ASSERT_TRUE(wait_for([&] { return eyes.report().frames >= 60; }, 30s)) << eyes.report().reason;
  EXPECT_EQ(eyes.report().width, 640);
  EXPECT_EQ(eyes.report().height, 360);
  EXPECT_EQ(eyes.report().fault, io::video::picture_fault::none);
  (*opened)->set_cut(true);
  EXPECT_TRUE(wait_for([&] { return eyes.report().state == io::video::source_state::failed; }, 10s));
  (*opened)->set_cut(false);
  const auto back = std::chrono::steady_clock::now();
  EXPECT_TRUE(wait_for([&] { return eyes.report().state == io::video::source_state::playing; }, 10s));
  RecordProperty("back_ms", static_cast<int>((std::chrono::steady_clock::now() - back) / 1ms));
  std::ifstream lines(truth);
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(nlohmann::json::parse(line).at("movers").size(), 3U) << line;
  std::filesystem::remove(truth);
}

} // namespace vehicle_camera_test
