// A ground port's core in virtual time, with a disk, an executor that the test answers for, and ground stations that
// speak to it in frames. What it sends is decoded and kept.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "actors/ground_port/core.hpp"

namespace godwit::ground_port::test {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t s = 1'000 * ms;
inline constexpr std::int64_t wall_start_ns = 1'800'000'000 * s; // 2027

inline constexpr mavlink::sender station_id{255, 190};
inline constexpr mavlink::sender other_station{254, 190};
inline constexpr mavlink::sender port_id{1, 191};
inline constexpr mavlink::sender autopilot_id{1, 1};

[[nodiscard]] mavlink::mission_item_int waypoint(int seq, std::uint16_t command = 16);
[[nodiscard]] std::vector<mavlink::mission_item_int> waypoints(int count);
[[nodiscard]] mavlink::command_long command(mavlink::mav_cmd what, float param1 = 0, float param2 = 0);
[[nodiscard]] mavlink::command_long start_command(float first = 0, float last = 0, std::uint8_t confirmation = 0);
[[nodiscard]] std::string text_of(const mavlink::statustext& m);

class port_fixture {
public:
  explicit port_fixture(settings configured = {}, bool has_executor = true, signing_settings signing = {});

  // A station says it; the port is the target where the message has one and names none.
  template <class M>
  void say(M message, mavlink::sender from = station_id, io::link::peer_id peer = io::link::only_peer) {
    if constexpr (requires { message.target_component; })
      if (message.target_system == 0 && message.target_component == 0) {
        message.target_system = port_.system;
        message.target_component = port_.component;
      }
    say_as_it_is(message, from, peer);
  }
  template <class M>
  void say_as_it_is(const M& message, mavlink::sender from = station_id, io::link::peer_id peer = io::link::only_peer) {
    bytes(peer, mavlink::encode(message, from, sequence_++).span());
  }
  void bytes(io::link::peer_id peer, std::span<const std::byte> what);
  void vehicle_says(const telemetry& m) { execute(core_->on_telemetry(m, now())); }
  void executor_says(const mission_progress& m) { execute(core_->on_progress(m, now())); }
  void executor_says(const item_reached& m) { execute(core_->on_item_reached(m, now())); }
  void executor_says(const status_text& m) { execute(core_->on_status_text(m, now())); }
  void executor_says(const set_mission& m) { execute(core_->on_set_mission(m, now())); }
  void executor_says(const executor::start_answer& m) { execute(core_->on_start_answer(m, now())); }
  void executor_says(const executor::current_answer& m) {
    execute(core_->on_current_answer(set_currents.back().request, m, now()));
  }
  void executor_fails_to_answer(const std::string& reason) {
    execute(core_->on_current_failed(set_currents.back().request, reason, now()));
  }
  // To the last command, or to the one with this place among them.
  void executor_says(const operators::answer& m) { executor_says(m, words.size() - 1); }
  void executor_says(const operators::answer& m, std::size_t which) {
    execute(core_->on_word_answer(words.at(which).request, m, now()));
  }
  void executor_fails_to_hear(const std::string& reason) {
    execute(core_->on_word_failed(words.back().request, reason, now()));
  }
  // To the last act of a person, or to the one with this place among them.
  void executor_says(executor::act_verdict verdict, const std::string& reason = {}) {
    execute(core_->on_act_answer(acts.back().request, {verdict, reason}, now()));
  }
  // What has come of the last act that was begun.
  void executor_resolves(executor::act_verdict verdict, const std::string& reason = {}) {
    execute(core_->on_act_resolved({acts.back().request, {verdict, reason}}, now()));
  }
  // The vehicle answers a command of a station.
  void vehicle_answers(std::uint16_t command, mavlink::mav_result result, mavlink::sender to = station_id,
                       mavlink::sender who = autopilot_id);
  void executor_is_silent() {
    execute(core_->on_act_failed(acts.back().request, "the executor does not answer", now()));
  }
  void answers_act(std::uint64_t request, const executor::act_answer& m) {
    execute(core_->on_act_answer(request, m, now()));
  }
  void leaves_act(std::uint64_t request) {
    execute(core_->on_act_failed(request, "the executor does not answer", now()));
  }
  // Empty: nobody.
  void has_control(const std::string& name) { execute(core_->on_control({name}, now())); }
  void judge(const plan_judged& m) { execute(core_->on_plan_judged(m, now())); }
  void component_says(const vehicle_link::relayed_frame& m) { execute(core_->on_relayed(m, now())); }
  // The answer to the last start that was asked for; started: with the progress that follows it.
  void executor_answers(executor::start_verdict verdict, const std::string& reason = {});
  void link_is(io::link::link_phase phase) { execute(core_->on_link({phase, "cut", 0}, now())); }
  void advance(std::int64_t duration_ns); // it acts at its deadlines and at no other time

  // COUNT and each item that is asked for. The final answer.
  mavlink::mission_ack upload(const std::vector<mavlink::mission_item_int>& items, int type = 0,
                              mavlink::sender from = station_id);
  mavlink::mission_ack upload(int count) { return upload(waypoints(count)); }
  // The plan as a station reads it.
  std::vector<mavlink::mission_item_int> download(int type = 0, mavlink::sender from = station_id);

  // From now on events wait until settle_disk().
  void slow_disk() { is_disk_slow_ = true; }
  void settle_disk();
  // The process is killed: what was not on the disk is gone. With LET_OUT_AGAIN the effects of the last event come out
  // once more, as after a crash between writing and letting out.
  void crash(bool dispatch_effect_again = false);
  void dispatch_effect_last_again();

  template <class M>
  [[nodiscard]] std::vector<M> sent() const {
    std::vector<M> result;
    for (const auto& each : frames)
      if (each.frame.view().id() == M::message_id)
        result.push_back(mavlink::decode<M>(each.frame.view()));
    return result;
  }
  template <class M>
  [[nodiscard]] M last() const {
    const auto all = sent<M>();
    return all.empty() ? M{} : all.back();
  }
  // Whereto the last one went.
  template <class M>
  [[nodiscard]] io::link::peer_id way_of() const {
    io::link::peer_id result = io::link::every_peer;
    for (const auto& each : frames)
      if (each.frame.view().id() == M::message_id)
        result = each.to;
    return result;
  }
  // The result of the last COMMAND_ACK; -1: there is none.
  [[nodiscard]] int last_result() const;
  [[nodiscard]] std::vector<std::string> texts() const;
  [[nodiscard]] bool said(const std::string& text) const;
  [[nodiscard]] std::uint64_t count_of(const std::string& name) const;
  void forget() { frames.clear(); }

  [[nodiscard]] instant now() const { return {now_ns_, wall_start_ns + now_ns_}; }
  [[nodiscard]] core& port() { return *core_; }
  [[nodiscard]] port_description shown() const { return core_->describe(now()); }
  void speaks_as(mavlink::sender port) { port_ = port; }

  std::vector<transmission> frames;
  std::vector<executor::start_mission> starts;
  bool judges = true;   // the executor, each plan
  bool objects = false; // to every plan, and to every clear
  [[nodiscard]] plan_verdict verdict() const { return objects ? plan_verdict::refused : plan_verdict::taken; }
  std::vector<executor::plan_taken> taken;
  std::vector<executor::plan_cleared> cleared;
  std::vector<start_request_to_executor> set_currents;
  std::vector<word_to_say> words;
  std::vector<vehicle_link::relayed_frame> passed_on;
  std::vector<act_to_ask> acts;
  std::vector<executor::act_acknowledged> acknowledged; // what the executor was told of the vehicle's answers
  std::vector<std::size_t> taken_over_told;             // so many had been passed on when the failsafe was told
  std::vector<operator_link> operator_news;
  std::vector<audit_row_to_tell> rows;
  state disk;
  std::size_t events = 0;

private:
  void execute(const effects& wanted);
  void write(const durable_event& each);
  void reserve_signing_time();
  void dispatch(const durable_core::effect& each);
  void make_core();

  settings settings_;
  bool has_executor_;
  signing_settings signing_;
  mavlink::sender port_;
  std::int64_t now_ns_ = 1'000 * s;
  std::optional<core> core_;
  std::uint8_t sequence_ = 0;
  bool is_disk_slow_ = false;
  std::deque<durable_event> waiting_;
  std::vector<durable_core::effect> last_effects_;
};

} // namespace godwit::ground_port::test
