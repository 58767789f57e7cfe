// What a test of godwitd needs around it: a folder, a mission, a missions service in this process, and the words of a
// command line. Thread: one owner.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "messages/mission/document.hpp"
#include "programs/godwit-sim/missions/mission_service_host.hpp"
#include "tests/programs/godwitd/scratch.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"

namespace godwit::test {

// Another mission for each NUMBER.
[[nodiscard]] inline std::string mission_id(int number) {
  auto result = sighting_id(number);
  result[0] = '7';
  return result;
}

[[nodiscard]] inline mission::document small_mission(int number) {
  mission::document result;
  result.mission_id = mission_id(number);
  result.items = {mission::takeoff{"up", 40}, mission::waypoint{"w1", {47.3985, 8.5465, 40}, 0, 2, {}},
                  mission::return_home{"home"}};
  result.return_point = {47.3977, 8.5456, 0};
  return result;
}

struct daemon_world {
  explicit daemon_world(std::size_t map_objects = 0) {
    token = folder.write("token", "secret\n");
    sim::missions::service_settings settings;
    settings.token = "secret";
    settings.database = folder.file("service.db");
    settings.missions = {small_mission(0)};
    settings.map.count = map_objects;
    service = sim::missions::mission_service_host::open(std::move(settings)).value();
  }

  // All files lie in the folder NAME.
  [[nodiscard]] std::vector<std::string> words(const std::string& name, int mission = 0) const {
    const auto in = [&](const char* file) { return folder.file(name + "/" + file); };
    std::filesystem::create_directory(folder.file(name));
    return {"--service", service->url(), "--mission-id",        mission_id(mission), "--token-file",
            token,       "--vehicle",    "udpin://127.0.0.1:0", "--journal",         in("godwit.db"),
            "--trace",   in("trace"),    "--ground-run"};
  }

  scratch folder;
  std::string token;
  std::unique_ptr<sim::missions::mission_service_host> service;
};

[[nodiscard]] inline std::vector<std::string> operator+(std::vector<std::string> words,
                                                        const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

} // namespace godwit::test
