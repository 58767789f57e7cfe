// Whatever happens in whatever order, with crashes anywhere: what must never happen does not.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/fields/json_text.hpp"
#include "tests/actors/failsafe/flight_world.hpp"
#include "tests/support/test_rng.hpp"

namespace core_property_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;
using godwit::vehicle_link::command_verdict;
namespace flight = godwit::flight;
namespace io = godwit::io;

constexpr std::uint16_t last_item = 6;

// One flight under all that can happen to it, and what was seen of it.
class ordeal {
public:
  ordeal(vehicle_class what, bool has_land_start) : world_(what), has_land_start_(has_land_start) {
    const auto land_start = has_land_start ? std::optional(landing_sequence) : std::nullopt;
    const flight::plan_end end{last_item, false, {world_.in(mode_kind::hold).custom_mode}};
    world_.set_fences({fence_of(fence_kind::inclusion, square(100))}, land_start, end);
    world_.run_s(8);
  }

  void happens(int what, int number) {
    switch (what) {
    case operator_goes:
      world_.operator_there = number % 3 == 0;
      break;
    case battery_falls:
      world_.battery_percent = std::max(3, world_.battery_percent - number % 20);
      break;
    case it_moves:
      world_.east_m = number % 2 == 0 ? 0 : 101;
      break;
    case it_lands:
      world_.landed = number % 2 == 0 ? landed_state::on_ground : landed_state::in_air;
      break;
    case it_is_armed:
      world_.armed = number % 4 != 0;
      break;
    case pilot_comes: // one who puts a mode of ours back between two heartbeats, nobody can see
      world_.mode = {mode_kind::manual, ++pilots_mode_};
      break;
    case operator_speaks:
      speak(number);
      break;
    case link_has_faults:
      world_.hears = number % 3 != 0;
      world_.answers = number % 5 != 0;
      world_.obeys_after_ms = number % 900;
      if (!has_land_start_) // one that is refused becomes a return, perhaps after one that is still under way
        world_.refuses = number % 7 == 0 ? std::optional(command_verdict::refused) : std::nullopt;
      break;
    case heartbeats_stop:
      world_.sends_heartbeats = number % 3 != 0;
      break;
    case it_crashes:
      world_.restart();
      break;
    case following_changes:
      world_.tell(following{number % 2 == 0});
      break;
    case plan_ends:
      end_plan(number);
      break;
    }
    for (int i = 0; i < 1 + number % 40; ++i)
      tick();
  }

  enum kind {
    operator_goes,
    battery_falls,
    it_moves,
    it_lands,
    it_is_armed,
    pilot_comes,
    operator_speaks,
    link_has_faults,
    heartbeats_stop,
    it_crashes,
    following_changes,
    plan_ends,
    kinds
  };

private:
  // What an operator can say makes a new epoch: what was done before may then be done again.
  void speak(int number) {
    switch (number % 3) {
    case 0:
      world_.tell(hand_back{});
      world_.mode = world_.in(mode_kind::mission);
      world_.tell(expect_mode{{world_.mode.custom_mode}, 5'000});
      world_.sequence = 3;
      world_.is_complete = false;
      begin_epoch();
      break;
    case 1:
      world_.override_for_s(rule::fence, 1 + number % 30);
      break;
    default:
      world_.override_for_s(rule::operator_link, 1 + number % 30);
    }
  }

  // Or a person holds the vehicle on the way to the last item. MISSION_CURRENT may be late.
  void end_plan(int number) {
    world_.sends_sequence = number % 3 != 0;
    if (world_.mode.kind != mode_kind::mission || world_.sequence >= landing_sequence)
      return;
    world_.sequence = last_item;
    world_.is_complete = number % 2 == 0;
    world_.mode = world_.in(mode_kind::hold);
  }

  void begin_epoch() {
    ++epoch_;
    highest_ = static_cast<int>(rules.size()) + 1;
  }

  void tick() {
    const auto sent = world_.sent.size();
    const auto lifted = world_.lifted.size();
    const bool piloted = world_.kept().now.pilot.taken_over;
    world_.run_ms(100);
    if (world_.lifted.size() > lifted || !world_.kept().now.in_flight || !world_.told_in_air)
      begin_epoch();
    for (auto i = sent; i < world_.sent.size(); ++i)
      check(world_.sent[i], piloted);
    for (; checked_ < world_.obeyed.size(); ++checked_)
      RC_ASSERT(obeyed_.insert({epoch_of_.at(world_.obeyed[checked_].number), world_.obeyed[checked_].what}).second);
  }

  void check(const command_vehicle& command, bool piloted) {
    RC_ASSERT(world_.told_in_air);                              // never on the ground
    RC_ASSERT(!piloted || !world_.kept().now.pilot.taken_over); // never against a pilot
    RC_ASSERT(priority_of(command.why) <= highest_);            // never a lower one after a higher
    RC_ASSERT(command.number > last_number_);
    highest_ = priority_of(command.why);
    last_number_ = command.number;
    epoch_of_[command.number] = epoch_;
  }

  flight_world world_;
  bool has_land_start_;
  std::uint32_t pilots_mode_ = 100;
  int epoch_ = 0;
  int highest_ = static_cast<int>(rules.size()) + 1;
  std::uint64_t last_number_ = 0;
  std::map<std::uint64_t, int> epoch_of_;
  std::set<std::pair<int, action>> obeyed_; // each action once in an epoch
  std::size_t checked_ = 0;
};

using happenings = std::vector<std::pair<int, int>>;

rc::Gen<happenings> some() {
  return rc::gen::container<happenings>(
      rc::gen::pair(rc::gen::inRange<int>(0, ordeal::kinds), rc::gen::inRange(0, 420)));
}

RC_GTEST_PROP(failsafe_property, never_on_the_ground_never_against_a_pilot_never_a_lower_after_a_higher_never_twice,
              ()) {
  const auto what = *rc::gen::element(vehicle_class::multirotor, vehicle_class::fixed_wing, vehicle_class::rover);
  const bool has_land_start = *rc::gen::arbitrary<bool>();
  const auto all = *some();
  ordeal flight(what, has_land_start);
  for (const auto& [kind, number] : all)
    flight.happens(kind, number);
}

// A restart after each tick of a flight in which something must be done.
RC_GTEST_PROP(failsafe_property, a_restart_at_any_point_never_sends_a_second_time_and_never_forgets_to, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  test_rng random(seed);
  flight_world world;
  world.set_fences({fence_of(fence_kind::inclusion, square(100))});
  world.obeys_after_ms = random.between(0, 900);
  world.answers = random.one_in(2);
  world.run_ms(random.between(20, 100) * 100);
  world.east_m = 101;
  for (int i = 0; i < 100; ++i) {
    if (random.one_in(8))
      world.restart();
    world.run_ms(100);
  }
  world.run_s(10);
  RC_ASSERT(world.sent.size() == 1U);
  RC_ASSERT(world.mode == in_return);
}

// The process is killed, and the last records may not have reached the disk. It takes a while until it runs again.
RC_GTEST_PROP(failsafe_property, a_killed_process_makes_no_second_return, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  test_rng random(seed);
  flight_world world;
  world.set_fences({fence_of(fence_kind::inclusion, square(100))});
  world.run_s(10);
  world.east_m = 101;
  const auto before = static_cast<std::size_t>(world.remembered);
  world.run_ms(random.between(3, 30) * 100); // after the second position outside
  const auto lost = static_cast<int>(static_cast<std::size_t>(world.remembered) - before);
  world.kill(static_cast<std::size_t>(random.between(0, lost)));
  world.mode = in_return; // it obeyed meanwhile
  world.run_s(20);
  RC_ASSERT(world.sent.size() == 1U);
}

// -- order ----------------------------------------------------------------------------------------

std::string text_of(const effects& all) {
  std::string result;
  for (const auto& each : all)
    std::visit(
        [&]<class E>(const E& what) {
          if constexpr (std::is_same_v<E, remember>)
            result += godwit::io::to_json(what.what);
          else if constexpr (std::is_same_v<E, failsafe_status_changed>)
            result += godwit::io::to_json(what.now);
          else if constexpr (std::is_same_v<E, godwit::runtime::condition>)
            result += std::to_string(static_cast<int>(what.how)) + what.reason;
          else if constexpr (requires { what.answer; })
            result += std::to_string(what.request_id) + godwit::io::to_json(what.answer);
          else
            result += std::string(godwit::io::type_name<E>()) + godwit::io::to_json(what);
        },
        each);
  return result;
}

// At most one of each kind.
std::vector<event> events_of_a_tick(test_rng& random, std::int64_t wall_ns) {
  std::vector<event> result;
  const auto maybe = [&](int one_in, const event& what) {
    if (random.one_in(one_in))
      result.push_back(what);
  };
  const flight_mode modes[] = {in_mission, in_mission, in_mission, in_return, in_hold, in_manual};
  maybe(3, heartbeat{vehicle_class::fixed_wing, !random.one_in(20), modes[random.between(0, 5)],
                     io::mavlink::mav_autopilot::generic, random.one_in(20)});
  maybe(3, landed{random.one_in(10) ? landed_state::on_ground : landed_state::in_air});
  auto there = position_at(random.up_to(120), 0, 50, 5);
  there.boot_ms = static_cast<std::uint32_t>(random.between(0, 1'000'000));
  maybe(2, there);
  maybe(5, battery{random.between(5, 30)});
  maybe(5, operator_heard{true, random.between(0, 40'000)});
  maybe(4, command_resolved{static_cast<std::uint64_t>(random.between(1, 5)),
                            static_cast<command_verdict>(random.between(0, 7))});
  maybe(30, asked_override{
                1, {rules.at(static_cast<std::size_t>(random.between(0, 3))), "why not", wall_ns + 2 * ns_per_s}});
  maybe(30, hand_back{});
  maybe(30, taken_over{});
  maybe(10, expect_mode{{modes[random.between(0, 5)].custom_mode, modes[random.between(0, 5)].custom_mode},
                        random.between(0, 3) * 1'000});
  maybe(20, following{random.one_in(2)});
  maybe(20, asked_guard{1,
                        {{fence_of(fence_kind::inclusion, square(random.between(50, 150)))},
                         landing_sequence,
                         {last_item, random.one_in(2), {in_hold.custom_mode}}}});
  maybe(5, mission_current{static_cast<std::uint16_t>(random.between(0, 12)), random.one_in(2)});
  return result;
}

RC_GTEST_PROP(failsafe_property, the_order_of_inputs_within_a_tick_does_not_matter, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  test_rng random(seed);
  const instant start{100 * ns_per_s, 1'700'000'000 * ns_per_s};
  core one({}, {}, start);
  core other({}, {}, start);
  for (int i = 0; i < 200; ++i) {
    const auto passed_ns = i * tick_ms * ns_per_ms;
    const instant now{start.monotonic_ns + passed_ns, start.wall_ns + passed_ns};
    auto events = events_of_a_tick(random, now.wall_ns);
    for (const auto& each : events)
      one.take(each, now);
    for (auto last = events.size(); last > 1; --last)
      std::swap(events[last - 1], events[static_cast<std::size_t>(random.between(0, static_cast<int>(last) - 1))]);
    for (const auto& each : events)
      other.take(each, now);
    RC_ASSERT(text_of(one.tick(now)) == text_of(other.tick(now)));
  }
}

} // namespace core_property_test
