// A missions service that runs: over HTTP or HTTPS, with faults on demand, on a file of SQLite that outlives it.
//
//   auto host = mission_service_host::open({.tls = identity, .token = "secret", .database = file, .missions =
//   {mission}}); client.base_url = (*host)->url();
//   (*host)->set_fault("lose on post-progress times 1");   // stored, and the answer never comes
//   ...
//   EXPECT_EQ((*host)->figures().rows[row_kind::progress].stored, 12U);
//
// It serves docs/missions-service.md as a whole. All runs in one thread of its own; a request is one transaction.
//
// Errors: open fails with a sentence when it can not listen, or when the file or a fault can not be used. Thread: any;
// each call waits for the service's thread. Whoever makes it destroys it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/figures.hpp"
#include "programs/godwit-sim/missions/settings.hpp"

namespace godwit::sim::missions {

class mission_service_host {
public:
  // A line for people about each request and fault. Called in the service's thread.
  using teller = std::function<void(std::string_view line)>;

  [[nodiscard]] static tl::expected<std::unique_ptr<mission_service_host>, std::string> open(service_settings settings,
                                                                                             teller tell = {});
  ~mission_service_host();
  mission_service_host(const mission_service_host&) = delete;
  mission_service_host& operator=(const mission_service_host&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  // "https://127.0.0.1:PORT"
  [[nodiscard]] std::string url() const;
  // "127.0.0.1:PORT"; empty if there is no control port.
  [[nodiscard]] std::string control() const;

  // From now on, besides those that are there already; the words are those of fault.hpp.
  [[nodiscard]] tl::expected<void, std::string> set_fault(std::string_view spec);
  void clear_faults();

  // What a long poll gets at once.
  [[nodiscard]] tl::expected<mission::assignment, std::string> assign(const std::string& mission_id,
                                                                      const assignment_request& wanted);
  // A mission that is there already, or was, is left as it is: an error.
  [[nodiscard]] tl::expected<void, std::string> add_mission(const mission::document& mission);
  [[nodiscard]] tl::expected<void, std::string> delete_mission(const std::string& mission_id);
  // Instead of those that are there; pages of the old ones are not known any more.
  [[nodiscard]] tl::expected<void, std::string> set_map_objects(const std::string& mission_id,
                                                                const std::vector<mission::map_object>& objects);
  [[nodiscard]] tl::expected<void, std::string> add_ignored_items(const std::string& mission_id,
                                                                  const std::vector<mission::ignored_item>& items);

  // As it is now; none: there is no such mission, or no more.
  [[nodiscard]] std::optional<mission::document> current_mission(const std::string& mission_id);
  // In the order in which they came.
  [[nodiscard]] std::vector<stored_row> rows(const std::string& mission_id, row_kind kind);
  [[nodiscard]] service_figures figures();

  // Until end(), a signal, or `quit` on the control port.
  void wait();
  void end();

private:
  class running;
  explicit mission_service_host(std::unique_ptr<running> made);

  std::unique_ptr<running> running_;
};

} // namespace godwit::sim::missions
