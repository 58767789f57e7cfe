// Three stations with our own transfer client at one vehicle, over lines that lose, double, overtake and delay frames:
// the vehicle ends with the old plan or with exactly one of the new ones, and no station is told what is not so.
//
// A vehicle that replaces item by item may end with a mixture, but then no station was told that this is its plan, and
// who reads it back learns what is there. Each run is made from one number. It is printed when the run fails, and
// TEST_SEED=number runs that one alone; TEST_FULL=1 makes ten times as many runs.
#include "actors/ground_port/mission_server/server.hpp"

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "io/mavlink/plan_meaning.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/test_rng.hpp"
#include "tests/support/time_units.hpp"
#include "tests/support/transfer_world.hpp"

namespace godwit::tests {
namespace server_stations_test {

namespace mavlink = io::mavlink;
using mavlink::mav_autopilot;
using mavlink::mav_mission_type;
using transfer::holding;
using transfer::verdict;
using plan_items = std::vector<mavlink::mission_item_int>;

using godwit::tests::ms;
constexpr int runs_of_each = 200; // vehicles of each kind
constexpr int runs_of_each_if_full = 2'000;
constexpr mavlink::sender third_station_id{254, 190};
// The stations give up long before; a vehicle that they leave is idle after its own patience.
constexpr std::int64_t resolved_after_ns = 10'000 * ms;

line_settings any_line(test_rng& draw) {
  line_settings result;
  result.delay_ns = draw.between(0, 150) * ms;
  if (draw.one_in(2))
    result.jitter_ns = draw.between(1, 80) * ms;
  if (!draw.one_in(4))
    result.loss = draw.up_to(0.3);
  if (draw.one_in(3))
    result.duplication = draw.up_to(0.2);
  return result;
}

bool is_plan(const plan_items& held, const plan_items& plan) { return !mavlink::first_difference(plan, held, true); }

struct kind {
  std::string name;
  mission_server::server_profile vehicle;
  mav_autopilot autopilot{};
};

std::ostream& operator<<(std::ostream& out, const kind& which) { return out << which.name; }

class run {
public:
  run(const kind& which, std::uint64_t seed)
      : seed_(seed), draw_(seed), vehicle_(which.vehicle),
        world_(which.vehicle, transfer::profile_for(which.autopilot), any_line(draw_), seed) {}

  void play() {
    put_old_plan();
    stations_ = {&world_.ours(), &world_.add_station(other_station_id, any_line(draw_)),
                 &world_.add_station(third_station_id, any_line(draw_))};
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      // Often of the same size, so that a count tells nothing.
      plans_.push_back(mission_of(draw_.one_in(2) ? 12 : draw_.between(3, 26), seed_ + i + 1));
      world_.run_for(draw_.between(0, 1'500) * ms);
      begin(i);
    }
    for (auto* each : stations_)
      ASSERT_TRUE(world_.run_until_idle(*each));
    world_.run_for(resolved_after_ns);
    ASSERT_TRUE(world_.vehicle().is_idle());
    check_what_is_held();
    for (std::size_t i = 0; i < stations_.size(); ++i)
      check_what_was_said(i);
    check_what_is_read();
  }

private:
  [[nodiscard]] const plan_items& held() { return world_.vehicle().plan(mav_mission_type::mission).items; }

  void put_old_plan() {
    old_ = mission_of(draw_.between(0, 20), seed_);
    for (std::size_t i = 0; i < old_.size(); ++i)
      old_[i].seq = static_cast<std::uint16_t>(i);
    world_.vehicle().put_plan(mav_mission_type::mission, old_);
    if (draw_.one_in(2))
      world_.report_mission_every_second();
  }

  // Of a different number of items for each station: where no MISSION_ACK has come, the client may take a new plan id
  // with its own number of items for its own plan, which another station's plan of that size has as well.
  int any_size(std::size_t i) { return draw_.between(1, 8) * 3 + static_cast<int>(i); }

  // Mostly an upload; the third may read instead.
  void begin(std::size_t i) {
    is_reading_.push_back(i == 2 && draw_.one_in(2));
    auto& client = stations_[i]->client;
    const auto now_ns = world_.time().now_ns();
    world_.begin(*stations_[i], is_reading_[i] ? client.download(mav_mission_type::mission, now_ns)
                                               : client.upload(mav_mission_type::mission, plans_[i], now_ns));
  }

  [[nodiscard]] std::size_t author(mavlink::sender by) const {
    for (std::size_t i = 0; i < stations_.size(); ++i)
      if (stations_[i]->id == by)
        return i;
    return stations_.size();
  }

  void check_what_is_held() {
    for (const auto& each : world_.history()) {
      const auto i = author(each.by);
      ASSERT_LT(i, stations_.size());
      EXPECT_TRUE(is_plan(each.items, plans_[i])) << "whole, and of who brought it";
    }
    if (!vehicle_.is_atomic)
      return;
    const auto& expected = world_.history().empty() ? old_ : world_.history().back().items;
    EXPECT_TRUE(transfer_world::is_same(held(), expected));
  }

  [[nodiscard]] bool was_held(std::size_t i) const {
    return std::any_of(world_.history().begin(), world_.history().end(),
                       [&](const auto& each) { return each.by == stations_[i]->id && is_plan(each.items, plans_[i]); });
  }

  void check_what_was_said(std::size_t i) {
    ASSERT_EQ(stations_[i]->outcomes.size(), 1U);
    const auto& said = stations_[i]->outcomes.front();
    SCOPED_TRACE("station " + std::to_string(i) + ": " + std::string(io::name_of(said.verdict)) + ", proof " +
                 std::string(io::name_of(said.proof)) + ", holding " + std::string(io::name_of(said.holding)) + ' ' +
                 said.reason);
    if (is_reading_[i]) {
      if (said.verdict == verdict::accepted && vehicle_.is_atomic) {
        EXPECT_TRUE(was_read_whole(said.items));
      }
      return;
    }
    if (said.verdict == verdict::accepted) {
      EXPECT_TRUE(was_held(i));
    }
    EXPECT_EQ(said.verdict == verdict::accepted, said.holding == holding::this_plan);
    if (said.holding == holding::unchanged) {
      EXPECT_FALSE(was_held(i));
    }
  }

  [[nodiscard]] bool was_read_whole(const plan_items& read) const {
    return transfer_world::is_same(read, old_) ||
           std::any_of(world_.history().begin(), world_.history().end(),
                       [&](const auto& each) { return transfer_world::is_same(read, each.items); });
  }

  void check_what_is_read() {
    const auto read = world_.download();
    if (read.verdict == verdict::accepted) {
      EXPECT_TRUE(transfer_world::is_same(read.items, held()));
    }
  }

  std::uint64_t seed_;
  test_rng draw_;
  mission_server::server_profile vehicle_;
  transfer_world world_;
  std::vector<transfer_world::station*> stations_;
  std::vector<plan_items> plans_; // of each station
  std::vector<bool> is_reading_;
  plan_items old_;
};

class server_stations : public testing::TestWithParam<kind> {};

TEST_P(server_stations, three_at_once_leave_a_whole_plan_and_are_told_the_truth) {
  const char* one = std::getenv("TEST_SEED");
  const auto first = first_seed();
  const int runs = one != nullptr ? 1 : is_full_run() ? runs_of_each_if_full : runs_of_each;
  for (int i = 0; i < runs && !HasFailure(); ++i) {
    const auto seed = first + static_cast<std::uint64_t>(i);
    SCOPED_TRACE("to run it again: TEST_SEED=" + std::to_string(seed));
    run(GetParam(), seed).play();
  }
}

INSTANTIATE_TEST_SUITE_P(
    with, server_stations,
    testing::Values(kind{"our_own_server", mission_server::plain_profile(), mav_autopilot::generic},
                    kind{"px4", mission_server::px4_profile(), mav_autopilot::px4},
                    kind{"copter", mission_server::ardupilot_copter_profile(), mav_autopilot::ardupilotmega},
                    kind{"plane", mission_server::ardupilot_plane_profile(), mav_autopilot::ardupilotmega},
                    kind{"rover", mission_server::ardupilot_rover_profile(), mav_autopilot::ardupilotmega}),
    [](const auto& which) { return which.param.name; });

} // namespace server_stations_test
} // namespace godwit::tests
