// A vehicle with the habits of a real one, ground stations with the transfer client, and lines between them, all in
// virtual time. Every station hears what the vehicle sends to any of them, as behind a router that floods.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "actors/ground_port/mission_server/server.hpp"
#include "actors/vehicle_link/transfer/client.hpp"
#include "tests/support/simulated_line.hpp"
#include "tests/support/virtual_time.hpp"

namespace godwit::tests {

namespace transfer = vehicle_link::transfer;
namespace mission_server = ground_port::mission_server;

inline constexpr io::mavlink::sender vehicle_id{1, 1};
inline constexpr io::mavlink::sender our_id{1, 191};
inline constexpr io::mavlink::sender other_station_id{255, 190};

class transfer_world {
public:
  static constexpr std::int64_t long_ago_ns = -60'000'000'000;

  struct station {
    station(io::mavlink::sender self, const transfer::peer_profile& profile, virtual_time& time,
            const line_settings& settings, std::uint64_t seed)
        : id(self), client(self, vehicle_id, profile, long_ago_ns), line(time, settings, seed) {}

    io::mavlink::sender id;
    transfer::client client;
    simulated_line line;
    std::vector<transfer::outcome> outcomes;
    std::vector<transfer::progress> progress;
    std::uint64_t bytes_when_settling = 0; // sent and received until the first MISSION_REQUEST_LIST; 0: there was none
    std::function<bool(const transfer::outgoing&)> drops_sent = [](const auto&) { return false; };
    std::function<bool(const mission_server::outgoing&)> drops_received = [](const auto&) { return false; };
  };

  transfer_world(const mission_server::server_profile& vehicle, const transfer::peer_profile& profile,
                 const line_settings& settings, std::uint64_t seed);
  transfer_world(const transfer_world&) = delete;
  transfer_world& operator=(const transfer_world&) = delete;
  ~transfer_world() = default;

  station& add_station(io::mavlink::sender self, const line_settings& settings);
  [[nodiscard]] station& ours() { return *stations_.front(); }

  void begin(station& from, transfer::step first) { execute(from, std::move(first)); }
  transfer::outcome upload(std::vector<io::mavlink::mission_item_int> plan,
                           io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission);
  transfer::outcome download(io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission);
  transfer::outcome clear(io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission);

  // Until FROM has nothing going on. False: not within the time.
  bool run_until_idle(station& from, std::int64_t at_most_ns = 600'000'000'000);
  void run_for(std::int64_t duration_ns);

  // MISSION_CURRENT once a second.
  void report_mission_every_second();
  // The vehicle hears nothing and says nothing for DURATION_NS, and has then forgotten what was going on.
  void reboot_vehicle(std::int64_t duration_ns);

  // Nothing waits in the stations and on the lines any more; an open transfer is forgotten by the vehicle.
  void let_it_settle() { run_for(20'000'000'000); }

  // Each mission that the vehicle has held since the beginning, and who brought it.
  struct held_mission {
    io::mavlink::sender by;
    std::vector<io::mavlink::mission_item_int> items;
  };
  [[nodiscard]] const std::vector<held_mission>& history() const { return history_; }

  // A and B mean the same, item by item.
  [[nodiscard]] static bool is_same(const std::vector<io::mavlink::mission_item_int>& a,
                                    const std::vector<io::mavlink::mission_item_int>& b);

  // Our client dies, and a new one knows nothing of what went on.
  void restart_our_client();

  [[nodiscard]] virtual_time& time() { return time_; }
  [[nodiscard]] mission_server::server& vehicle() { return server_; }

private:
  transfer::outcome last_outcome();
  void execute(station& from, transfer::step what);
  void execute(const mission_server::reaction& what);
  void to_vehicle(io::mavlink::sender from, const transfer::outgoing& what);
  template <class M>
  void to_station(station& to, const M& message);
  bool run_once(std::int64_t until_ns);

  virtual_time time_;
  transfer::peer_profile profile_;
  mission_server::server server_;
  std::vector<std::unique_ptr<station>> stations_;
  std::vector<held_mission> history_;
  std::uint64_t seed_;
  bool is_vehicle_down_ = false;
};

// A mission of COUNT waypoints that differs from those of other SEEDs in its positions; item 0 stands for home.
[[nodiscard]] std::vector<io::mavlink::mission_item_int> mission_of(int count, std::uint64_t seed = 0);

// What the vehicle holds means the same as PLAN, home left aside.
[[nodiscard]] bool holds(const mission_server::server& vehicle, const std::vector<io::mavlink::mission_item_int>& plan,
                         io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission);

} // namespace godwit::tests
