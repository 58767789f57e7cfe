// What must hold for a mission server whatever stations say and when; the fuzzer tries sequences of valid messages in
// orders that are not, and a test plants defects to show that they are found.
//
//   - it answers who has spoken to it and nobody else, and one event leads to a few messages and sentences only;
//   - it acts at its deadlines, and has another or none after each;
//   - after 10 s in which nothing comes it is idle and wants nothing, whatever it was doing;
//   - an atomic vehicle holds the plan that was completed last: whole, of one station, until the next is complete;
//   - no plan is longer than there is room for.
//
// The bytes are: which habits, then steps of a kind and its arguments. The server is passed in as a type, which is used
// as `server` is. Thread: one at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "actors/ground_port/mission_server/server.hpp"

namespace godwit::ground_port::mission_server::fuzz {

inline constexpr int room = 8;                  // items of a plan: often too few
inline constexpr std::size_t max_steps = 2'000; // of one input
inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t silence_ns = 10'000 * ms;
inline constexpr mavlink::sender vehicle_id{1, 1};
inline constexpr std::array<mavlink::sender, 4> stations{{{255, 190}, {254, 190}, {255, 191}, {1, 191}}};
inline constexpr std::array<mavlink::sender, 4> targets{{{1, 1}, {1, 1}, {1, 0}, {0, 0}}};

// One event takes one message, is perhaps the end of a patience, and tells each type of plan that it was cleared.
inline constexpr std::size_t max_messages = 3;
inline constexpr std::size_t max_changes = plan_types + 1;
inline constexpr std::size_t max_texts = 3;
inline constexpr std::size_t max_text_size = 50; // of STATUSTEXT

// Gives bytes, and zeros when there are none left.
class input {
public:
  explicit input(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  [[nodiscard]] bool is_empty() const { return left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty())
      return 0;
    const auto result = left_.front();
    left_ = left_.subspan(1);
    return result;
  }
  int below(int bound) { return byte() % bound; }
  std::uint16_t word() { return static_cast<std::uint16_t>(byte() << 8U | byte()); }
  template <class T>
  T raw() {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    for (auto& each : bytes)
      each = byte();
    T result;
    std::memcpy(&result, bytes.data(), sizeof result);
    return result;
  }

private:
  std::span<const std::uint8_t> left_;
};

inline server_profile profile_of(int which) {
  const std::array all{plain_profile(), px4_profile(), ardupilot_copter_profile(), ardupilot_plane_profile(),
                       ardupilot_rover_profile()};
  auto result = all.at(static_cast<std::size_t>(which) % all.size());
  result.capacity = room;
  return result;
}

template <class Server = server>
class run {
public:
  explicit run(std::span<const std::uint8_t> bytes)
      : input_(bytes), vehicle_(profile_of(input_.byte())), server_(vehicle_, vehicle_id) {}

  // What was found; nothing: all holds.
  [[nodiscard]] std::optional<std::string> play() {
    for (std::size_t i = 0; i < max_steps && !input_.is_empty() && !finding_; ++i)
      step();
    fall_silent();
    return finding_;
  }

private:
  struct sent_item {
    std::size_t by = 0;
    int seq = 0;
    int type = 0;
  };
  struct wanted_item {
    int seq = 0;
    int type = 0;
  };

  void require(bool holds, const char* what) {
    if (!holds && !finding_)
      finding_ = what;
  }

  void step() {
    from_ = static_cast<std::size_t>(input_.below(static_cast<int>(stations.size())));
    const auto kind = input_.below(16);
    switch (kind) {
    case 0:
      return say(count());
    case 1:
      return say(item());
    case 2:
      return say(float_item());
    case 3:
      return say(of_type(mavlink::mission_request_list{}));
    case 4:
      return say(request(mavlink::mission_request_int{}));
    case 5:
      return say(request(mavlink::mission_request{}));
    case 6:
      return say(acknowledgement());
    case 7:
      return say(of_type(mavlink::mission_clear_all{}));
    case 8:
      return say(partial_list());
    case 9:
      return server_.lock(input_.byte() % 2 == 1);
    case 10:
      return server_.restart();
    case 11:
      return server_.set_current(input_.below(room));
    case 12:
      return wait(input_.word() * ms);
    case 13:
      return fall_silent();
    default:
      return give_what_is_wanted();
    }
  }

  template <class M>
  M of_type(M message) {
    constexpr std::array<std::uint8_t, 8> types{0, 0, 0, 1, 1, 2, 7, 255};
    message.mission_type = types.at(static_cast<std::size_t>(input_.below(8)));
    return message;
  }
  template <class M>
  M request(M message) {
    message.seq = static_cast<std::uint16_t>(input_.below(room + 2));
    return of_type(message);
  }
  mavlink::mission_count count() {
    mavlink::mission_count message;
    message.count = static_cast<std::uint16_t>(input_.below(room + 2));
    return of_type(message);
  }
  mavlink::mission_ack acknowledgement() {
    mavlink::mission_ack message;
    message.type = static_cast<std::uint8_t>(input_.below(17));
    return of_type(message);
  }
  mavlink::mission_write_partial_list partial_list() {
    mavlink::mission_write_partial_list message;
    message.start_index = static_cast<std::int16_t>(input_.below(room + 2) - 1);
    message.end_index = static_cast<std::int16_t>(input_.below(room + 2) - 1);
    return of_type(message);
  }

  // One that any vehicle takes, with a number of its own as altitude.
  template <class Item>
  Item numbered(Item message, int seq, int type) {
    constexpr std::array commands{mavlink::mav_cmd::nav_waypoint, mavlink::mav_cmd::nav_fence_circle_inclusion,
                                  mavlink::mav_cmd::nav_rally_point};
    message.seq = static_cast<std::uint16_t>(seq);
    message.mission_type = static_cast<std::uint8_t>(type);
    message.command = mavlink::number(commands.at(static_cast<std::size_t>(type) % commands.size()));
    message.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
    message.param1 = 10;
    message.z = static_cast<float>(sent_.size());
    sent_.push_back({from_, seq, type});
    return message;
  }
  mavlink::mission_item_int item() {
    auto message = numbered(mavlink::mission_item_int{}, input_.below(room + 2), 0);
    message = of_type(message);
    message.command = input_.word() % 5'200;
    message.frame = static_cast<std::uint8_t>(input_.below(12));
    message.param1 = static_cast<float>(input_.below(8)) - 1.5F + static_cast<float>(input_.below(2)) / 2;
    message.x = input_.raw<std::int32_t>();
    message.y = input_.raw<std::int32_t>();
    sent_.back().type = message.mission_type;
    return message;
  }
  mavlink::mission_item float_item() {
    auto message = numbered(mavlink::mission_item{}, wanted_[from_].seq, wanted_[from_].type);
    message.frame = static_cast<std::uint8_t>(input_.below(8));
    message.param1 = input_.raw<float>();
    message.x = input_.raw<float>();
    message.y = input_.raw<float>();
    return message;
  }

  void give_what_is_wanted() {
    const auto items = 1 + input_.below(room);
    for (int i = 0; i < items && !finding_; ++i) {
      const auto wanted = wanted_[from_];
      auto message = numbered(mavlink::mission_item_int{}, wanted.seq, wanted.type);
      message.current = static_cast<std::uint8_t>(input_.below(2));
      say(message);
      wait(vehicle_.turn_ns);
    }
  }

  template <class M>
  void say(M message) {
    const auto to = targets.at(static_cast<std::size_t>(input_.below(4)));
    message.target_system = to.system;
    message.target_component = to.component;
    has_spoken_[from_] = true;
    wait(0); // what is due now is done
    look_at(server_.on(stations[from_], message, now_ns_));
  }

  void wait(std::int64_t duration_ns) {
    const auto until_ns = now_ns_ + duration_ns;
    while (!finding_ && server_.next_deadline_ns() <= until_ns) {
      require(server_.next_deadline_ns() >= now_ns_, "a deadline was missed");
      now_ns_ = std::max(now_ns_, server_.next_deadline_ns());
      look_at(server_.on_time(now_ns_));
      require(server_.next_deadline_ns() > now_ns_, "nothing was done at a deadline");
    }
    now_ns_ = until_ns;
  }

  void fall_silent() {
    wait(silence_ns);
    require(server_.is_idle(), "not idle after 10 s of silence");
    require(server_.next_deadline_ns() == std::numeric_limits<std::int64_t>::max(), "idle, and waits for something");
  }

  void look_at(const reaction& what) {
    require(what.messages.size() <= max_messages, "too many messages for one event");
    require(what.changes.size() <= max_changes, "too many changes for one event");
    require(what.texts.size() <= max_texts, "too many sentences for one event");
    for (const auto& each : what.texts)
      require(!each.text.empty() && each.text.size() <= max_text_size, "a sentence that does not fit");
    for (const auto& each : what.messages)
      look_at(each);
    for (const auto& each : what.changes)
      look_at(each);
    for (std::size_t i = 0; i < plan_types; ++i)
      look_at_plan(i);
  }

  void look_at(const outgoing& message) {
    const auto to = std::visit(
        [](const auto& m) {
          return mavlink::sender{m.target_system, m.target_component};
        },
        message);
    const auto found = std::find(stations.begin(), stations.end(), to);
    const auto who = static_cast<std::size_t>(found - stations.begin());
    require(found != stations.end() && has_spoken_[who], "an answer to somebody who has said nothing");
    if (const auto* asked = std::get_if<mavlink::mission_request_int>(&message))
      wanted_[who] = {asked->seq, asked->mission_type};
    else if (const auto* asked_for_float = std::get_if<mavlink::mission_request>(&message))
      wanted_[who] = {asked_for_float->seq, asked_for_float->mission_type};
  }

  void look_at(const plan_change& change) {
    const auto& plan = server_.plan(change.type);
    require(static_cast<int>(plan.items.size()) == change.count, "a change with another number of items");
    require(plan.id == change.plan_id, "a change with another id");
    require((change.kind == plan_change_kind::cleared) == (change.count == 0) ||
                change.kind == plan_change_kind::begun_replacing,
            "cleared, and not empty");
    require(!vehicle_.is_atomic || change.kind != plan_change_kind::begun_replacing, "an atomic plan was cut");
    if (vehicle_.is_atomic && change.kind == plan_change_kind::replaced)
      require(is_whole(plan, change), "a plan that is not whole, or of several stations");
    completed_[mavlink::number(change.type)] = checksum_of(plan.items);
  }

  [[nodiscard]] bool is_whole(const held_plan& plan, const plan_change& change) const {
    for (std::size_t i = 0; i < plan.items.size(); ++i) {
      const auto& each = sent_.at(static_cast<std::size_t>(plan.items[i].z));
      if (stations[each.by] != change.by || each.seq != static_cast<int>(i) || plan.items[i].seq != i ||
          each.type != mavlink::number(change.type))
        return false;
    }
    return true;
  }

  void look_at_plan(std::size_t type) {
    const auto& plan = server_.plan(static_cast<mavlink::mav_mission_type>(type));
    require(plan.items.size() <= static_cast<std::size_t>(room), "a plan for which there is no room");
    if (vehicle_.is_atomic)
      require(checksum_of(plan.items) == completed_.at(type), "not the plan that was completed last");
  }

  input input_;
  server_profile vehicle_;
  Server server_;
  std::int64_t now_ns_ = 1'000 * ms;
  std::size_t from_ = 0;
  std::vector<sent_item> sent_;
  std::array<wanted_item, stations.size()> wanted_{};
  std::array<bool, stations.size()> has_spoken_{};
  std::array<std::uint32_t, plan_types> completed_{};
  std::optional<std::string> finding_;
};

} // namespace godwit::ground_port::mission_server::fuzz
