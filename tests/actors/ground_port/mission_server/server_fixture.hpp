// A vehicle with all its habits, its turns included, and stations that talk to it in virtual time. What the vehicle
// says is given in words, with everything that an exchange turns on: "REQUEST_INT 0", "ACK denied", "254/190 COUNT 3
// type 1".
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/ground_port/mission_server/server.hpp"

namespace godwit::ground_port::mission_server::test {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t s = 1'000 * ms;

inline constexpr mavlink::sender vehicle_id{1, 1};
inline constexpr mavlink::sender station{255, 190};
inline constexpr mavlink::sender other_station{254, 190};

// The changes that say what is held, without those that only announce one.
[[nodiscard]] std::vector<plan_change> resolved(const std::vector<plan_change>& changes);

// An outgoing message without its address, which is named where it is not STATION. The type is named unless it is 0.
[[nodiscard]] std::string in_words(const outgoing& message);
[[nodiscard]] mavlink::sender target_of(const outgoing& message);

[[nodiscard]] mavlink::mission_count count_of(int count, int type = 0);
[[nodiscard]] mavlink::mission_item_int waypoint(int seq, int type = 0); // a fence or rally item for these types
[[nodiscard]] mavlink::mission_ack ack_of(mavlink::mav_mission_result result, int type = 0);
[[nodiscard]] mavlink::mission_clear_all clear_of(int type);
[[nodiscard]] mavlink::mission_request_list list_of(int type);

template <class Request>
[[nodiscard]] Request request_for(int seq, int type = 0) {
  Request message;
  message.seq = static_cast<std::uint16_t>(seq);
  message.mission_type = static_cast<std::uint8_t>(type);
  return message;
}

class dialogue {
public:
  using words = std::vector<std::string>;

  explicit dialogue(const server_profile& vehicle) : turn_ns_(vehicle.turn_ns), server_(vehicle, vehicle_id) {}

  // What the vehicle says until its next turn is over; that is at once where it has none.
  template <class M>
  words tell(M message, mavlink::sender from = station, mavlink::sender to = vehicle_id) {
    send(message, from, to);
    return wait(turn_ns_);
  }
  // Comes in now; the answer is heard with the next wait.
  template <class M>
  void send(M message, mavlink::sender from = station, mavlink::sender to = vehicle_id) {
    message.target_system = to.system;
    message.target_component = to.component;
    hear(server_.on(from, message, now_ns_));
  }
  // What the vehicle says in DURATION_NS. It acts at its deadlines and at no other time.
  words wait(std::int64_t duration_ns);

  // COUNT and all items, one after the other; what the vehicle says to the last of them.
  words upload(int count, int type = 0, mavlink::sender from = station);

  [[nodiscard]] server& vehicle() { return server_; }
  [[nodiscard]] const held_plan& held(int type = 0) const;
  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }
  // How long ago the last turn was.
  [[nodiscard]] std::int64_t since_turn_ns() const { return turn_ns_ == 0 ? 0 : now_ns_ % turn_ns_; }
  // Since the beginning.
  [[nodiscard]] const std::vector<outgoing>& said() const { return said_; }
  [[nodiscard]] const std::vector<plan_change>& changes() const { return changes_; }
  // What was said to people since the last call.
  [[nodiscard]] words texts();
  // The last message of this kind; an empty one, if there was none.
  template <class M>
  [[nodiscard]] M last() const {
    const auto found = std::find_if(said_.rbegin(), said_.rend(),
                                    [](const outgoing& each) { return std::holds_alternative<M>(each); });
    return found == said_.rend() ? M{} : std::get<M>(*found);
  }

private:
  void hear(const reaction& what);

  std::int64_t turn_ns_;
  server server_;
  std::int64_t now_ns_ = 1'007 * ms; // within a turn, not at its edge
  std::size_t told_ = 0;             // of what was said, in words
  std::vector<outgoing> said_;
  std::vector<plan_change> changes_;
  words texts_;
};

} // namespace godwit::ground_port::mission_server::test
