#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace godwit::sim::test {

namespace {

// Long enough for an answer, and shorter than anything else that goes on.
constexpr std::int64_t answer_time_ns = 30 * ms;

mavlink::sender to_vehicle(const vehicle_settings& settings) { return {settings.system, 1}; }

} // namespace

vehicle_world::vehicle_world(const vehicle_settings& settings, bool beats)
    : settings_(settings), beats_(beats),
      vehicle_(settings, start_ns, [this](std::span<const std::byte> bytes) { hear(bytes, 0); }) {
  run_for(0);
}

vehicle::line_number vehicle_world::add_line() {
  const auto number = ++lines_added_;
  EXPECT_EQ(vehicle_.add_line([this, number](std::span<const std::byte> bytes) { hear(bytes, number); }, now_ns_),
            number);
  return number;
}

void vehicle_world::hear(std::span<const std::byte> bytes, vehicle::line_number line) {
  const mavlink::frame_view frame(bytes.data());
  heard_.push_back({now_ns_, line, frame.id(), {bytes.begin(), bytes.end()}});
}

void vehicle_world::check_deadline() const {
  ASSERT_GE(vehicle_.next_deadline_ns(), now_ns_) << "it is late for itself";
}

void vehicle_world::run_to(std::int64_t until_ns) {
  while (true) {
    const auto next_ns = std::min(vehicle_.next_deadline_ns(), beats_ ? next_beat_ns_ : INT64_MAX);
    if (next_ns > until_ns)
      break;
    now_ns_ = std::max(now_ns_, next_ns);
    if (beats_ && next_beat_ns_ <= now_ns_) {
      next_beat_ns_ = now_ns_ + s;
      send(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::gcs),
                              .autopilot = mavlink::number(mavlink::mav_autopilot::invalid)});
      continue;
    }
    vehicle_.on_time(now_ns_);
    ++wakes_;
    if (vehicle_.next_deadline_ns() <= now_ns_) {
      ADD_FAILURE() << "on_time leaves its own deadline undone";
      return;
    }
  }
  now_ns_ = std::max(now_ns_, until_ns);
}

void vehicle_world::run_for(std::int64_t duration_ns) { run_to(now_ns_ + duration_ns); }

bool vehicle_world::run_until(const std::function<bool()>& done, std::int64_t at_most_ns) {
  const auto end_ns = now_ns_ + at_most_ns;
  while (!done()) {
    if (now_ns_ >= end_ns || ::testing::Test::HasFatalFailure())
      return false;
    const auto step_ns = std::min(vehicle_.next_deadline_ns(), beats_ ? next_beat_ns_ : INT64_MAX);
    run_to(std::min(end_ns, std::max(step_ns, now_ns_ + 1)));
  }
  return true;
}

std::optional<mav_result> vehicle_world::answer_since(std::size_t from, std::uint16_t what) const {
  for (auto i = from; i < heard_.size(); ++i)
    if (heard_[i].id == mavlink::command_ack::message_id)
      if (const auto ack = heard_[i].as<mavlink::command_ack>(); ack.command == what)
        return static_cast<mav_result>(ack.result);
  return std::nullopt;
}

std::optional<mav_result> vehicle_world::command(std::uint16_t what, const order_params& with) {
  const auto from = heard_.size();
  const auto target = to_vehicle(settings_);
  send(mavlink::command_long{.target_system = target.system,
                             .target_component = target.component,
                             .command = what,
                             .param1 = with.p1,
                             .param2 = with.p2,
                             .param3 = with.p3,
                             .param4 = with.p4,
                             .param5 = with.p5,
                             .param6 = with.p6,
                             .param7 = with.p7});
  return answer_since(from, what);
}

std::optional<mav_result> vehicle_world::command_int(mav_cmd what, const mavlink::command_int& with) {
  const auto from = heard_.size();
  auto message = with;
  message.command = mavlink::number(what);
  message.target_system = to_vehicle(settings_).system;
  message.target_component = to_vehicle(settings_).component;
  send(message);
  return answer_since(from, message.command);
}

std::optional<mav_mission_result> vehicle_world::upload(plan items, mav_mission_type type) {
  const auto target = to_vehicle(settings_);
  auto next = heard_.size();
  send(mavlink::mission_count{.target_system = target.system,
                              .target_component = target.component,
                              .count = static_cast<std::uint16_t>(items.size()),
                              .mission_type = mavlink::number(type)});
  std::optional<mav_mission_result> result;
  const auto give = [&](int seq) {
    auto item = items.at(static_cast<std::size_t>(seq));
    item.target_system = target.system;
    item.target_component = target.component;
    item.seq = static_cast<std::uint16_t>(seq);
    item.mission_type = mavlink::number(type);
    send(item);
  };
  const auto answer = [&] {
    while (!result && next < heard_.size()) {
      const auto each = heard_[next++];
      if (each.id == mavlink::mission_request::message_id)
        give(each.as<mavlink::mission_request>().seq);
      else if (each.id == mavlink::mission_request_int::message_id)
        give(each.as<mavlink::mission_request_int>().seq);
      else if (each.id == mavlink::mission_ack::message_id)
        result = static_cast<mav_mission_result>(each.as<mavlink::mission_ack>().type);
    }
    return result.has_value();
  };
  static_cast<void>(run_until(answer, 20 * s));
  return result;
}

std::optional<plan> vehicle_world::download(mav_mission_type type) {
  const auto target = to_vehicle(settings_);
  auto next = heard_.size();
  send(mavlink::mission_request_list{target.system, target.component, mavlink::number(type)});
  std::optional<std::size_t> count;
  plan items;
  const auto ask = [&] {
    if (items.size() < *count)
      send(mavlink::mission_request_int{.target_system = target.system,
                                        .target_component = target.component,
                                        .seq = static_cast<std::uint16_t>(items.size()),
                                        .mission_type = mavlink::number(type)});
  };
  const auto answer = [&] {
    while (next < heard_.size()) {
      const auto each = heard_[next++];
      if (each.id == mavlink::mission_count::message_id)
        count = each.as<mavlink::mission_count>().count;
      else if (each.id == mavlink::mission_item_int::message_id)
        items.push_back(each.as<mavlink::mission_item_int>());
      else
        continue;
      ask();
    }
    return count && items.size() == *count;
  };
  if (!run_until(answer, 5 * s))
    return std::nullopt;
  send(mavlink::mission_ack{
      .target_system = target.system, .target_component = target.component, .mission_type = mavlink::number(type)});
  run_for(answer_time_ns);
  return items;
}

std::optional<mav_mission_result> vehicle_world::clear(mav_mission_type type) {
  const auto target = to_vehicle(settings_);
  const auto from = heard_.size();
  send(mavlink::mission_clear_all{target.system, target.component, mavlink::number(type)});
  run_for(answer_time_ns);
  for (auto i = from; i < heard_.size(); ++i)
    if (heard_[i].id == mavlink::mission_ack::message_id)
      return static_cast<mav_mission_result>(heard_[i].as<mavlink::mission_ack>().type);
  return std::nullopt;
}

bool vehicle_world::make_ready() {
  const bool is_copter = settings_.who == personality::ardupilot;
  if (is_copter || settings_.who == personality::plane) // which starts its mission from any mode
    run_for(static_cast<std::int64_t>(6e9 / settings_.speed));
  if (is_copter) {
    constexpr float guided = 4;
    if (command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = guided}) != mav_result::accepted)
      return false;
  }
  return command(mav_cmd::component_arm_disarm, {.p1 = 1}) == mav_result::accepted;
}

std::vector<std::string> vehicle_world::texts(std::optional<vehicle::line_number> line) const {
  std::vector<std::string> result;
  for (const auto& each : each<mavlink::statustext>(line))
    result.emplace_back(each.text.data(), std::find(each.text.begin(), each.text.end(), '\0') - each.text.begin());
  return result;
}

bool vehicle_world::said(const std::string& text, std::optional<vehicle::line_number> line) const {
  const auto all_texts = texts(line);
  return std::find(all_texts.begin(), all_texts.end(), text) != all_texts.end();
}

std::vector<int> vehicle_world::reached() const {
  std::vector<int> result;
  for (const auto& each : each<mavlink::mission_item_reached>())
    result.push_back(each.seq);
  return result;
}

mavlink::mission_item_int item_at(mav_cmd command, const position& home, const offset& where) {
  const auto bearing = std::atan2(where.east_m, where.north_m) * 57.29577951308232;
  const auto place = moved(home, {bearing, std::hypot(where.north_m, where.east_m)});
  return {.frame = mavlink::number(mavlink::mav_frame::global_relative_alt),
          .command = mavlink::number(command),
          .autocontinue = 1,
          .x = static_cast<std::int32_t>(std::lround(place.latitude_deg * 1e7)),
          .y = static_cast<std::int32_t>(std::lround(place.longitude_deg * 1e7)),
          .z = where.up_m};
}

mavlink::mission_item_int bare_item(mav_cmd command, float param1, float param2) {
  return {.frame = mavlink::number(mavlink::mav_frame::mission),
          .command = mavlink::number(command),
          .autocontinue = 1,
          .param1 = param1,
          .param2 = param2};
}

plan numbered(plan items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i].seq = static_cast<std::uint16_t>(i);
  return items;
}

plan row_of(int count, const position& home, double spacing_m) {
  plan items;
  for (int i = 0; i < count; ++i)
    items.push_back(item_at(mav_cmd::nav_waypoint, home, {(i + 1) * spacing_m, 0, 10}));
  return numbered(items);
}

plan flight_of(int count, const position& home, personality who) {
  plan items;
  if (who == personality::ardupilot || who == personality::plane)
    items.push_back(item_at(mav_cmd::nav_waypoint, home, {}));
  items.push_back(item_at(mav_cmd::nav_takeoff, home, {0, 0, 10}));
  for (const auto& each : row_of(count, home, 15))
    items.push_back(each);
  items.push_back(item_at(mav_cmd::nav_land, home, {15.0 * count, 0, 0}));
  return numbered(items);
}

plan with_return(plan items) {
  auto& last = items.back();
  last.command = mavlink::number(mav_cmd::nav_return_to_launch);
  last.frame = mavlink::number(mavlink::mav_frame::mission);
  last.x = 0;
  last.y = 0;
  last.z = 0;
  return items;
}

} // namespace godwit::sim::test
