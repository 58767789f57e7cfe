// A whole life of each personality, from the first heartbeat over a flight to the next start, with the transfer client
// that godwit itself uses.
#include <algorithm>
#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "actors/vehicle_link/transfer/client.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace life_test {

namespace transfer = vehicle_link::transfer;

// Lets godwit's client talk to the vehicle.
class companion {
public:
  companion(vehicle_world& world, mavlink::mav_autopilot autopilot)
      : world_(world), client_(station_id, vehicle_id, transfer::profile_for(autopilot), 0) {}

  transfer::outcome upload(plan items) {
    return run(client_.upload(mav_mission_type::mission, std::move(items), world_.now_ns()));
  }
  transfer::outcome download() { return run(client_.download(mav_mission_type::mission, world_.now_ns())); }

private:
  transfer::outcome run(transfer::step first) {
    next_ = world_.all().size();
    execute(std::move(first));
    const auto done = [this] {
      hear();
      if (client_.next_deadline_ns().value_or(INT64_MAX) <= world_.now_ns())
        execute(client_.on_time(world_.now_ns()));
      return outcome_.has_value();
    };
    outcome_.reset();
    EXPECT_TRUE(world_.run_until(done, 60 * s)) << "the transfer does not end";
    return outcome_.value_or(transfer::outcome{});
  }

  void execute(transfer::step step) {
    for (const auto& each : step.messages)
      std::visit([this](const auto& message) { world_.send(message); }, each);
    if (step.finished)
      outcome_ = std::move(step.finished);
  }

  template <class M>
  bool offer(const heard& each) {
    if (each.id != M::message_id)
      return false;
    execute(client_.on(each.as<M>(), world_.now_ns()));
    return true;
  }

  void hear() {
    while (next_ < world_.all().size()) {
      const auto each = world_.all()[next_++];
      static_cast<void>(offer<mavlink::mission_request_int>(each) || offer<mavlink::mission_request>(each) ||
                        offer<mavlink::mission_count>(each) || offer<mavlink::mission_item_int>(each) ||
                        offer<mavlink::mission_ack>(each) || offer<mavlink::mission_current>(each));
    }
  }

  vehicle_world& world_;
  transfer::client client_;
  std::size_t next_ = 0;
  std::optional<transfer::outcome> outcome_;
};

struct life {
  personality who;
  mavlink::mav_autopilot autopilot;
  std::function<plan(const position&)> items;
  std::vector<int> reached; // in this order, without repetitions
  std::string last_mode;
  bool ends_armed = false;
};

std::vector<int> without_repetitions(std::vector<int> all) {
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void live(const life& with) {
  vehicle_world world(with.who);
  companion godwit(world, with.autopilot);
  ASSERT_TRUE(world.run_until([&] { return world.last<mavlink::heartbeat>().has_value(); }, 2 * s));

  const auto items = with.items(world.home());
  ASSERT_EQ(godwit.upload(items).verdict, transfer::verdict::accepted);
  ASSERT_TRUE(world.make_ready());
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(world.run_until(
      [&] { return world.last<mavlink::mission_current>()->mission_state == 5 && !world.picture().in_air; }, 600 * s));
  world.run_for(3 * s);
  EXPECT_EQ(without_repetitions(world.reached()), with.reached);
  EXPECT_EQ(world.picture().mode, with.last_mode);
  EXPECT_EQ(world.picture().armed, with.ends_armed);
  EXPECT_GT(world.now_ns() - vehicle_world::start_ns, 10 * s);

  const auto back = godwit.download();
  EXPECT_EQ(back.verdict, transfer::verdict::accepted);
  EXPECT_EQ(back.items.size(), items.size());

  world.subject().reboot(world.now_ns());
  const auto restarted_ns = world.now_ns();
  world.run_for(2 * s);
  EXPECT_LE(world.last_ns<mavlink::heartbeat>(), restarted_ns) << "it must be silent while it starts";
  world.run_for(7 * s);
  EXPECT_LT(world.last<mavlink::attitude>()->time_boot_ms, 7'000U);
  EXPECT_FALSE(world.picture().armed);
  EXPECT_EQ(godwit.download().items.size(), items.size()) << "plans survive";
}

TEST(life, of_a_rover) {
  live({personality::rover,
        mavlink::mav_autopilot::generic,
        [](const position& home) { return row_of(4, home); },
        {0, 1, 2, 3},
        "HOLD",
        true});
}

TEST(life, of_a_px4) {
  live({personality::px4,
        mavlink::mav_autopilot::px4,
        [](const position& home) { return flight_of(3, home, personality::px4); },
        {0, 1, 2, 3, 4},
        "AUTO.MISSION",
        false});
}

TEST(life, of_an_ardupilot) {
  live({personality::ardupilot,
        mavlink::mav_autopilot::ardupilotmega,
        [](const position& home) { return with_return(flight_of(3, home, personality::ardupilot)); },
        {1, 2, 3, 4, 5},
        "AUTO",
        false});
}

TEST(life, is_the_same_twice_with_the_same_seed) {
  for (const auto who : {personality::rover, personality::px4, personality::ardupilot, personality::plane}) {
    vehicle_world one(vehicle_settings{.who = who, .seed = 7});
    vehicle_world other(vehicle_settings{.who = who, .seed = 7});
    for (auto* each : {&one, &other}) {
      ASSERT_TRUE(each->upload(flight_of(2, each->home(), who)));
      ASSERT_TRUE(each->make_ready());
      ASSERT_TRUE(each->command(mav_cmd::mission_start));
      each->run_for(30 * s);
    }
    ASSERT_EQ(one.all().size(), other.all().size());
    for (std::size_t i = 0; i < one.all().size(); ++i)
      ASSERT_EQ(one.all()[i].bytes, other.all()[i].bytes) << "frame " << i;
  }
}

TEST(life, goes_as_far_in_a_twentieth_of_the_time_at_speed_20) {
  vehicle_world world(vehicle_settings{.who = personality::px4, .speed = 20});
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  const auto began_ns = world.now_ns();
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 60 * s));
  EXPECT_LT(world.now_ns() - began_ns, 5 * s);
  EXPECT_GT(world.picture().world_ms, 20'000);
}

} // namespace life_test
} // namespace godwit::sim::test
