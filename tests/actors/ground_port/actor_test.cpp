// ground_port as an actor: what crashes and kills do to plans, starts and those who wait.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "actors/ground_port/actor.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/actors/ground_port/port_fixture.hpp"

namespace ground_port_actor_test {

using namespace godwit;
using namespace godwit::ground_port;
using namespace std::chrono_literals;
using runtime::crash_point;
using test::start_command;
using test::station_id;
using test::waypoints;

constexpr std::array points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                            crash_point::before_dispatch};

// A line whose other end is the test. It outlives every incarnation, as the real one does.
class test_line final : public wire {
public:
  bool send(std::span<const std::byte> frame, io::link::peer_id) override {
    scan.feed_datagram(frame, [this](const mavlink::frame_view& each) {
      ++sent[each.id()];
      if (each.id() == mavlink::mission_request_int::message_id)
        requests.push_back(mavlink::decode<mavlink::mission_request_int>(each));
      if (each.id() == mavlink::mission_ack::message_id)
        acks.push_back(mavlink::decode<mavlink::mission_ack>(each));
      if (each.id() == mavlink::command_ack::message_id)
        results.push_back(mavlink::decode<mavlink::command_ack>(each));
      if (each.id() == mavlink::mission_current::message_id)
        current = mavlink::decode<mavlink::mission_current>(each);
      if (each.id() == mavlink::statustext::message_id)
        texts.insert(test::text_of(mavlink::decode<mavlink::statustext>(each)));
    });
    return true;
  }
  mavlink::scanner scan;
  std::map<std::uint32_t, int> sent; // by message id
  std::vector<mavlink::mission_request_int> requests;
  std::vector<mavlink::mission_ack> acks;
  std::vector<mavlink::command_ack> results;
  std::set<std::string> texts;
  mavlink::mission_current current;
};

// What the stand-in of the executor saw, outside of it, where no crash reaches it.
struct executor_record {
  std::vector<executor::start_mission> starts;
  std::vector<std::uint32_t> plans; // by id; 0: cleared
  std::vector<std::uint16_t> set_currents;
  std::vector<operators::command> words;
  std::string objection; // to every word; empty: they are taken
  bool hears_words = true;
  std::vector<std::string> story; // of what is passed on
  std::vector<operator_link> operator_news;
  bool answers = true;
  handle port; // whom it answers
};

using stand_in_handle = runtime::mailbox<
    runtime::tells<executor::start_mission>, runtime::asks<executor::set_current, executor::current_answer>,
    runtime::tells<executor::plan_taken>, runtime::tells<executor::plan_cleared>,
    runtime::asks<executor::station_act, executor::act_answer>, runtime::tells<executor::act_acknowledged>,
    runtime::asks<operators::command, operators::answer>, runtime::tells<operator_link>,
    runtime::tells<vehicle_link::relayed_frame>, runtime::tells<failsafe::taken_over>>;

class stand_in final : public runtime::actor_base<stand_in_handle> {
public:
  stand_in(runtime::spawn_context context, executor_record* record) : actor_base(std::move(context)), record_(record) {}

protected:
  behavior_type handlers() override {
    return {
        on<executor::start_mission>([this](const executor::start_mission& m) {
          record_->starts.push_back(m);
          if (!record_->answers)
            return;
          tell(record_->port, executor::start_answer{m.key, executor::start_verdict::started, {}});
          tell(record_->port,
               mission_progress{m.plan_id, m.first, mavlink::mission_state::active, mavlink::mission_mode::active});
        }),
        on<executor::set_current>([this](const executor::set_current& m) {
          record_->set_currents.push_back(m.index);
          return executor::current_answer{executor::current_verdict::going, {}};
        }),
        on<executor::plan_taken>([this](const executor::plan_taken& m) {
          record_->plans.push_back(m.plan_id);
          tell(record_->port, plan_judged{m.type, m.plan_id, plan_verdict::taken});
        }),
        on<executor::plan_cleared>([this](const executor::plan_cleared& m) {
          record_->plans.push_back(0);
          tell(record_->port, plan_judged{m.type, 0, plan_verdict::taken});
        }),
        on_deferred<executor::station_act, executor::act_answer>(
            [this](const executor::station_act& m, std::uint64_t request) {
              record_->story.push_back("asked about " + m.what);
              if (record_->answers)
                answer_later(request, executor::act_answer{executor::act_verdict::pass, {}});
            }),
        on<executor::act_acknowledged>([this](const executor::act_acknowledged& m) {
          record_->story.push_back(m.is_refused ? "the vehicle has refused" : "the vehicle has accepted");
        }),
        on<vehicle_link::relayed_frame>([this](const vehicle_link::relayed_frame& m) {
          record_->story.push_back("vehicle hears " + std::to_string(m.message));
        }),
        on<failsafe::taken_over>([this](const failsafe::taken_over&) { record_->story.push_back("taken over"); }),
        on_deferred<operators::command, operators::answer>([this](const operators::command& m, std::uint64_t request) {
          record_->words.push_back(m);
          if (record_->hears_words)
            answer_later(request, operators::answer{record_->objection.empty(), record_->objection});
        }),
        on<operator_link>([this](const operator_link& m) { record_->operator_news.push_back(m); })};
  }

private:
  executor_record* record_;
};

runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 1ms, .backoff_max = 10ms};
  return result;
}

// A process with a ground_port and a stand-in of the executor. Destroying it is SIGKILL.
struct process {
  process(runtime::simulated_disk& disk, executor_record& record, bool with_executor = true,
          signing_settings signing = {}, settings configured = {})
      : world(disk, 1) {
    const auto others = std::make_shared<peers>();
    port = world.actors().add<actor>({.name = "ground_port"}, patient(), std::move(configured), std::move(signing),
                                     std::static_pointer_cast<wire>(line), std::shared_ptr<const peers>(others));
    record.port = port;
    const auto executor = world.actors().add<stand_in>({.name = "executor"}, patient(), &record);
    if (with_executor)
      others->executor = executor;
    others->operator_ears.emplace_back(executor);
    others->vehicle = vehicle_link::relay_handle(executor);
    others->failsafe = takeover_listener(executor);
    world.start();
    world.run_until_idle();
    if (line->incoming().put(io::link::link_status{io::link::link_phase::up, "", 0}))
      world.tell(port, wake{});
    world.run_until_idle();
  }

  template <class M>
  void say(M message, mavlink::sender from = station_id) {
    if constexpr (requires { message.target_component; }) {
      message.target_system = 1;
      message.target_component = 191;
    }
    say_as_it_is(message, from);
  }
  template <class M>
  void say_as_it_is(const M& message, mavlink::sender from = station_id) {
    if (line->incoming().put(io::link::only_peer, mavlink::encode(message, from, sequence++).span(), true))
      world.tell(port, wake{});
  }
  port_description shown() {
    const auto asked = world.ask(port, 1s, get_port{});
    world.advance(10ms);
    return asked->answer;
  }

  // As a station does it: answers what is asked for, repeats the last item, and begins again when nothing comes. The
  // id with which the port accepted it; 0: it did not.
  std::uint32_t upload(const std::vector<mavlink::mission_item_int>& items) {
    for (int attempt = 0; attempt < 5; ++attempt) {
      line->acks.clear();
      line->requests.clear();
      say(mavlink::mission_count{.count = static_cast<std::uint16_t>(items.size())});
      for (int silent = 0; silent < 3;) {
        world.advance(100ms);
        if (!line->acks.empty())
          break;
        silent = line->requests.empty() ? silent + 1 : 0;
        for (const auto& each : std::exchange(line->requests, {}))
          if (each.seq < items.size())
            say(items[each.seq]);
      }
      if (!line->acks.empty() && line->acks.back().type == 0)
        return line->acks.back().opaque_id;
    }
    return 0;
  }

  // As a station does it: repeats with a confirmation that rises, until there is a final answer. -1: none came.
  int start(float first = 0) {
    line->results.clear();
    for (std::uint8_t confirmation = 0; confirmation < 48; ++confirmation) {
      say(start_command(first, 0, confirmation));
      world.advance(500ms);
      for (const auto& each : line->results)
        if (each.result != mavlink::number(mavlink::mav_result::in_progress))
          return each.result;
    }
    return -1;
  }

  std::shared_ptr<test_line> line = std::make_shared<test_line>();
  runtime::simulation world;
  own_handle port;
  std::uint8_t sequence = 0;
};

TEST(ground_port_actor, a_mission_goes_up_is_started_and_followed) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  const auto id = p.upload(waypoints(3));
  EXPECT_NE(id, 0U);
  EXPECT_EQ(executor.plans, std::vector<std::uint32_t>{id});
  EXPECT_EQ(p.start(), 0);
  ASSERT_EQ(executor.starts.size(), 1U);
  EXPECT_EQ(executor.starts[0].plan_id, id);
  p.world.advance(200ms);
  EXPECT_EQ(p.line->current.mission_state, mavlink::number(mavlink::mission_state::active));
  EXPECT_TRUE(p.line->texts.contains("Mission started"));
  p.say(test::command(mavlink::mav_cmd::do_set_mission_current, 2));
  p.world.advance(200ms);
  EXPECT_EQ(executor.set_currents, std::vector<std::uint16_t>{2});
  EXPECT_EQ(p.line->results.back().result, 0);
}

TEST(ground_port_actor, heartbeats_progress_and_the_operators_link_are_told_once_a_second) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  p.say(mavlink::heartbeat{.type = 6});
  p.world.advance(10s);
  EXPECT_NEAR(p.line->sent[mavlink::heartbeat::message_id], 10, 1);
  EXPECT_NEAR(p.line->sent[mavlink::mission_current::message_id], 10, 1);
  EXPECT_NEAR(static_cast<double>(executor.operator_news.size()), 10, 1);
  EXPECT_TRUE(executor.operator_news.back().ever_heard);
}

TEST(ground_port_actor, what_the_vehicle_says_is_forwarded) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  p.world.tell(p.port, mavlink::attitude{});
  p.world.tell(p.port, mavlink::statustext{});
  p.world.run_until_idle();
  EXPECT_EQ(p.line->sent[mavlink::attitude::message_id], 1);
  EXPECT_EQ(p.line->sent[mavlink::statustext::message_id], 1);
}

TEST(ground_port_actor, without_an_executor_a_start_is_rejected_for_now) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor, false);
  EXPECT_NE(p.upload(waypoints(3)), 0U);
  EXPECT_EQ(p.start(), static_cast<int>(mavlink::mav_result::temporarily_rejected));
  EXPECT_TRUE(p.line->texts.contains("Mission start: no executor is there"));
}

TEST(ground_port_actor, an_executor_that_is_silent_is_not_waited_for_for_ever) {
  runtime::simulated_disk disk;
  executor_record executor;
  executor.answers = false;
  process p(disk, executor);
  (void)p.upload(waypoints(3));
  EXPECT_EQ(p.start(), static_cast<int>(mavlink::mav_result::temporarily_rejected));
  EXPECT_EQ(executor.starts.size(), 1U);
}

TEST(ground_port_actor, a_disk_that_does_not_write_holds_back_the_acknowledgement) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  p.world.journal().fail_writes(true);
  EXPECT_EQ(p.upload(waypoints(3)), 0U);
  EXPECT_TRUE(executor.plans.empty());
  p.world.journal().fail_writes(false);
  EXPECT_NE(p.upload(waypoints(3)), 0U);
}

// -- commands of operators -----------------------------------------------------------------------------

mavlink::command_int go_to_command() {
  return {.frame = mavlink::number(mavlink::mav_frame::global_relative_alt),
          .command = mavlink::number(mavlink::mav_cmd::do_reposition),
          .param1 = -1,
          .x = 500'000'000,
          .y = 364'000'000,
          .z = 30};
}

// -- what people do ---------------------------------------------------------------------------------

settings passing_on() {
  settings result;
  result.as.component = 1;
  result.passes = true;
  return result;
}

mavlink::command_long arm_or(mavlink::mav_cmd what, float param1) {
  auto result = test::command(what, param1);
  result.target_system = result.target_component = 1;
  return result;
}

TEST(ground_port_actor, what_a_person_means_is_asked_about_before_the_vehicle_hears_it) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor, true, {}, passing_on());
  p.say_as_it_is(arm_or(mavlink::mav_cmd::component_arm_disarm, 1));
  p.world.advance(100ms);
  EXPECT_EQ(executor.story, (std::vector<std::string>{"asked about Arm", "vehicle hears 76"}));
}

TEST(ground_port_actor, a_stop_goes_on_after_a_second_where_the_executor_is_silent_and_the_failsafe_hears_it_first) {
  runtime::simulated_disk disk;
  executor_record executor;
  executor.answers = false;
  process p(disk, executor, true, {}, passing_on());
  p.say_as_it_is(arm_or(mavlink::mav_cmd::nav_return_to_launch, 0));
  p.world.advance(900ms);
  EXPECT_EQ(executor.story, (std::vector<std::string>{"asked about Return"}));
  p.world.advance(200ms);
  EXPECT_EQ(executor.story, (std::vector<std::string>{"asked about Return", "taken over", "vehicle hears 76"}));
  p.say_as_it_is(arm_or(mavlink::mav_cmd::component_arm_disarm, 1));
  p.world.advance(2s);
  EXPECT_EQ(executor.story.back(), "asked about Arm");
}

TEST(ground_port_actor, a_word_is_asked_of_the_executor_and_answered_as_it_says) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  p.say(go_to_command());
  p.world.advance(100ms);
  ASSERT_EQ(executor.words.size(), 1U);
  EXPECT_EQ(executor.words[0].kind, operators::command_kind::go_to);
  EXPECT_EQ(executor.words[0].by, "station 255/190");
  EXPECT_EQ(executor.words[0].place, (mission::position{50, 36.4, 30}));
  ASSERT_EQ(p.line->results.size(), 1U);
  EXPECT_EQ(p.line->results[0].command, 192);
  EXPECT_EQ(p.line->results[0].result, 0);
  executor.objection = "the flight is not paused";
  p.say(test::command(mavlink::mav_cmd::do_pause_continue, 1));
  p.world.advance(100ms);
  EXPECT_EQ(executor.words.back().kind, operators::command_kind::resume);
  EXPECT_EQ(p.line->results.back().result, static_cast<int>(mavlink::mav_result::temporarily_rejected));
  EXPECT_TRUE(p.line->texts.contains("Continue: the flight is not paused"));
}

TEST(ground_port_actor, a_word_that_the_executor_does_not_answer_is_rejected_for_now_when_its_patience_ends) {
  runtime::simulated_disk disk;
  executor_record executor;
  executor.hears_words = false;
  process p(disk, executor);
  p.say(test::command(mavlink::mav_cmd::do_pause_continue, 0));
  p.world.advance(command_patience - 100ms);
  EXPECT_TRUE(p.line->results.empty());
  p.world.advance(200ms);
  ASSERT_EQ(p.line->results.size(), 1U);
  EXPECT_EQ(p.line->results[0].result, static_cast<int>(mavlink::mav_result::temporarily_rejected));
  EXPECT_TRUE(p.line->texts.contains("Pause: the executor does not answer"));
  EXPECT_EQ(executor.words.size(), 1U);
}

TEST(ground_port_actor, without_an_executor_a_word_is_rejected_for_now) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor, false);
  p.say(test::command(mavlink::mav_cmd::do_pause_continue, 0));
  p.world.advance(100ms);
  ASSERT_EQ(p.line->results.size(), 1U);
  EXPECT_EQ(p.line->results[0].result, static_cast<int>(mavlink::mav_result::temporarily_rejected));
  EXPECT_TRUE(executor.words.empty());
}

TEST(ground_port_actor, a_word_whose_acknowledgement_was_lost_is_not_asked_again_when_it_is_repeated) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  for (int i = 0; i < 4; ++i) {
    p.say(go_to_command());
    p.world.advance(500ms);
  }
  EXPECT_EQ(executor.words.size(), 1U);
  ASSERT_EQ(p.line->results.size(), 4U);
  for (const auto& each : p.line->results)
    EXPECT_EQ(each.result, 0);
}

TEST(ground_port_actor, a_word_reaches_the_executor_whatever_crashes_when_the_station_repeats_it) {
  for (const auto point : points)
    for (const auto* const who : {"ground_port", "executor"}) {
      runtime::simulated_disk disk;
      executor_record executor;
      process p(disk, executor);
      p.say(test::command(mavlink::mav_cmd::do_pause_continue, 0));
      p.world.crash_at(who, point);
      for (int i = 0; i < 16 && (p.line->results.empty() || p.line->results.back().result != 0); ++i) {
        p.world.advance(500ms);
        p.say(test::command(mavlink::mav_cmd::do_pause_continue, 0));
      }
      EXPECT_FALSE(executor.words.empty()) << who << ' ' << static_cast<int>(point);
      ASSERT_FALSE(p.line->results.empty()) << who << ' ' << static_cast<int>(point);
      EXPECT_EQ(p.line->results.back().result, 0) << who << ' ' << static_cast<int>(point);
    }
}

// -- crashes --------------------------------------------------------------------------------------

TEST(ground_port_actor, a_station_that_was_told_accepted_finds_its_plan_whatever_crashes) {
  for (const auto point : points)
    for (int skipped = 0; skipped < 6; ++skipped) { // so many handlings go well before
      runtime::simulated_disk disk;
      executor_record executor;
      std::uint32_t id = 0;
      {
        process p(disk, executor);
        p.say(mavlink::mission_count{.count = 2});
        for (int i = 0; i < skipped; ++i)
          (void)p.world.step(1);
        p.world.crash_at("ground_port", point);
        id = p.upload(waypoints(2));
        EXPECT_NE(id, 0U) << static_cast<int>(point) << ' ' << skipped;
        EXPECT_EQ(p.shown().plans[0].plan_id, id) << static_cast<int>(point) << ' ' << skipped;
      } // killed
      process again(disk, executor);
      EXPECT_EQ(again.shown().plans[0].plan_id, id) << static_cast<int>(point) << ' ' << skipped;
      EXPECT_EQ(executor.plans.empty() ? 0 : executor.plans.back(), id) << static_cast<int>(point) << ' ' << skipped;
    }
}

TEST(ground_port_actor, a_process_killed_right_after_the_acknowledgement_still_has_the_plan) {
  runtime::simulated_disk disk;
  executor_record executor;
  std::uint32_t id = 0;
  {
    process p(disk, executor);
    p.say(mavlink::mission_count{.count = 1});
    p.world.run_until_idle();
    p.say(waypoints(1)[0]);
    while (p.line->acks.empty() && p.world.step(1)) {
    }
    ASSERT_EQ(p.line->acks.size(), 1U);
    id = p.line->acks[0].opaque_id;
  } // killed
  process again(disk, executor);
  EXPECT_EQ(again.shown().plans[0].plan_id, id);
  again.world.advance(100ms);
  // It has judged it before the acknowledgement. Told again, because its confirmation died with the process, it is
  // dropped by its id; this stand-in keeps no ids.
  ASSERT_FALSE(executor.plans.empty());
  EXPECT_TRUE(std::ranges::all_of(executor.plans, [&](std::uint32_t each) { return each == id; }));
}

TEST(ground_port_actor, a_crash_at_any_point_asks_the_executor_for_one_start_only) {
  for (const auto point : points)
    for (int skipped = 0; skipped < 6; ++skipped) {
      runtime::simulated_disk disk;
      executor_record executor;
      process p(disk, executor);
      (void)p.upload(waypoints(3));
      p.say(start_command());
      for (int i = 0; i < skipped; ++i)
        (void)p.world.step(1);
      p.world.crash_at("ground_port", point);
      p.world.advance(100ms);
      p.world.forget_planned_crashes();
      for (std::uint8_t confirmation = 1; confirmation < 6; ++confirmation) {
        p.say(start_command(0, 0, confirmation));
        p.world.advance(500ms);
      }
      EXPECT_EQ(executor.starts.size(), 1U) << static_cast<int>(point) << ' ' << skipped;
      ASSERT_FALSE(p.line->results.empty()) << static_cast<int>(point) << ' ' << skipped;
      EXPECT_EQ(p.line->results.back().result, 0) << static_cast<int>(point) << ' ' << skipped;
    }
}

TEST(ground_port_actor, a_process_killed_while_the_executor_works_asks_it_no_second_time) {
  runtime::simulated_disk disk;
  executor_record executor;
  executor.answers = false;
  {
    process p(disk, executor);
    (void)p.upload(waypoints(3));
    p.say(start_command());
    p.world.advance(100ms);
    ASSERT_EQ(executor.starts.size(), 1U);
  } // killed
  process again(disk, executor);
  EXPECT_EQ(again.start(), static_cast<int>(mavlink::mav_result::temporarily_rejected));
  EXPECT_EQ(executor.starts.size(), 1U);
}

TEST(ground_port_actor, bad_frames_crash_nothing_and_are_counted) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  for (std::size_t i = 0; i < 1'000; ++i) {
    const std::vector<std::byte> bytes(i % 300 + 1, std::byte{0xFD});
    if (p.line->incoming().put(io::link::only_peer, bytes, true))
      p.world.tell(p.port, wake{});
  }
  p.world.run_until_idle();
  EXPECT_EQ(p.world.counters("ground_port").crashes, 0U);
  EXPECT_NE(p.upload(waypoints(2)), 0U);
}

TEST(ground_port_actor, no_signing_time_is_used_twice_across_kills) {
  std::array<std::byte, mavlink::secret_key_size> bytes{};
  bytes.fill(std::byte{7});
  const signing_settings signing{.key = std::make_shared<mavlink::secret_key>(bytes),
                                 .link = mavlink::link_id{1},
                                 .unsigned_frames = mavlink::unsigned_policy::accept_all()};
  runtime::simulated_disk disk;
  executor_record executor;
  for (int life = 0; life < 3; ++life) {
    process p(disk, executor, true, signing);
    p.world.advance(3s);
    (void)p.world.kill("ground_port");
    p.world.advance(3s);
    EXPECT_TRUE(p.shown().signing_enabled);
    EXPECT_NE(p.world.health().worst(), runtime::health_colour::red);
  }
}

// -- any order of events --------------------------------------------------------------------------

RC_GTEST_PROP(ground_port_actor_property, whatever_happens_stations_are_told_the_truth,
              (const std::vector<std::pair<std::uint8_t, std::uint8_t>>& story)) {
  runtime::simulated_disk disk;
  executor_record executor;
  process p(disk, executor);
  std::uint32_t promised = 0; // the plan that a station was told last that it is held
  std::size_t meant = 0;      // starts that a station has meant
  for (const auto& [what, number] : story) {
    switch (what % 6) {
    case 0:
    case 1: {
      auto items = waypoints(1 + number % 3);
      items[0].x += number;
      if (const auto id = p.upload(items); id != 0) {
        promised = id;
        RC_ASSERT(p.shown().plans[0].plan_id == promised);
      }
      break;
    }
    case 2:
      p.world.advance(3s); // or it would be a repetition of the one before
      ++meant;
      (void)p.start();
      break;
    case 3:
      (void)p.world.kill("ground_port");
      p.world.advance(std::chrono::milliseconds(number));
      break;
    case 4:
      p.world.forget_planned_crashes();
      p.world.crash_at("ground_port", points.at(number % points.size()));
      break;
    default:
      p.world.advance(std::chrono::milliseconds(number * 20));
      break;
    }
  }
  p.world.forget_planned_crashes();
  p.world.advance(10s);
  RC_ASSERT(p.shown().plans[0].plan_id == promised);
  RC_ASSERT(executor.starts.size() <= meant);
  std::set<std::uint64_t> keys;
  for (const auto& each : executor.starts)
    RC_ASSERT(keys.insert(each.key).second);
  RC_ASSERT((executor.plans.empty() ? 0U : executor.plans.back()) == promised);
}

} // namespace ground_port_actor_test
