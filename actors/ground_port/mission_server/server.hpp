// The vehicle's side of plan transfers: takes plans, gives them out, clears them.
//
//            COUNT (with room for it)             last item
//   idle ───────────────────────────> receiving ────────────> idle, the plan is held, ACK
//    │ ^                                │    └─ item refused, cancelled, silence ─> idle, the old plan is held
//    │ └──────── MISSION_ACK, silence ──┘
//    └─ REQUEST_LIST ──> giving ──> idle
//
// One station at a time: to others it is busy. It asks for each item, asks again when nothing comes, and gives up when
// the station is silent. What autopilots do otherwise, or where the MAVLink text leaves the choice, is `habits`. COUNT
// 0 and CLEAR_ALL clear; while locked (the vehicle flies the mission) they are denied, and an upload is not. Bounds:
// items of a plan (habits::capacity), messages that wait for their turn (max_waiting_messages). Pure: time comes in;
// call on_time no later than next_deadline_ns. Thread: one at a time. Source: MAVLink mission protocol.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "actors/ground_port/mission_server/habits.hpp"
#include "actors/ground_port/mission_server/inbox.hpp"
#include "actors/ground_port/mission_server/plan_store.hpp"

namespace godwit::ground_port::mission_server {

using outgoing = std::variant<mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_ack,
                              mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_item>;

struct plan_change {
  mavlink::mav_mission_type type{};
  std::uint32_t plan_id = 0; // 0: none, or a vehicle without ids
  int count = 0;             // 0: it was cleared
  mavlink::sender by;
};

// What an event leads to.
struct reaction {
  std::vector<outgoing> messages; // each has its target
  std::vector<plan_change> changes;
};

class server {
public:
  server(const habits& vehicle, mavlink::sender ourselves);

  [[nodiscard]] reaction on(mavlink::sender from, const incoming& what, std::int64_t now_ns);
  [[nodiscard]] reaction on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const;

  // The vehicle starts again: what is held stays, what was going on is forgotten.
  void restart();

  // The mission is being flown, and must not vanish.
  void lock(bool locked) { is_locked_ = locked; }

  [[nodiscard]] const held_plan& plan(mavlink::mav_mission_type type) const { return store_.plan(type); }
  [[nodiscard]] bool is_idle() const { return std::holds_alternative<idle>(session_); }
  [[nodiscard]] bool is_receiving() const { return std::holds_alternative<receiving>(session_); }
  [[nodiscard]] bool is_giving() const { return std::holds_alternative<giving>(session_); }
  [[nodiscard]] std::uint64_t dropped() const { return inbox_.dropped(); }

private:
  struct idle {};
  struct receiving {
    mavlink::sender from;
    mavlink::mav_mission_type type{};
    int count = 0;
    int wanted = 0;
    std::int64_t heard_ns = 0;
    std::int64_t asked_ns = 0;
    request_kind asks_with{};
  };
  struct giving {
    mavlink::sender to;
    mavlink::mav_mission_type type{};
    int next = 0;
    std::int64_t heard_ns = 0;
  };

  void take(const letter& each, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_count& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_item_int& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_item& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_request& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_request_int& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_request_list& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_ack& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_clear_all& m, std::int64_t now_ns);

  void take_stray(mavlink::sender from, const mavlink::mission_item_int& m);
  void take_wanted(receiving& upload, const mavlink::mission_item_int& m, std::int64_t now_ns);
  [[nodiscard]] std::optional<mavlink::mission_item_int> item_for(mavlink::sender to, std::uint8_t type, int seq,
                                                                  std::int64_t now_ns);
  void clear(mavlink::sender from, std::uint8_t type);
  void ask(receiving& upload, std::int64_t now_ns);
  void acknowledge(mavlink::sender to, std::uint8_t type, mavlink::mav_mission_result result, std::uint32_t id = 0);
  void refuse_as_busy(mavlink::sender to, std::uint8_t type);
  void note_change(mavlink::mav_mission_type type, mavlink::sender by);
  template <class M>
  void send(mavlink::sender to, M message);
  template <class M>
  [[nodiscard]] bool is_for_us(const M& m) const;
  [[nodiscard]] bool is_busy_for(mavlink::sender station) const;
  void on_silence(std::int64_t now_ns);

  habits vehicle_;
  mavlink::sender ourselves_;
  inbox inbox_;
  plan_store store_;
  std::variant<idle, receiving, giving> session_;
  std::optional<receiving> finished_; // the last upload: its ACK may have been lost
  bool is_locked_ = false;
  reaction out_; // of the event that is being handled
};

} // namespace godwit::ground_port::mission_server
