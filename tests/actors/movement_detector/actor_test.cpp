#include "actors/movement_detector/actor.hpp"

#include <gtest/gtest.h>

#include "runtime/simulation/simulation.hpp"

namespace actor_test {

using namespace godwit;
using namespace godwit::movement_detector;
using namespace std::chrono_literals;

// Eyes that only count what they are told.
class counted_port final : public eyes_port {
public:
  void start(std::uint32_t run, const io::eyes::begin&) override {
    run_ = run;
    ++starts;
    is_running = true;
  }
  void end(std::uint32_t upto) override { is_running = is_running && run_ > upto; }
  void tell(const io::eyes::pose&) override { ++poses; }
  void keep_picture(std::uint32_t, std::int64_t, const std::string&) override { ++pictures; }
  std::uint32_t run_ = 0;
  int starts = 0;
  int poses = 0;
  int pictures = 0;
  bool is_running = false;
};

using ear_handle = runtime::mailbox<runtime::tells<mapobjects_store::sighting>, runtime::tells<scan_controller::view>>;

struct heard {
  int sightings = 0;
  int views = 0;
  bool was_seeing = false;
};

class ear final : public runtime::actor_base<ear_handle> {
public:
  ear(runtime::spawn_context context, heard* to) : actor_base(std::move(context)), to_(to) {}

protected:
  behavior_type handlers() override {
    return {on<mapobjects_store::sighting>([this](const mapobjects_store::sighting&) { ++to_->sightings; }),
            on<scan_controller::view>([this](const scan_controller::view& m) {
              ++to_->views;
              to_->was_seeing = m.is_seeing;
            })};
  }

private:
  heard* to_;
};

struct process {
  process() : world(disk, 1) {
    const auto others = std::make_shared<peers>();
    const auto ears = world.actors().add<ear>({.name = "ear"}, {}, &said);
    others->sightings = ears;
    others->scan = ears;
    others->say = [](const std::string&, bool) {};
    settings configured;
    configured.width_px = 640;
    configured.height_px = 360;
    configured.focal_px = 500;
    who = world.actors().add<actor>({.name = "movement_detector", .policy = runtime::on_crash::lose}, {}, configured,
                                    std::shared_ptr<const peers>(others), std::static_pointer_cast<eyes_port>(port), 7);
    world.start();
    world.run_until_idle();
  }
  void say_status() {
    helper_status all_is_well{port->run_, {}};
    all_is_well.what.source = io::eyes::source_state::playing;
    all_is_well.what.usable_at_ns = world.now_ns();
    world.tell(who, all_is_well);
    world.run_until_idle();
  }
  void fly() {
    scan_controller::survey_progress flown;
    flown.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
    flown.item_id = "x";
    flown.is_flying = true;
    world.tell(who, flown);
    world.tell(who, io::mavlink::global_position_int{});
    world.tell(who, io::mavlink::attitude{});
    world.run_until_idle();
  }
  heard said;
  std::shared_ptr<counted_port> port = std::make_shared<counted_port>();
  runtime::simulated_disk disk;
  runtime::simulation world;
  own_handle who;
};

TEST(movement_detector, it_starts_the_eyes_feeds_them_and_hands_on_what_they_see) {
  process p;
  EXPECT_EQ(p.port->starts, 1);
  p.say_status();
  p.fly();
  EXPECT_EQ(p.port->poses, 1);
  helper_candidates seen{p.port->run_, {}};
  seen.what.captured_ns = p.world.now_ns();
  io::eyes::candidate one;
  one.confidence = 0.9;
  one.place = io::eyes::ground_place{47.4, 8.5, 1, 1, 0, 2};
  seen.what.seen = {one};
  p.world.tell(p.who, seen);
  p.world.run_until_idle();
  EXPECT_EQ(p.said.sightings, 1);
  EXPECT_EQ(p.port->pictures, 1);
  p.world.advance(600ms);
  EXPECT_TRUE(p.said.was_seeing);
}

TEST(movement_detector, eyes_that_say_nothing_are_ended_and_started_again_and_the_view_says_so) {
  process p;
  p.say_status();
  p.fly();
  p.world.advance(2100ms);
  EXPECT_FALSE(p.said.was_seeing);
  p.world.advance(1s);
  EXPECT_EQ(p.port->starts, 2);
  EXPECT_TRUE(p.port->is_running);
}

TEST(movement_detector, a_crash_of_its_own_starts_new_eyes_and_ends_the_old_ones) {
  process p;
  p.say_status();
  p.world.crash_at("movement_detector", runtime::crash_point::after_handler);
  p.fly();
  p.world.advance(1s);
  EXPECT_EQ(p.world.counters("movement_detector").crashes, 1U);
  EXPECT_EQ(p.port->starts, 2);
  EXPECT_TRUE(p.port->is_running);
}

TEST(movement_detector, it_says_how_it_is) {
  process p;
  p.say_status();
  p.fly();
  const auto asked = p.world.ask(status_handle(p.who), 1s, get_eyes{});
  p.world.run_until_idle();
  EXPECT_TRUE(asked->answer.is_seeing);
  EXPECT_EQ(asked->answer.starts, 1U);
}

} // namespace actor_test
