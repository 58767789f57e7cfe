// Whatever the network, the broker, the disk and the process do: what was on the disk reaches the broker, in order, and
// an id never means two things.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/actors/fleet_link/fleet_world.hpp"

namespace fleet_link_core_property_test {

using namespace godwit;
using namespace godwit::tests;
using json = nlohmann::json;

enum kind { note, wait, sync, accept, refuse, silence, take, take_unheard, kill, kinds };

void act(fleet_world& world, int what, int number, std::uint32_t& items) {
  switch (what) {
  case note:
    for (int i = 0; i < number % 30; ++i)
      world.note(++items);
    break;
  case wait:
    world.wait((number % 10 + 1) * fleet_link::core::beat_ns);
    break;
  case sync:
    world.sync();
    break;
  case accept:
    world.accept();
    break;
  case refuse:
    world.refuse(static_cast<fleet_link::broker_failure>(1 + number % 8));
    break;
  case silence: // noticed later
    world.fall_silent();
    break;
  case take:
    for (int i = 0; i <= number % 30 && world.take(); ++i) {
    }
    break;
  case take_unheard:
    for (int i = 0; i <= number % 5 && world.take(false); ++i) {
    }
    break;
  case kill:
    world.kill();
    break;
  }
  world.turn();
}

RC_GTEST_PROP(fleet_link_property, what_was_written_reaches_the_broker_in_order_and_an_id_means_one_thing, ()) {
  const auto ops = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange<int>(0, kinds), rc::gen::inRange<int>(0, 1'000)));
  fleet_world world;
  std::uint32_t items = 0;
  for (const auto& [what, number] : ops)
    act(world, what, number, items);
  world.refuse(fleet_link::broker_failure::lost); // silence is noticed
  world.deliver_all();
  std::map<std::uint64_t, std::string> texts;
  std::uint64_t newest = 0;
  for (const auto& each : world.received) {
    const auto number = json::parse(each).at("number").get<std::uint64_t>();
    const auto [known, is_new] = texts.emplace(number, each);
    RC_ASSERT(known->second == each);
    RC_ASSERT(!is_new || number == newest + 1);
    newest = std::max(newest, number);
  }
  RC_ASSERT(newest == world.state.next_number - 1);
  RC_ASSERT(world.state.dropped == 0U);
  RC_ASSERT(world.state.delivered == newest);
  RC_ASSERT(world.state.event_bytes == 0U);
}

} // namespace fleet_link_core_property_test
