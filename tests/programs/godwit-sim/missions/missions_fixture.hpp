// A mission, a file that is gone after the test, and requests, for the tests of the missions service.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "messages/mission/progress.hpp"
#include "programs/godwit-sim/missions/service.hpp"

namespace godwit::sim::missions {

inline const std::string mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
inline const std::string token = "a-token-of-tests";
inline const std::string foreign_token = "another-token";

// up, w1, w2, home at revision 2.
[[nodiscard]] mission::document small_mission();
[[nodiscard]] mission::waypoint waypoint(const std::string& id);
// "00000000-0000-4000-8000-00000000002a" of 42.
[[nodiscard]] std::string uuid(std::uint64_t number);
[[nodiscard]] mission::observation observation(std::uint64_t number);
[[nodiscard]] mission::ignored_item ignored_item(std::uint64_t number);
[[nodiscard]] mission::map_object map_object(std::uint64_t number);
[[nodiscard]] mission::progress_report report(std::uint32_t number);
[[nodiscard]] mission::progress_batch reports(std::uint64_t key, std::uint32_t first, std::uint32_t last);
[[nodiscard]] mission::observation_batch observations(std::uint64_t key, std::uint64_t first, std::uint64_t last);
[[nodiscard]] mission::waypoint_insert insert(std::uint64_t key, std::int32_t base, const std::string& id);

// A folder that is gone with it.
class scratch {
public:
  scratch();
  ~scratch();
  scratch(const scratch&) = delete;
  scratch& operator=(const scratch&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

// "/missions/{mission_id}" and what follows.
[[nodiscard]] std::string target(const std::string& rest = {});
[[nodiscard]] request get(const std::string& rest = {});
[[nodiscard]] request post(const std::string& rest, std::string body);

// A service with the small mission, whose every answer is judged by the schema that the contract names.
class judged_service {
public:
  judged_service();

  [[nodiscard]] answer ask(const request& what, patience how_long = patience::none);
  // Whether it would wait.
  [[nodiscard]] bool waits(const request& what);
  [[nodiscard]] service_file& file() { return *file_; }
  // The service, and its file, begin again.
  void restart();

  std::int64_t now_ns = 1'777'888'999'000'000'000;

private:
  scratch folder_;
  std::unique_ptr<service_file> file_;
  std::unique_ptr<service> service_;
};

} // namespace godwit::sim::missions
