// What must hold for a port that passes on, whatever stations, components of the vehicle and the executor say and when.
//
//   - nothing of the mission protocol goes on to the vehicle, and no message that is on no list;
//   - nothing goes on under the vehicle's own system id;
//   - what a person means, and what configures, goes on only after the executor's `pass`, and what it is silent about
//     only where the failsafe was told first (a stop) or nothing of it moves the vehicle;
//   - of reading no more goes on in a second than twice the budget: what was saved up, and a second's worth;
//   - one event leads to a bounded number of effects.
//
// The bytes are steps: a kind and its arguments. Durable events are on the disk at once. Thread: one at a time.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "actors/ground_port/core.hpp"
#include "io/mavlink/ids.hpp"

namespace godwit::ground_port::fuzz {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t s = 1'000 * ms;
inline constexpr std::size_t max_steps = 2'000;          // of one input
inline constexpr std::size_t max_effects_of_event = 512; // all the texts, values and answers that can be due at once
inline constexpr std::array<mavlink::sender, 5> senders{{{255, 190}, {254, 190}, {255, 191}, {1, 191}, {1, 1}}};
inline constexpr mavlink::sender vehicle{1, 1};

// Of the mission protocol, as MAVLink's common set has it, with the old fence and rally messages.
inline constexpr std::array<std::uint32_t, 17> mission_protocol{37, 38, 39, 40, 41,  42,  43,  44, 45,
                                                                46, 47, 51, 73, 160, 161, 175, 176};

class run {
public:
  explicit run(std::span<const std::uint8_t> bytes) : left_(bytes) {
    settings configured;
    configured.as.component = byte() % 2 == 0 ? 1 : 191;
    configured.passes = true;
    configured.max_items = 8;
    if (byte() % 2 == 0)
      configured.also_passes = {"SERIAL_CONTROL"};
    port_.emplace(std::move(configured), signing_settings{}, disk_, true, now());
  }

  // What does not hold; null: nothing.
  [[nodiscard]] const char* play() {
    for (std::size_t i = 0; i < max_steps && !left_.empty() && finding_ == nullptr; ++i)
      step();
    return finding_;
  }

private:
  [[nodiscard]] std::uint8_t byte() {
    if (left_.empty())
      return 0;
    const auto result = left_.front();
    left_ = left_.subspan(1);
    return result;
  }
  [[nodiscard]] std::uint16_t word() {
    const unsigned high = byte();
    return static_cast<std::uint16_t>((high << 8U) | byte());
  }
  [[nodiscard]] std::vector<std::uint8_t> some_bytes(std::size_t most) {
    std::vector<std::uint8_t> result(byte() % (most + 1));
    std::ranges::generate(result, [this] { return byte(); });
    return result;
  }
  [[nodiscard]] instant now() const { return {now_ns_, 1'800'000'000 * s + now_ns_}; }

  void step() {
    switch (byte() % 10) {
    case 0:
    case 1:
    case 2:
      return say_frame();
    case 3:
      return say_command();
    case 4: {
      const auto noise = some_bytes(64);
      return take(port_->on_bytes(io::link::only_peer, byte() % 2 == 0, std::as_bytes(std::span(noise)), now()));
    }
    case 5: {
      const auto from = senders[byte() % senders.size()];
      return take(port_->on_relayed({word(), from.system, from.component, some_bytes(255)}, now()));
    }
    case 6:
      return say_heartbeat();
    case 7:
      return answer();
    case 8:
      return hear_executor();
    default:
      return pass_time();
    }
  }

  // Of a kind that MAVLink knows, for the vehicle more often than chance would have it.
  void say_frame() {
    const auto id = static_cast<std::uint32_t>(word() % 512);
    const auto* const known = mavlink::find_message(id);
    auto payload = some_bytes(255);
    if (known == nullptr)
      return;
    const auto* const row = passing::find_message(id);
    if (row != nullptr && row->target_at != passing::no_target && byte() % 4 != 0) {
      const auto at = static_cast<std::size_t>(row->target_at);
      payload.resize(std::max(payload.size(), at + 2));
      payload[at] = vehicle.system;
      payload[at + 1] = vehicle.component;
    }
    send(id, known->crc_extra, payload);
  }
  void say_command() {
    mavlink::command_long m;
    m.target_system = vehicle.system;
    m.target_component = byte() % 4 == 0 ? 0 : vehicle.component;
    m.command = word();
    m.param1 = static_cast<float>(byte());
    m.param2 = static_cast<float>(byte());
    send(m);
  }
  template <class M>
  void send(const M& m) {
    const auto frame = mavlink::encode(m, senders[byte() % senders.size()], sequence_++);
    take(port_->on_bytes(io::link::only_peer, true, frame.span(), now()));
  }
  void send(std::uint32_t id, std::uint8_t crc_extra, const std::vector<std::uint8_t>& payload) {
    const mavlink::frame_buffer frame(id, crc_extra, std::as_bytes(std::span(payload)),
                                      senders[byte() % senders.size()], sequence_++, false);
    take(port_->on_bytes(io::link::only_peer, true, frame.span(), now()));
  }
  void say_heartbeat() {
    mavlink::heartbeat m;
    m.type = byte();
    m.autopilot = byte() % 2 == 0 ? mavlink::number(mavlink::mav_autopilot::ardupilotmega)
                                  : mavlink::number(mavlink::mav_autopilot::px4);
    m.base_mode = byte();
    m.custom_mode = byte();
    take(port_->on_telemetry(m, now()));
  }
  // The executor, to what it was asked.
  void answer() {
    if (asked_.empty())
      return;
    const auto what = asked_.front();
    asked_.pop_front();
    switch (byte() % 6) {
    case 4:
      begun_.push_back(what.request);
      return take(port_->on_act_answer(what.request, {executor::act_verdict::begun, {}}, now()));
    case 5:
      return take(port_->on_act_answer(what.request, {executor::act_verdict::own, {}}, now()));
    case 0:
      ++may_pass_;
      return take(port_->on_act_answer(what.request, {executor::act_verdict::pass, {}}, now()));
    case 1:
      return take(port_->on_act_answer(what.request, {executor::act_verdict::done, {}}, now()));
    case 2:
      return take(port_->on_act_answer(what.request, {executor::act_verdict::refused, "no"}, now()));
    default: {
      const auto kind = what.what.kind;
      const bool ends_motion =
          kind == executor::act_kind::stop || kind == executor::act_kind::hold || kind == executor::act_kind::stream;
      may_pass_ += ends_motion ? 1 : 0;
      return take(port_->on_act_failed(what.request, "it does not answer", now()));
    }
    }
  }
  // What has come of an act that it has begun.
  void resolve() {
    if (begun_.empty())
      return;
    const auto number = begun_.front();
    begun_.pop_front();
    const auto verdict = static_cast<executor::act_verdict>(byte() % 5);
    may_pass_ += verdict == executor::act_verdict::pass ? 1 : 0;
    take(port_->on_act_resolved({number, {verdict, "no"}}, now()));
  }
  void hear_executor() {
    switch (byte() % 4) {
    case 3:
      return resolve();
    case 0: {
      const auto& plans = disk_.plans;
      const auto id = plans.empty() ? std::uint32_t{byte()} : plans.front().plan_id;
      return take(port_->on_progress({id, byte(), static_cast<mavlink::mission_state>(byte() % 6)}, now()));
    }
    case 1:
      return take(port_->on_plan_judged(
          {static_cast<mavlink::mav_mission_type>(byte() % 3), judged_id_, static_cast<plan_verdict>(byte() % 4)},
          now()));
    default:
      return take(port_->on_plan_judged(
          {static_cast<mavlink::mav_mission_type>(byte() % 3), 0, static_cast<plan_verdict>(byte() % 4)}, now()));
    }
  }
  void pass_time() {
    now_ns_ += word() * ms / 4;
    take(port_->on_time(now()));
  }

  void take(const effects& done) {
    if (done.size() > max_effects_of_event)
      finding_ = "one event leads to too many effects";
    for (const auto& each : done) {
      if (const auto* passed = std::get_if<pass_on>(&each))
        judge(passed->what);
      else if (const auto* act = std::get_if<act_to_ask>(&each))
        asked_.push_back(*act);
      else if (const auto* event = std::get_if<durable_event>(&each))
        write(*event);
    }
    may_pass_ = 0; // of the event that has been handled
  }

  void write(const durable_event& event) {
    for (const auto& each : durable_core::apply(disk_, event, now().wall_ns))
      std::visit(
          [this]<class M>(const M& m) {
            if constexpr (std::is_same_v<M, executor::plan_taken>)
              judged_id_ = m.plan_id;
            else if constexpr (std::is_same_v<M, signing_time_reserved>)
              port_->on_reserved(mavlink::signing_time{m.ceiling});
            else if constexpr (requires { port_->on_durable(m, instant{}); })
              take(port_->on_durable(m, now()));
          },
          each);
  }

  static constexpr std::uint32_t manual_control = 69;

  void judge(const vehicle_link::relayed_frame& what) {
    if (std::ranges::find(mission_protocol, what.message) != mission_protocol.end())
      finding_ = "the mission protocol is passed on";
    if (what.system == vehicle.system)
      finding_ = "something is passed on under the vehicle's own system id";
    const auto list = list_of(what);
    if (!list)
      finding_ = "what is on no list is passed on";
    else if (*list == passing::pass_list::owned)
      finding_ = "what is godwit's is passed on";
    else if ((*list == passing::pass_list::person || *list == passing::pass_list::disarmed) && may_pass_ == 0 &&
             what.message != manual_control) // sticks that are left alone pass: stick_watch_test.cpp
      finding_ = "a person's message is passed on without the executor";
    if (may_pass_ > 0)
      --may_pass_;
    else
      count_reading();
  }
  // Of a command its own list, and not that of the message that carries it; a mode is a person's.
  [[nodiscard]] static std::optional<passing::pass_list> list_of(const vehicle_link::relayed_frame& what) {
    const auto* const row = passing::find_message(what.message);
    if (row == nullptr)
      return std::nullopt;
    if (what.message == mavlink::set_mode::message_id)
      return passing::pass_list::person;
    if (what.message != mavlink::command_long::message_id && what.message != mavlink::command_int::message_id)
      return row->on;
    constexpr std::size_t command_at = 28; // in both
    const auto byte_at = [&](std::size_t at) { return at < what.payload.size() ? unsigned{what.payload[at]} : 0U; };
    const auto command = static_cast<std::uint16_t>(byte_at(command_at) | (byte_at(command_at + 1) << 8U));
    if (command == mavlink::number(mavlink::mav_cmd::do_set_mode) ||
        command == mavlink::number(mavlink::mav_cmd::nav_loiter_unlim) ||
        command == mavlink::number(mavlink::mav_cmd::do_reposition)) // these go on where somebody else has it
      return passing::pass_list::person;
    const auto* const command_row = passing::find_command(command);
    if (command_row == nullptr)
      return std::nullopt;
    return command_row->on == passing::pass_list::setting ? passing::pass_list::disarmed : command_row->on;
  }
  void count_reading() {
    read_ns_.push_back(now_ns_);
    while (now_ns_ - read_ns_.front() >= s)
      read_ns_.pop_front();
    if (read_ns_.size() > 2 * static_cast<std::size_t>(to_vehicle_most.frames_per_s))
      finding_ = "more is read than the budget has";
  }

  std::span<const std::uint8_t> left_;
  std::int64_t now_ns_ = 1'000 * s;
  state disk_;
  std::optional<core> port_;
  std::uint8_t sequence_ = 0;
  std::deque<act_to_ask> asked_;
  std::deque<std::uint64_t> begun_;
  std::deque<std::int64_t> read_ns_;
  std::uint32_t judged_id_ = 0;
  int may_pass_ = 0;
  const char* finding_ = nullptr;
};

} // namespace godwit::ground_port::fuzz
