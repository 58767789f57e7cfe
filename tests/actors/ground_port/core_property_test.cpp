// Any messages in any order, from anybody: the core keeps its rules.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <span>

#include "io/mavlink/ids.hpp"
#include "tests/actors/ground_port/port_desk.hpp"

namespace godwit::ground_port {
namespace {

using namespace test;

constexpr std::array ids{0U, 4U, 20U, 21U, 23U, 38U, 39U, 40U, 41U, 43U, 44U, 45U, 47U, 51U, 73U, 75U, 76U, 111U, 30U};
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

void say(desk& port, const happening& h) {
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
  if (id == 76 && h.what % 2 == 0) { // mostly a start
    payload[28] = std::byte{0x2C};
    payload[29] = std::byte{0x01};
  }
  const mavlink::frame_buffer frame(id, info->crc_extra, payload, senders.at(h.who % senders.size()), h.what, false);
  port.bytes(io::link::only_peer, frame.span());
}

RC_GTEST_PROP(ground_port_property, any_story_of_messages_leaves_it_able_to_serve,
              (const std::vector<std::tuple<std::uint8_t, std::uint8_t, std::vector<std::uint8_t>>>& story)) {
  desk port;
  port.upload(3);
  for (const auto& [what, who, payload] : story) {
    if (what >= 250)
      port.crash(what % 2 == 0);
    else if (what >= 240)
      port.slow_disk();
    else if (what >= 230)
      port.settle_disk();
    else if (what >= 220)
      port.advance(who * ms);
    else
      say(port, {what, who, payload});
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

} // namespace
} // namespace godwit::ground_port
