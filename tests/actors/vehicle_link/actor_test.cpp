#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "actors/vehicle_link/actor.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/actors/vehicle_link/vehicle_frames.hpp"

namespace vehicle_link_actor_test {

using namespace godwit;
using namespace godwit::vehicle_link;
using namespace std::chrono_literals;
using runtime::crash_point;

// A line whose other end is the test. It outlives every incarnation, as the real one does.
class test_line final : public wire {
public:
  bool send(std::span<const std::byte> frame, io::link::peer_id) override {
    if (cut)
      return false;
    if (on_frame)
      on_frame(frame);
    scan.feed_datagram(frame, [this](const mavlink::frame_view& each) {
      if (!is_call(each))
        ++sent[each.id()];
    });
    return true;
  }
  // For a heartbeat, before anybody was heard: nobody's command.
  static bool is_call(const mavlink::frame_view& each) {
    return each.id() == mavlink::command_long::message_id &&
           mavlink::decode<mavlink::command_long>(each).command == mavlink::number(mavlink::mav_cmd::request_message);
  }
  mavlink::scanner scan;
  std::map<std::uint32_t, int> sent; // by message id
  bool cut = false;
  std::function<void(std::span<const std::byte>)> on_frame;
};

struct heard {
  std::vector<connection_phase> phases;
  int attitudes = 0;
  int restarts = 0;
};

using ear_handle = runtime::mailbox<runtime::tells<connection_changed>, runtime::tells<mavlink::attitude>,
                                    runtime::tells<vehicle_restarted>>;

class ear final : public runtime::actor_base<ear_handle> {
public:
  ear(runtime::spawn_context context, heard* what) : actor_base(std::move(context)), what_(what) {}

protected:
  behavior_type handlers() override {
    return {on<connection_changed>([this](const connection_changed& m) { what_->phases.push_back(m.phase); }),
            on<mavlink::attitude>([this](const mavlink::attitude&) { ++what_->attitudes; }),
            on<vehicle_restarted>([this](const vehicle_restarted&) { ++what_->restarts; })};
  }

private:
  heard* what_;
};

runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 1ms, .backoff_max = 10ms};
  return result;
}

// A process with a vehicle_link and a listener. Destroying it is SIGKILL.
struct process {
  explicit process(runtime::simulated_disk& disk, settings configured = test::quiet(), signing_settings signing = {})
      : world(disk, 1) {
    const auto ears = std::make_shared<listeners>();
    link = world.actors().add<actor>({.name = "vehicle_link"}, patient(), std::move(configured), std::move(signing),
                                     std::static_pointer_cast<wire>(line), std::shared_ptr<const listeners>(ears));
    ears->add(world.actors().add<ear>({.name = "ear"}, patient(), &what));
    world.start();
    world.run_until_idle();
  }

  template <class M>
  void vehicle_says(const M& message, mavlink::sender as = {1, 1}) {
    arrive(mavlink::encode(message, as, sequence++).span());
  }
  void arrive(std::span<const std::byte> bytes) {
    if (line->incoming().put(io::link::only_peer, bytes, true))
      world.tell(link, wake{});
    world.run_until_idle();
  }
  void link_is(io::link::link_phase phase) {
    if (line->incoming().put(io::link::link_status{phase, phase == io::link::link_phase::up ? "" : "cut", 0}))
      world.tell(link, wake{});
    world.run_until_idle();
  }
  void connect() {
    link_is(io::link::link_phase::up);
    vehicle_says(mavlink::heartbeat{.type = 2, .autopilot = 12});
  }
  connection shown() {
    const auto asked = world.ask(link, 1s, get_connection{});
    world.run_until_idle();
    return asked->answer;
  }

  std::shared_ptr<test_line> line = std::make_shared<test_line>();
  heard what;
  runtime::simulation world;
  own_handle link;
  std::uint8_t sequence = 0;
};

// The journal names it: whoever is heard first by the next process is not taken for it.
TEST(vehicle_link, a_killed_process_takes_no_other_vehicle_than_that_of_the_flight_that_is_open) {
  const mavlink::heartbeat of_quad{.type = 2, .autopilot = 12};
  runtime::simulated_disk disk;
  {
    process flies(disk);
    flies.connect();
    flies.world.tell(flies.link, keep_vehicle{true});
    flies.world.run_until_idle();
    EXPECT_EQ(flies.shown().kept, (vehicle_name{1, 1}));
  }
  {
    process next(disk);
    next.link_is(io::link::link_phase::up);
    next.world.tell(next.link, keep_vehicle{true});
    for (int i = 0; i < 20; ++i) {
      next.vehicle_says(of_quad, {2, 1});
      next.world.advance(1s);
    }
    EXPECT_FALSE(next.shown().connected);
    EXPECT_NE(next.shown().reason.find("system 2 is heard"), std::string::npos) << next.shown().reason;
    next.vehicle_says(of_quad);
    EXPECT_EQ(next.shown().system, 1);
    next.world.tell(next.link, keep_vehicle{false}); // it is over
    next.world.run_until_idle();
  }
  process last(disk);
  last.link_is(io::link::link_phase::up);
  last.vehicle_says(of_quad, {2, 1});
  EXPECT_EQ(last.shown().system, 2);
}

send_command arm() {
  send_command result;
  result.command = mavlink::number(mavlink::mav_cmd::component_arm_disarm);
  result.param1 = 1;
  return result;
}

mavlink::command_ack accepted() { return {.command = mavlink::number(mavlink::mav_cmd::component_arm_disarm)}; }

TEST(vehicle_link, a_command_is_answered_by_the_vehicles_ack) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  const auto asked = p.world.ask(p.link, 5s, arm());
  p.world.run_until_idle();
  EXPECT_EQ(p.line->sent[mavlink::command_long::message_id], 1);
  p.vehicle_says(accepted());
  EXPECT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->answer.verdict, command_verdict::accepted);
}

TEST(vehicle_link, a_held_back_heartbeat_goes_out_as_soon_as_all_who_decide_live) {
  runtime::simulated_disk disk;
  auto careful = test::quiet();
  careful.deciders = {"executor"};
  process p(disk, careful);
  p.connect();
  EXPECT_EQ(p.line->sent[mavlink::heartbeat::message_id], 0);
  p.world.tell(p.link, runtime::child_alive{"executor"});
  p.world.advance(50ms);
  EXPECT_EQ(p.line->sent[mavlink::heartbeat::message_id], 1);
}

TEST(vehicle_link, a_command_without_an_answer_times_out_as_a_typed_outcome) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  const auto asked = p.world.ask(p.link, 5s, arm());
  p.world.advance(1100ms);
  EXPECT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->answer.verdict, command_verdict::timed_out);
}

TEST(vehicle_link, listeners_hear_what_they_accept) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  p.vehicle_says(mavlink::attitude{});
  p.vehicle_says(mavlink::vfr_hud{});
  EXPECT_EQ(p.what.attitudes, 1);
  EXPECT_EQ(p.what.phases, (std::vector{connection_phase::silent, connection_phase::connected}));
}

TEST(vehicle_link, heartbeats_go_out_once_a_second_and_the_link_is_lost_after_five_missed) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  const auto before = p.line->sent[mavlink::heartbeat::message_id];
  p.world.advance(10s);
  EXPECT_NEAR(p.line->sent[mavlink::heartbeat::message_id] - before, 10, 1);
  EXPECT_EQ(p.what.phases.back(), connection_phase::lost);
  EXPECT_EQ(p.world.health().worst(), runtime::health_colour::red);
}

TEST(vehicle_link, a_crash_at_any_point_sends_no_command_twice_and_leaves_no_asker_without_an_answer) {
  for (const auto point : {crash_point::before_handler, crash_point::after_handler}) {
    runtime::simulated_disk disk;
    process p(disk);
    p.connect();
    p.world.crash_at("vehicle_link", point);
    const auto asked = p.world.ask(p.link, 5s, arm());
    p.world.advance(100ms);
    p.vehicle_says(mavlink::heartbeat{.type = 2, .autopilot = 12});
    p.world.advance(6s);
    EXPECT_EQ(p.world.counters("vehicle_link").crashes, 1U) << static_cast<int>(point);
    EXPECT_LE(p.line->sent[mavlink::command_long::message_id], 1) << static_cast<int>(point);
    EXPECT_EQ(asked->answers + asked->failures, 1) << static_cast<int>(point);
  }
}

TEST(vehicle_link, a_command_in_flight_at_a_crash_is_answered_with_outcome_unknown) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  const auto asked = p.world.ask(p.link, 5s, arm());
  p.world.run_until_idle();
  ASSERT_TRUE(p.world.kill("vehicle_link"));
  p.world.advance(100ms);
  EXPECT_EQ(asked->failures, 1);
  EXPECT_EQ(asked->failure.code, runtime::ask_errc::outcome_unknown) << asked->failure.what;
}

TEST(vehicle_link, what_came_in_during_a_restart_is_handled_after_it) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  ASSERT_TRUE(p.world.kill("vehicle_link"));
  p.vehicle_says(mavlink::heartbeat{.type = 2, .autopilot = 12});
  p.vehicle_says(mavlink::attitude{});
  p.world.advance(1s);
  p.vehicle_says(mavlink::heartbeat{.type = 2, .autopilot = 12});
  p.vehicle_says(mavlink::attitude{});
  EXPECT_EQ(p.what.attitudes, 2);
}

TEST(vehicle_link, a_bad_frame_crashes_nothing_and_is_counted) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  for (int i = 0; i < 1'000; ++i)
    p.arrive(std::vector<std::byte>(static_cast<std::size_t>(i % 300 + 1), std::byte{0xFD}));
  EXPECT_EQ(p.world.counters("vehicle_link").crashes, 0U);
  EXPECT_TRUE(p.shown().connected);
  p.vehicle_says(mavlink::attitude{}); // what waited for the rest of a frame is let go by a whole one
  EXPECT_GT(p.shown().parse_errors_total, 0U);
}

TEST(vehicle_link, frames_that_the_link_has_no_room_for_are_counted) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  p.line->cut = true;
  p.world.advance(3s);
  EXPECT_GE(p.shown().dropped_out, 2U);
}

TEST(vehicle_link, a_transfer_under_way_at_a_crash_is_answered_with_outcome_unknown) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  upload_plan plan;
  plan.items.resize(3);
  const auto asked = p.world.ask(p.link, 60s, plan);
  p.world.run_until_idle();
  EXPECT_EQ(p.line->sent[mavlink::mission_count::message_id], 1);
  ASSERT_TRUE(p.world.kill("vehicle_link"));
  p.world.advance(100ms);
  EXPECT_EQ(asked->failures, 1);
  EXPECT_EQ(asked->failure.code, runtime::ask_errc::outcome_unknown) << asked->failure.what;
}

TEST(vehicle_link, a_transfer_that_nobody_answers_ends_as_timed_out) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  upload_plan plan;
  plan.items.resize(1);
  const auto asked = p.world.ask(p.link, 60s, plan);
  p.world.advance(30s);
  ASSERT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->answer.verdict, transfer::verdict::timed_out) << asked->answer.reason;
}

// -- any order of events ---------------------------------------------------------------------------------------------

// What may happen next: WHAT says which, NUMBER is its argument.
void happen(process& p, std::uint8_t what, std::uint8_t number,
            std::vector<std::shared_ptr<runtime::asked<command_outcome>>>& asks) {
  switch (what % 8) {
  case 0:
  case 1: {
    send_command command;
    command.command = static_cast<std::uint16_t>(400 + number % 4);
    asks.push_back(p.world.ask(p.link, 3s, command));
    p.world.run_until_idle();
    return;
  }
  case 2:
    p.vehicle_says(mavlink::command_ack{.command = static_cast<std::uint16_t>(400 + number % 4),
                                        .result = static_cast<std::uint8_t>(number % 7)});
    return;
  case 3:
    p.vehicle_says(mavlink::heartbeat{.type = 2, .autopilot = 12});
    return;
  case 4:
    p.world.advance(std::chrono::milliseconds(number * 10));
    return;
  case 5:
    (void)p.world.kill("vehicle_link");
    p.world.advance(20ms);
    return;
  case 6:
    p.world.crash_at("vehicle_link", number % 2 == 0 ? crash_point::before_handler : crash_point::after_handler);
    return;
  default:
    p.link_is(number % 2 == 0 ? io::link::link_phase::up : io::link::link_phase::down);
    return;
  }
}

RC_GTEST_PROP(vehicle_link_property, every_command_is_answered_once_and_sent_at_most_once_whatever_happens,
              (const std::vector<std::pair<std::uint8_t, std::uint8_t>>& story)) {
  runtime::simulated_disk disk;
  process p(disk);
  p.connect();
  std::vector<std::shared_ptr<runtime::asked<command_outcome>>> asks;
  for (const auto& [what, number] : story)
    happen(p, what, number, asks);
  p.world.forget_planned_crashes();
  p.world.advance(10s);
  for (const auto& each : asks)
    RC_ASSERT(each->answers + each->failures == 1);
  RC_ASSERT(p.line->sent[mavlink::command_long::message_id] <= static_cast<int>(asks.size()));
  // It is alive, whatever happened.
  p.link_is(io::link::link_phase::down);
  p.connect();
  RC_ASSERT(p.shown().connected);
}

// -- signing time ----------------------------------------------------------------------------------------------------

signing_settings with_key() {
  std::array<std::byte, mavlink::secret_key_size> bytes{};
  bytes.fill(std::byte{7});
  return {.key = std::make_shared<mavlink::secret_key>(bytes),
          .link = mavlink::link_id{1},
          .unsigned_frames = mavlink::unsigned_policy::accept_all()};
}

TEST(vehicle_link, no_signing_time_is_used_twice_across_kills_of_the_actor_and_the_process) {
  runtime::simulated_disk disk;
  mavlink::signing_time last{};
  for (int life = 0; life < 5; ++life) {
    process p(disk, test::quiet(), with_key());
    p.connect();
    const auto check = [&](std::span<const std::byte> frame) {
      const auto time = mavlink::signature_of(mavlink::frame_view(frame.data())).time;
      EXPECT_GT(mavlink::units(time), mavlink::units(last));
      last = time;
    };
    p.line->on_frame = check;
    for (int i = 0; i < 3; ++i) {
      p.world.advance(3s);
      (void)p.world.kill("vehicle_link");
    }
  }
  EXPECT_NE(mavlink::units(last), 0U);
}

} // namespace vehicle_link_actor_test
