// Plans through vehicle_link's core, against the vehicle's side of the same exchange: whole frames, no line between.
#include <gtest/gtest.h>

#include <deque>

#include "actors/ground_port/mission_server/server.hpp"
#include "tests/actors/vehicle_link/vehicle_frames.hpp"

namespace core_transfer_test {

using namespace godwit::vehicle_link;
using namespace godwit::vehicle_link::test;
namespace mission_server = godwit::ground_port::mission_server;

constexpr auto mission = mavlink::mav_mission_type::mission;

upload_plan survey(int count) {
  upload_plan result;
  for (int i = 0; i < count; ++i)
    result.items.push_back({.frame = 3,
                            .command = mavlink::number(mavlink::mav_cmd::nav_waypoint),
                            .x = 473'977'418 + 100 * i,
                            .y = 85'455'938,
                            .z = 30});
  return result;
}

// A core and a vehicle; what one sends the other hears at once.
class conversation {
public:
  explicit conversation(const mission_server::server_profile& server_profile = mission_server::px4_profile())
      : it(quiet(), {}, {}), vehicle(server_profile, {1, 1}) {
    (void)it.on_link(link_up(), at(0));
    (void)voice_.beat(it, 0);
  }

  // Carries frames to and fro until nobody has anything to say, and keeps what is told.
  void execute(effects first) {
    std::deque<effects> waiting;
    waiting.push_back(std::move(first));
    while (!waiting.empty()) {
      const auto now = std::move(waiting.front());
      waiting.pop_front();
      for (const auto& each : now)
        if (const auto* out = std::get_if<transmission>(&each))
          hear(out->frame.view(), waiting);
        else
          told.push_back(each);
    }
  }

  [[nodiscard]] std::vector<resolved_transfer> resolved() const {
    std::vector<resolved_transfer> result;
    for (const auto& each : told)
      if (const auto* over = std::get_if<resolved_transfer>(&each))
        result.push_back(*over);
    return result;
  }

  core it;
  mission_server::server vehicle;
  effects told;
  std::int64_t now_ns = 10 * ms;

private:
  void hear(const mavlink::frame_view& frame, std::deque<effects>& waiting) {
    now_ns += ms;
    mavlink::visit(frame, [&]<class M>(const M& message) {
      if constexpr (std::is_constructible_v<mission_server::incoming, const M&>)
        for (const auto& each : vehicle.on(frame.from(), message, now_ns).messages)
          std::visit([&](const auto& answer) { waiting.push_back(voice_.say(it, answer, now_ns)); }, each);
    });
  }

  vehicle_voice voice_;
};

TEST(vehicle_link_transfer, a_plan_goes_up_and_the_asker_hears_what_became_of_it) {
  conversation c;
  c.execute(c.it.on_upload(7, survey(50), at(c.now_ns)));
  ASSERT_EQ(c.resolved().size(), 1U);
  EXPECT_EQ(c.resolved()[0].request_id, 7U);
  EXPECT_EQ(c.resolved()[0].outcome.verdict, transfer::verdict::accepted) << c.resolved()[0].outcome.reason;
  EXPECT_EQ(c.vehicle.plan(mission).items.size(), 50U);
}

TEST(vehicle_link_transfer, listeners_hear_how_far_it_is) {
  conversation c;
  c.execute(c.it.on_upload(7, survey(50), at(c.now_ns)));
  const auto steps = announced<transfer::progress>(c.told);
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.back(), (transfer::progress{50, 50}));
}

TEST(vehicle_link_transfer, a_plan_comes_down_as_the_vehicle_holds_it_and_is_cleared) {
  conversation c;
  c.execute(c.it.on_upload(1, survey(20), at(c.now_ns)));
  c.execute(c.it.on_download(2, {mission}, at(c.now_ns)));
  ASSERT_EQ(c.resolved().size(), 2U);
  EXPECT_EQ(c.resolved()[1].outcome.items.size(), 20U);
  c.execute(c.it.on_clear(3, {mission}, at(c.now_ns)));
  EXPECT_EQ(c.resolved().back().outcome.verdict, transfer::verdict::accepted);
  EXPECT_TRUE(c.vehicle.plan(mission).items.empty());
}

TEST(vehicle_link_transfer, a_second_one_is_refused_while_one_is_under_way) {
  conversation c;
  (void)c.it.on_upload(1, survey(20), at(c.now_ns)); // its frames are not carried: it waits
  c.execute(c.it.on_download(2, {mission}, at(c.now_ns)));
  ASSERT_EQ(c.resolved().size(), 1U);
  EXPECT_EQ(c.resolved()[0].request_id, 2U);
  EXPECT_EQ(c.resolved()[0].outcome.verdict, transfer::verdict::not_begun);
  EXPECT_NE(c.resolved()[0].outcome.reason.find("under way"), std::string::npos);
}

TEST(vehicle_link_transfer, nothing_is_begun_without_a_vehicle_and_the_reason_says_so) {
  core it(quiet(), {}, {});
  const auto refused = [&](const effects& done) { return std::get<resolved_transfer>(done.at(0)).outcome; };
  EXPECT_NE(refused(it.on_upload(1, survey(1), at(0))).reason.find("down"), std::string::npos);
  (void)it.on_link(link_up(), at(0));
  const auto outcome = refused(it.on_upload(1, survey(1), at(0)));
  EXPECT_EQ(outcome.verdict, transfer::verdict::not_begun);
  EXPECT_EQ(outcome.holding, transfer::holding::unchanged);
  EXPECT_NE(outcome.reason.find("no vehicle"), std::string::npos);
}

TEST(vehicle_link_transfer, a_cancelled_one_ends_at_once_and_makes_room) {
  conversation c;
  (void)c.it.on_upload(1, survey(20), at(c.now_ns));
  c.execute(c.it.on_cancel_transfer(at(c.now_ns)));
  ASSERT_EQ(c.resolved().size(), 1U);
  EXPECT_EQ(c.resolved()[0].outcome.verdict, transfer::verdict::cancelled);
  // The next may wait until nothing of this one can be on the line any more.
  c.execute(c.it.on_upload(2, survey(20), at(c.now_ns)));
  for (const auto end_ns = c.now_ns + 5 * s; c.resolved().size() < 2 && c.now_ns < end_ns; c.now_ns += 10 * ms)
    c.execute(c.it.on_time(at(c.now_ns)));
  EXPECT_EQ(c.resolved().back().outcome.verdict, transfer::verdict::accepted);
}

TEST(vehicle_link_transfer, the_next_deadline_is_that_of_the_transfer_too) {
  conversation c;
  (void)c.it.on_time(at(c.now_ns)); // the heartbeat is out
  (void)c.it.on_upload(1, survey(20), at(c.now_ns));
  EXPECT_LT(c.it.next_deadline_ns(), c.now_ns + 500 * ms);
}

} // namespace core_transfer_test
