// Any messages in any order, from anybody: the core keeps its rules.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <set>
#include <span>
#include <string>

#include "actors/ground_port/passing/stick_watch.hpp"
#include "io/mavlink/ids.hpp"
#include "tests/actors/ground_port/port_fixture.hpp"

namespace godwit::ground_port {
namespace core_property_test {

using namespace test;

// Commands more often: most of their numbers lead to nothing.
constexpr std::array ids{0U,  4U,  20U, 21U, 23U,  38U, 39U, 40U, 41U, 43U, 44U, 45U, 47U,
                         51U, 73U, 75U, 76U, 111U, 30U, 75U, 76U, 75U, 76U, 75U, 76U};
constexpr std::array senders{station_id, other_station, autopilot_id, port_id, mavlink::sender{1, 100}};
// Where a message has its target, so that most of them are for the port.
constexpr std::array<std::pair<std::uint32_t, std::size_t>, 16> targets{{{20, 2},
                                                                         {21, 0},
                                                                         {23, 4},
                                                                         {38, 4},
                                                                         {39, 32},
                                                                         {40, 2},
                                                                         {41, 2},
                                                                         {43, 0},
                                                                         {44, 2},
                                                                         {45, 0},
                                                                         {47, 0},
                                                                         {51, 2},
                                                                         {73, 32},
                                                                         {75, 30},
                                                                         {76, 30},
                                                                         {111, 16}}};

struct happening {
  std::uint8_t what = 0;
  std::uint8_t who = 0;
  std::vector<std::uint8_t> payload;
};

// Mostly one that leads to something: COMMAND_INT and COMMAND_LONG have it at the same place.
void name_command(std::vector<std::byte>& payload, const happening& h) {
  constexpr std::array commands{mavlink::mav_cmd::mission_start, mavlink::mav_cmd::do_reposition,
                                mavlink::mav_cmd::do_pause_continue};
  const auto which = h.who / 8 % 4U;
  if (which == commands.size())
    return;
  const auto number = mavlink::number(commands.at(which));
  payload[28] = static_cast<std::byte>(number & 0xFFU);
  payload[29] = static_cast<std::byte>(number >> 8U);
  if (h.who < 128)
    return;
  // Parameters that can be taken: the default speed, pause or continue, from the first item to the last.
  const float first = which == 1 ? -1.0F : which == 2 && h.who >= 192 ? 1.0F : 0.0F;
  std::fill_n(payload.begin(), 16, std::byte{0});
  std::memcpy(payload.data(), &first, sizeof first);
  payload[32] &= std::byte{7}; // the frame, or the confirmation
}

// What the executor has been asked is a command that it can obey.
void look_at(const operators::command& command) {
  RC_ASSERT(command.by.starts_with("station "));
  RC_ASSERT(command.place.has_value() == (command.kind == operators::command_kind::go_to));
  if (!command.place)
    return;
  RC_ASSERT(std::abs(command.place->latitude) <= 90);
  RC_ASSERT(std::abs(command.place->longitude) <= 180);
  RC_ASSERT(std::isfinite(command.place->altitude_m));
}

// The executor as far as words go: it answers any of them, also twice.
struct listener {
  std::set<std::uint64_t> answered; // requests

  void answer(port_fixture& port, std::uint8_t which) {
    if (port.words.empty())
      return;
    const auto place = which % port.words.size();
    answered.insert(port.words[place].request);
    port.executor_says(operators::answer{which % 2 == 0, "no"}, place);
  }
  void look_at_all(const port_fixture& port) const {
    std::set<std::string> waiting;
    for (const auto& each : port.words) {
      look_at(each.what);
      if (!answered.contains(each.request))
        RC_ASSERT(waiting.insert(each.what.by).second); // one of each station
    }
    RC_ASSERT(waiting.size() <= command_dedup::max_stations);
  }
};

void say(port_fixture& port, const happening& h) {
  const auto id = ids.at(h.what % ids.size());
  const auto* const info = mavlink::find_message(id);
  std::vector<std::byte> payload(info->full_length);
  for (std::size_t i = 0; i < payload.size() && !h.payload.empty(); ++i)
    payload[i] = std::byte{h.payload[i % h.payload.size()]};
  const auto* const target = std::find_if(targets.begin(), targets.end(), [&](const auto& t) { return t.first == id; });
  if (target != targets.end() && h.who % 8 != 0) {
    payload[target->second] = std::byte{port_id.system};
    payload[target->second + 1] = std::byte{port_id.component};
  }
  if (id == 75 || id == 76)
    name_command(payload, h);
  const mavlink::frame_buffer frame(id, info->crc_extra, payload, senders.at(h.who % senders.size()), h.what, false);
  port.bytes(io::link::only_peer, frame.span());
}

RC_GTEST_PROP(ground_port_property, any_story_of_messages_leaves_it_able_to_serve,
              (const std::vector<std::tuple<std::uint8_t, std::uint8_t, std::vector<std::uint8_t>>>& story)) {
  port_fixture port;
  listener executor;
  port.upload(3);
  for (const auto& [what, who, payload] : story) {
    if (what >= 250) {
      port.crash(what % 2 == 0);
      executor = {};
    } else if (what >= 240)
      port.slow_disk();
    else if (what >= 230)
      port.settle_disk();
    else if (what >= 220)
      port.advance(who * ms);
    else if (what >= 205)
      executor.answer(port, who);
    else
      say(port, {what, who, payload});
    executor.look_at_all(port);
  }
  port.settle_disk();
  for (const auto& each : port.frames)
    RC_ASSERT(each.frame.view().from() == port_id || each.frame.view().from() == autopilot_id);
  for (const auto& each : port.sent<mavlink::command_ack>())
    RC_ASSERT(each.target_system != port_id.system);
  port.advance(10 * s);
  RC_ASSERT(port.shown().transfer == "idle");
  RC_ASSERT(port.upload(waypoints(2)).type == 0);
  RC_ASSERT(port.disk.plans.size() <= mission_server::plan_types);
}

// -- what is passed on ------------------------------------------------------------------------------

constexpr std::array passing_ids{0U,  11U, 20U, 21U, 23U,  44U,  45U,  66U,  69U,  70U,  75U, 76U,
                                 76U, 76U, 76U, 84U, 110U, 126U, 144U, 160U, 233U, 256U, 323U};
constexpr std::array<std::uint16_t, 16> passing_commands{17,  20,  22,  176, 176, 178, 192, 193,
                                                         209, 218, 246, 300, 400, 400, 512, 2'000};

void say_to_be_passed(port_fixture& port, const happening& h) {
  const auto id = passing_ids.at(h.what % passing_ids.size());
  const auto* const info = mavlink::find_message(id);
  std::vector<std::byte> payload(info->full_length);
  for (std::size_t i = 0; i < payload.size() && !h.payload.empty(); ++i)
    payload[i] = std::byte{h.payload[i % h.payload.size()]};
  const auto* const row = passing::find_message(id);
  if (row != nullptr && row->target_at != passing::no_target && h.who % 8 != 0)
    payload[static_cast<std::size_t>(row->target_at)] = std::byte{1};
  if (id == 75 || id == 76) {
    const auto number = passing_commands.at(h.who / 8 % passing_commands.size());
    payload[28] = static_cast<std::byte>(number & 0xFFU);
    payload[29] = static_cast<std::byte>(number >> 8U);
  }
  const mavlink::frame_buffer frame(id, info->crc_extra, payload, senders.at(h.who % senders.size()), h.what, false);
  port.bytes(io::link::only_peer, frame.span());
}

bool is_reading(const vehicle_link::relayed_frame& m) {
  if (m.message == 75 || m.message == 76) {
    const auto byte = [&](std::size_t at) { return at < m.payload.size() ? m.payload[at] : 0; }; // cut off: 0
    const auto* const row = passing::find_command(static_cast<std::uint16_t>(byte(28) + byte(29) * 256));
    return row != nullptr && row->on == passing::pass_list::passes;
  }
  const auto* const row = passing::find_message(m.message);
  return row != nullptr && row->on == passing::pass_list::passes;
}

// Whatever stations say: what a person could mean goes on only with an answer of the executor, or as a stop after the
// word to the failsafe; what is godwit's never does.
// Sticks in the middle, x, y and r of MANUAL_CONTROL, are passed on as what is read is.
bool moves_nothing(const vehicle_link::relayed_frame& m) {
  constexpr std::uint32_t manual_control = 69;
  constexpr int absent = INT16_MAX;
  const auto byte = [&](std::size_t at) { return at < m.payload.size() ? unsigned{m.payload[at]} : 0U; };
  const auto is_centred = [&](std::size_t at) {
    const int axis = static_cast<std::int16_t>(byte(at) | byte(at + 1) << 8U);
    return axis == absent || std::abs(axis) <= passing::stick_watch::held_from;
  };
  return is_reading(m) || (m.message == manual_control && is_centred(0) && is_centred(2) && is_centred(6));
}

RC_GTEST_PROP(ground_port_property, nothing_that_moves_the_vehicle_goes_on_before_somebody_was_told,
              (const std::vector<std::tuple<std::uint8_t, std::uint8_t, std::vector<std::uint8_t>>>& story)) {
  settings open;
  open.as.component = 1;
  open.passes = true;
  port_fixture port(open);
  mavlink::heartbeat beat;
  beat.type = mavlink::number(mavlink::mav_type::quadrotor);
  beat.autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega);
  port.vehicle_says(beat);
  port.upload(3);
  std::size_t answered = 0;
  for (const auto& [what, who, payload] : story) {
    const auto before = port.passed_on.size();
    if (what < 200 || port.acts.size() == answered) {
      say_to_be_passed(port, {what, who, payload});
      for (auto i = before; i < port.passed_on.size(); ++i)
        RC_ASSERT(moves_nothing(port.passed_on[i]));
      continue;
    }
    const auto& act = port.acts[answered++];
    if (what < 230) {
      port.answers_act(act.request, {executor::act_verdict::pass, {}});
      RC_ASSERT(port.passed_on.size() == before + 1);
      continue;
    }
    const auto told = port.taken_over_told.size();
    port.leaves_act(act.request);
    for (auto i = before; i < port.passed_on.size(); ++i)
      RC_ASSERT(is_reading(port.passed_on[i]) || port.taken_over_told.size() > told);
    using enum executor::act_kind;
    if (act.what.kind == arm || act.what.kind == take_off || act.what.kind == command)
      RC_ASSERT(port.passed_on.size() == before);
  }
  for (const auto& each : port.passed_on)
    RC_ASSERT(each.system != 1 && each.message != 256 && each.message != 44 && each.message != 45);
}

} // namespace core_property_test
} // namespace godwit::ground_port
