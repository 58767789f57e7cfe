// The vehicle's side of plan transfers: takes plans, gives them out, clears them.
//
//            COUNT (with room for it)             last item
//   idle ───────────────────────────> receiving ────────────> idle, the plan is held, ACK
//    │ ^                                │    └─ item refused, cancelled, silence ─> idle, the old plan is held
//    │ └──────── MISSION_ACK, silence ──┘
//    └─ REQUEST_LIST ──> giving ──> idle
//
// One station at a time: to others it is busy. It asks for each item, asks again when nothing comes, and gives up when
// the station is silent. What autopilots do otherwise, or where the MAVLink text leaves the choice, is
// `server_profile`. COUNT 0 and CLEAR_ALL clear; while locked (the vehicle flies the mission) they are refused, and
// an upload is not. Bounds: items of a plan (server_profile::capacity), messages that wait for their turn
// (max_waiting_messages). After 10 s in which nothing came in it is idle. Pure: time comes in; call on_time no later
// than next_deadline_ns. Thread: one at a time. Source: MAVLink mission protocol.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "actors/ground_port/mission_server/inbox.hpp"
#include "actors/ground_port/mission_server/plan_check.hpp"
#include "actors/ground_port/mission_server/plan_store.hpp"
#include "actors/ground_port/mission_server/server_profile.hpp"

namespace godwit::ground_port::mission_server {

class server {
public:
  server(const server_profile& vehicle, mavlink::sender ourselves);

  [[nodiscard]] reaction on(mavlink::sender from, const incoming& what, std::int64_t now_ns);
  [[nodiscard]] reaction on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const;

  // A plan that was held before, in a life of which nothing else is left: no messages, no notes of a change. The same
  // items as plan() gave have the same id again.
  void put_plan(mavlink::mav_mission_type type, std::vector<mavlink::mission_item_int> items);

  // The vehicle starts again: what is held stays, what was going on is forgotten.
  void restart();

  // The mission is being flown, and must not vanish.
  void lock(bool locked) { is_locked_ = locked; }

  // Where the vehicle is in its mission; at item 0 with each new plan. A download marks it, where the profile says so.
  void set_current(int seq) { current_ = seq; }

  // Of a vehicle that keeps its home as item 0: it is elsewhere now.
  void set_home(const mavlink::mission_item_int& home) { store_.set_home(home); }

  [[nodiscard]] const held_plan& plan(mavlink::mav_mission_type type) const { return store_.plan(type); }
  [[nodiscard]] bool is_idle() const { return std::holds_alternative<idle>(session_); }
  [[nodiscard]] bool is_receiving() const { return std::holds_alternative<receiving>(session_); }
  [[nodiscard]] bool is_giving() const { return std::holds_alternative<giving>(session_); }
  // With whom a transfer is open.
  [[nodiscard]] std::optional<mavlink::sender> partner() const;
  [[nodiscard]] std::uint64_t dropped() const { return inbox_.dropped(); }

private:
  struct idle {};
  struct receiving {
    mavlink::sender from;
    mavlink::mav_mission_type type{};
    int count = 0; // the sequence after the last item that comes
    int wanted = 0;
    std::int64_t heard_ns = 0;
    std::int64_t asked_ns = 0;
    request_kind asks_with{};
    fence_check fence;
    std::optional<int> marked_current;
  };
  struct giving {
    mavlink::sender to;
    mavlink::mav_mission_type type{};
    int next = 0;
    std::int64_t heard_ns = 0;
  };
  // The last upload: its ACK may have been lost.
  struct finished_upload {
    mavlink::sender from;
    mavlink::mav_mission_type type{};
    int last = 0;
  };

  void take(const letter& each, std::int64_t now_ns);

  // server_upload.cpp
  void take(mavlink::sender from, const mavlink::mission_count& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_write_partial_list& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_item_int& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_item& m, std::int64_t now_ns);
  void begin(mavlink::sender from, mavlink::mav_mission_type type, int first, int count, std::int64_t now_ns);
  void take_count_again(receiving& upload, const mavlink::mission_count& m, std::int64_t now_ns);
  void take_stray(mavlink::sender from, const mavlink::mission_item_int& m);
  void take_foreign(mavlink::sender from, const mavlink::mission_item_int& m);
  void take_wanted(receiving& upload, const mavlink::mission_item_int& m, std::int64_t now_ns);
  void finish(const receiving& ended);
  [[nodiscard]] std::optional<int> fault_of_the_whole(const receiving& upload) const;
  void give_up_upload(const receiving& upload);
  void ask(receiving& upload, std::int64_t now_ns);
  void ask_again(receiving& upload, std::int64_t now_ns);

  // server_download.cpp
  void take(mavlink::sender from, const mavlink::mission_request_list& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_request& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_request_int& m, std::int64_t now_ns);
  [[nodiscard]] std::optional<mavlink::mission_item_int> item_for(mavlink::sender to, std::uint8_t type, int seq,
                                                                  std::int64_t now_ns);
  void send_count(mavlink::sender to, mavlink::mav_mission_type type);

  void take(mavlink::sender from, const mavlink::mission_ack& m, std::int64_t now_ns);
  void take(mavlink::sender from, const mavlink::mission_clear_all& m, std::int64_t now_ns);
  void clear(mavlink::sender from, std::uint8_t type, occasion by);
  void on_silence(std::int64_t now_ns);
  void end_session();

  void acknowledge(mavlink::sender to, std::uint8_t type, mavlink::mav_mission_result result, std::uint32_t id = 0);
  void refuse_as_busy(mavlink::sender to, std::uint8_t type, std::optional<mavlink::mav_mission_result> result,
                      occasion when);
  void note_change(plan_change_kind kind, mavlink::mav_mission_type type, mavlink::sender by);
  void say(occasion when, text_facts facts);
  template <class M>
  void send(mavlink::sender to, M message) {
    message.target_system = to.system;
    message.target_component = to.component;
    out_.messages.emplace_back(message);
  }
  template <class M>
  [[nodiscard]] bool is_for_us(const M& m) const;
  [[nodiscard]] bool is_busy_for(mavlink::sender station) const;
  [[nodiscard]] bool is_closed_by_a_download() const {
    return is_giving() && vehicle_.when_read == while_read::everybody_waits;
  }

  server_profile vehicle_;
  mavlink::sender ourselves_;
  inbox inbox_;
  plan_store store_;
  std::variant<idle, receiving, giving> session_;
  std::optional<finished_upload> finished_;
  bool is_locked_ = false;
  int current_ = 0;
  std::uint32_t said_once_ = 0; // a bit for each occasion
  reaction out_;                // of the event that is being handled
};

} // namespace godwit::ground_port::mission_server
