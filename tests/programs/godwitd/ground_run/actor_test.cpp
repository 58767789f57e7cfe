// The run on the ground as an actor: with a map store that forgets, refuses and is busy, and crashes at every point.
#include <gtest/gtest.h>

#include <map>
#include <semaphore>

#include "programs/godwitd/ground_run/actor.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/programs/godwitd/scratch.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"

namespace actor_test {

using namespace godwit;
using namespace godwit::ground_run;
using namespace std::chrono_literals;
using mapobjects_store::map_failure;
using runtime::crash_point;

constexpr int sightings = 300; // more than may be under way
const std::string this_mission = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

// What the stand-ins saw and how they behave, outside of them, where no crash reaches it.
struct run_log {
  std::map<std::string, int> seen; // by id: how often it was asked
  int asks = 0;
  int busy_every = 0;   // of the asks; 0: never
  int silent_every = 0; // takes it, and does not answer
  std::string refused;  // this id
  int begins = 0;
  int pushes = 0;
  std::vector<mission_client::respond_to_assignment> responses;
  own_handle run;
};

using store_handle = mapobjects_store::handle;
using sighting = mapobjects_store::sighting;

class store_stand_in final : public runtime::actor_base<store_handle> {
public:
  store_stand_in(runtime::spawn_context context, run_log* seen) : actor_base(std::move(context)), log_(seen) {}

protected:
  behavior_type handlers() override {
    namespace ms = mapobjects_store;
    return {on_deferred<sighting, ms::sighting_answer>(
                [this](const sighting& m, std::uint64_t request) { take(m, request); }),
            on<ms::pass_end>([](const ms::pass_end&) { return ms::pass_answer{}; }),
            on<ms::operator_verdict>([](const ms::operator_verdict&) { return ms::verdict_answer{}; }),
            on<ms::acknowledge_fallback>([](const ms::acknowledge_fallback&) { return ms::map_answer{}; }),
            on<ms::choose_mission>([](const ms::choose_mission&) { return ms::map_answer{}; }),
            on<ms::begin_load>([](const ms::begin_load&) { return ms::load_answer{}; }),
            on<ms::load_page>([](const ms::load_page&) { return ms::load_answer{}; }),
            on<ms::finish_load>([](const ms::finish_load&) { return ms::load_answer{}; }),
            on<ms::pull_failed>([](const ms::pull_failed&) { return ms::map_answer{}; }),
            on<ms::take_batch>([](const ms::take_batch&) { return ms::batch{}; }),
            on<ms::get_batches>([](const ms::get_batches&) { return ms::open_batches{}; }),
            on<ms::return_batch>([](const ms::return_batch&) { return ms::map_answer{}; }),
            on<ms::batch_delivered>([](const ms::batch_delivered&) { return ms::map_answer{}; }),
            on<ms::delete_mission>([](const ms::delete_mission&) { return ms::moved_rows{}; }),
            on<ms::orphan_mission>([](const ms::orphan_mission&) { return ms::moved_rows{}; }),
            on<ms::requeue_mission>([](const ms::requeue_mission&) { return ms::moved_rows{}; }),
            on<ms::get_owed>([](const ms::get_owed&) { return ms::owed_list{}; }),
            on<ms::get_map>([](const ms::get_map&) { return ms::map_status{}; })};
  }

private:
  void take(const sighting& m, std::uint64_t request) {
    const auto number = ++log_->asks;
    mapobjects_store::sighting_answer answer;
    if (log_->busy_every != 0 && number % log_->busy_every == 0) {
      answer.failure = map_failure::busy;
    } else if (m.id == log_->refused) {
      answer.failure = map_failure::refused;
      answer.error = "lies in the sea";
    } else {
      ++log_->seen[m.id];
    }
    if (log_->silent_every == 0 || number % log_->silent_every != 0)
      answer_later(request, answer);
  }

  run_log* log_;
};

using client_handle = mission_client::flight_handle;

class client_stand_in final : public runtime::actor_base<client_handle> {
public:
  client_stand_in(runtime::spawn_context context, run_log* seen) : actor_base(std::move(context)), log_(seen) {}

protected:
  behavior_type handlers() override {
    namespace mc = mission_client;
    return {on<mc::begin_mission>([this](const mc::begin_mission&) { ++log_->begins; }),
            on<mc::begin_next>([](const mc::begin_next&) { FAIL() << "a ground run has its mission"; }),
            on<mc::pull_map>([](const mc::pull_map&) {}),
            on<mc::accept_copy>([](const mc::accept_copy&) {}),
            on<mc::push_map>([this](const mc::push_map& m) {
              ++log_->pushes;
              tell(log_->run, mc::mission_resolved{m.mission_id, 0, 0});
            }),
            on<mc::report_progress>([](const mc::report_progress&) {}),
            on<mc::respond_to_assignment>([this](const mc::respond_to_assignment& m) { log_->responses.push_back(m); }),
            on<mc::insert_waypoint>([](const mc::insert_waypoint&) {}),
            on<mc::replace_tail>([](const mc::replace_tail&) {}),
            on<mc::get_service>([](const mc::get_service&) {
              mc::service_status result;
              result.mission_id = this_mission;
              result.revision = 2;
              result.pull = mc::pull_state::synced;
              return result;
            })};
  }

private:
  run_log* log_;
};

class vehicle_stand_in final : public runtime::actor_base<ground_run::vehicle_handle> {
public:
  using actor_base::actor_base;

protected:
  behavior_type handlers() override {
    return {on<vehicle_link::get_connection>([](const vehicle_link::get_connection&) {
      vehicle_link::connection result;
      result.reason = "no such device";
      return result;
    })};
  }
};

runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 1ms, .backoff_max = 10ms};
  return result;
}

struct process {
  // RUNS: goes as far as it gets without time passing, which is the whole course.
  explicit process(run_log& seen, bool runs = true) : all(seen), world(disk, 1) {
    feed = daemon::sighting_feed::open(folder.write("seen", test::sighting_lines(sightings)), this_mission).value();
    feed->start([this] { woken_up.release(); }, [](const std::string&) {});
    for (int word = 0; word < 2; ++word) // there is something; all is read
      EXPECT_TRUE(woken_up.try_acquire_for(20s));
    auto& actors = world.actors();
    const auto others = std::make_shared<peers>();
    others->store = actors.add<store_stand_in>({.name = "store"}, patient(), &all);
    others->vehicle = actors.add<vehicle_stand_in>({.name = "vehicle"}, patient());
    others->client = actors.add<client_stand_in>({.name = "client"}, patient(), &all);
    run = actors.add<actor>({.name = "ground_run"}, patient(), settings{this_mission, true, true, true},
                            std::shared_ptr<const peers>(others), feed,
                            run_world{[this](const announce& what) { said += what.sentence + "\n"; },
                                      [this](const finish& how) { ends.push_back(how); }});
    all.run = run;
    world.start();
    if (runs)
      world.run_until_idle();
  }
  bool ends_in(std::chrono::seconds virtual_time) {
    for (std::int64_t ms = 0; ms < virtual_time / 1ms && ends.empty(); ms += 100) {
      world.tell(run, woken{});
      world.advance(100ms);
    }
    return !ends.empty();
  }
  test::scratch folder;
  run_log& all;
  runtime::simulated_disk disk;
  std::string said;
  std::vector<finish> ends;
  std::counting_semaphore<> woken_up{0};
  std::shared_ptr<daemon::sighting_feed> feed;
  runtime::simulation world;
  own_handle run;
};

void expect_all_seen(const run_log& all) {
  EXPECT_EQ(all.seen.size(), static_cast<std::size_t>(sightings));
  EXPECT_GE(all.begins, 1);
  EXPECT_GE(all.pushes, 1);
}

TEST(ground_run_actor, every_sighting_is_recorded_and_then_the_map_is_pushed) {
  run_log all;
  process p(all);
  ASSERT_TRUE(p.ends_in(100s));
  EXPECT_TRUE(p.ends.front().well) << p.ends.front().why;
  expect_all_seen(all);
  EXPECT_NE(p.said.find("300 sightings recorded"), std::string::npos) << p.said;
}

TEST(ground_run_actor, a_store_that_is_busy_or_silent_is_asked_again_with_the_same_id) {
  run_log all;
  all.busy_every = 7;
  all.silent_every = 50;
  process p(all);
  ASSERT_TRUE(p.ends_in(1'000s));
  EXPECT_TRUE(p.ends.front().well) << p.ends.front().why;
  expect_all_seen(all);
}

TEST(ground_run_actor, a_sighting_that_the_store_refuses_is_said_and_is_no_good_end) {
  run_log all;
  all.refused = test::sighting_id(17);
  process p(all);
  ASSERT_TRUE(p.ends_in(100s));
  EXPECT_FALSE(p.ends.front().well);
  EXPECT_NE(p.said.find("lies in the sea"), std::string::npos);
  EXPECT_EQ(all.seen.size(), static_cast<std::size_t>(sightings) - 1);
}

TEST(ground_run_actor, a_crash_at_any_point_loses_no_sighting) {
  std::uint64_t crashes = 0; // a run may have ended before
  for (const auto point : {crash_point::before_handler, crash_point::after_handler}) {
    for (int step = 0; step < 40; ++step) {
      run_log all;
      process p(all, false);
      p.world.tell(p.run, woken{});
      for (int each = 0; each < step * 7; ++each)
        p.world.step(static_cast<std::uint64_t>(each));
      p.world.crash_at("ground_run", point);
      ASSERT_TRUE(p.ends_in(1'000s)) << step;
      crashes += p.world.counters("ground_run").crashes;
      EXPECT_TRUE(p.ends.front().well) << p.ends.front().why;
      expect_all_seen(all);
    }
  }
  EXPECT_GT(crashes, 10U);
}

TEST(ground_run_actor, a_vehicle_that_never_came_is_said_once) {
  run_log all;
  all.silent_every = 50;
  process p(all);
  ASSERT_TRUE(p.ends_in(1'000s));
  const auto first = p.said.find("vehicle down: no such device");
  ASSERT_NE(first, std::string::npos) << p.said;
  EXPECT_EQ(p.said.find("vehicle down", first + 1), std::string::npos) << p.said;
}

TEST(ground_run_actor, an_assignment_is_turned_down_with_the_same_key_each_time) {
  run_log all;
  process p(all);
  mission_client::assignment_arrived wanted;
  wanted.mission_id = this_mission;
  wanted.assignment.assignment_id = "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11";
  for (int time = 0; time < 2; ++time) {
    p.world.tell(p.run, wanted);
    p.world.run_until_idle();
  }
  ASSERT_EQ(all.responses.size(), 2U);
  EXPECT_EQ(all.responses[0].response.outcome, mission::assignment_outcome::rejected);
  EXPECT_EQ(all.responses[0].response.idempotency_key, all.responses[1].response.idempotency_key);
}

} // namespace actor_test
