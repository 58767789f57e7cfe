// mapobjects_store as an actor: what crashes and kills do to observations, batches and those who wait.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "actors/mapobjects_store/actor.hpp"
#include "programs/godwit-drill/flight_simulation/daemon_process.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace mapobjects_store_actor_test {

using namespace godwit::tests;
using drill::stepped_map;
using namespace std::chrono_literals;
using runtime::crash_point;

// It is not persistent: these are all the points that it passes.
constexpr std::array points{crash_point::before_handler, crash_point::after_handler};

runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 1ms, .backoff_max = 10ms};
  return result;
}

// A process with a map. Destroying it is SIGKILL: what was not committed is gone.
struct process {
  explicit process(const std::string& file) : map(std::make_shared<stepped_map>(file)), world(disk, 1) {
    store = world.actors().add<actor>({.name = "mapobjects_store"}, patient(), port);
    port->attach(std::shared_ptr<map_access>(map), [this] { world.tell(store, wake{}); });
    world.start();
    work();
  }

  // Until nothing is left to be done.
  void work() {
    do
      world.run_until_idle();
    while (map->step());
  }

  // As an asker does it: with the same id until it is answered.
  template <class Q>
  auto ask(const Q& question) {
    for (int attempt = 0; attempt < 10; ++attempt) {
      const auto asked = world.ask(store, 1s, question);
      work();
      world.advance(20ms); // the back-off of a restart
      work();
      if (asked->answers > 0)
        return asked->answer;
      ++unanswered;
    }
    ADD_FAILURE() << "no answer in ten attempts";
    return decltype(world.ask(store, 1s, question)->answer){};
  }

  runtime::simulated_disk disk; // it keeps nothing in the journal
  std::shared_ptr<map_port> port = std::make_shared<map_port>();
  std::shared_ptr<stepped_map> map;
  runtime::simulation world;
  own_handle store;
  int unanswered = 0;
};

class mapobjects_store_actor : public ::testing::Test {
protected:
  scratch_folder folder;
};

finish_load end_of(std::int64_t load, std::int64_t objects) {
  return {.load = load, .objects = objects, .ignored = 0, .at_ns = 5};
}

TEST_F(mapobjects_store_actor, a_mission_is_pulled_flown_and_delivered) {
  process p(folder.file());
  EXPECT_EQ(p.ask(choose_mission{mission_a}).failure, map_failure::none);
  const auto load = p.ask(begin_load{mission_a}).load;
  EXPECT_EQ(p.ask(load_page{load, 0, {object(1, place(0))}, {}}).failure, map_failure::none);
  EXPECT_EQ(p.ask(end_of(load, 1)).load, load);
  EXPECT_EQ(p.ask(get_map{}).sync, sync_state::synced);

  const auto moved = p.ask(seen(10, place(20)));
  ASSERT_TRUE(moved.seen);
  EXPECT_EQ(moved.seen->what.kind, observation_kind::moved);
  EXPECT_TRUE(moved.seen->shown);
  EXPECT_EQ(p.ask(verdict_on(50, place(20))).ignored->id, uuid(50));
  const auto review = p.ask(pass_end{uuid(60), mission_a, 0, 9, {"vehicle"}, {{place(0), 100}}, {}, 1});
  ASSERT_TRUE(review.reviewed);
  EXPECT_EQ(review.reviewed->in_view, 1U);

  const auto objects = p.ask(get_objects{});
  EXPECT_EQ(objects.failure, map_failure::none);
  ASSERT_EQ(objects.list.size(), 1U) << "where it was moved to";
  EXPECT_TRUE(objects.list[0].is_seen_here);

  const auto status = p.ask(get_map{});
  EXPECT_EQ(status.objects, 1U);
  EXPECT_EQ(status.seen_here, 1U);
  EXPECT_EQ(status.pending, 2U);
  for (const auto to : {destination::observations, destination::ignored_items}) {
    const auto taken = p.ask(take_batch{uuid(900), mission_a, to, 500});
    EXPECT_EQ(ids_of(taken).size(), to == destination::observations ? 1U : 0U) << "a key is of one destination";
  }
  EXPECT_EQ(ids_of(p.ask(take_batch{uuid(901), mission_a, destination::ignored_items, 500})), std::vector{uuid(50)});
  EXPECT_EQ(p.ask(get_batches{}).batches.size(), 2U);
  EXPECT_EQ(p.ask(batch_delivered{uuid(900)}).failure, map_failure::none);
  EXPECT_EQ(p.ask(batch_delivered{uuid(901)}).failure, map_failure::none);
  EXPECT_TRUE(p.ask(get_owed{}).missions.empty());
  EXPECT_EQ(p.ask(take_batch{uuid(900), mission_a, destination::observations, 500}).failure, map_failure::delivered);
}

TEST_F(mapobjects_store_actor, a_deleted_mission_becomes_orphans_that_can_be_queued_again) {
  process p(folder.file());
  p.ask(seen(10, place(0)));
  EXPECT_EQ(p.ask(delete_mission{mission_a, 9, "the service has deleted it"}).rows, 1U);
  EXPECT_EQ(p.ask(get_owed{}).missions.at(0).orphaned, 1U);
  EXPECT_EQ(p.ask(requeue_mission{mission_a}).rows, 1U);
  EXPECT_EQ(p.ask(orphan_mission{mission_a, 9, "404"}).rows, 1U);
}

TEST_F(mapobjects_store_actor, an_answer_is_given_when_it_is_on_the_disk_and_not_before) {
  process p(folder.file());
  const auto asked = p.world.ask(p.store, 10s, seen(10, place(0)));
  p.world.advance(100ms);
  EXPECT_EQ(asked->answers, 0);
  p.work();
  EXPECT_EQ(asked->answers, 1);
}

TEST_F(mapobjects_store_actor, what_makes_no_sense_is_refused_with_a_reason_and_crashes_nothing) {
  process p(folder.file());
  const auto refused = p.ask(sighting{});
  EXPECT_FALSE(refused.seen);
  EXPECT_EQ(refused.failure, map_failure::refused);
  EXPECT_NE(refused.error.find("UUID"), std::string::npos);
  EXPECT_EQ(p.ask(load_page{77, 0, {}, {}}).failure, map_failure::load_given_up);
  EXPECT_EQ(p.ask(load_page{77, 0, {}, {}}).load, 77);
  EXPECT_EQ(p.ask(acknowledge_fallback{mission_a}).failure, map_failure::refused);
  EXPECT_EQ(p.world.counters("mapobjects_store").crashes, 0U);
}

TEST_F(mapobjects_store_actor, without_a_map_each_ask_is_answered_with_why_and_health_is_red) {
  process p(folder.file());
  p.port->attach(tl::unexpected(map_error{map_errc::corrupt, "map.db is damaged", "Move it away"}), {});
  const auto answer = p.ask(seen(10, place(0)));
  EXPECT_EQ(answer.failure, map_failure::broken);
  EXPECT_NE(answer.error.find("Move it away"), std::string::npos);
  p.world.advance(actor::look_period);
  EXPECT_EQ(p.world.health().worst(), runtime::health_colour::red);
}

TEST_F(mapobjects_store_actor, health_tells_of_a_failing_disk_an_old_map_and_what_is_owed) {
  process p(folder.file());
  EXPECT_EQ(p.world.health().worst(), runtime::health_colour::green);
  p.map->fail("the disk is full");
  p.world.advance(actor::look_period);
  EXPECT_EQ(p.world.health().worst(), runtime::health_colour::red);
  p.map->fail("");
  p.ask(choose_mission{mission_a});
  p.ask(seen(10, place(0)));
  p.ask(pull_failed{mission_a});
  p.world.advance(actor::look_period);
  p.work();
  EXPECT_EQ(p.world.health().worst(), runtime::health_colour::yellow);
  EXPECT_EQ(p.world.health().entries().at(0).reason, "map: failed; 1 rows to deliver");
}

TEST_F(mapobjects_store_actor, more_asks_than_its_bound_are_told_to_come_later) {
  process p(folder.file());
  std::vector<std::shared_ptr<runtime::asked<map_status>>> asked;
  for (std::size_t i = 0; i < response_queue::max_asks + 10; ++i)
    asked.push_back(p.world.ask(p.store, 100s, get_map{}));
  p.world.run_until_idle();
  int turned_away = 0; // by the actor's runtime, whose bound is the same, or by the port
  for (const auto& each : asked)
    turned_away += each->failures > 0 || (each->answers > 0 && each->answer.failure == map_failure::busy) ? 1 : 0;
  EXPECT_GE(turned_away, 10);
  p.work();
  EXPECT_EQ(asked.front()->answers, 1);
  EXPECT_EQ(p.ask(get_map{}).failure, map_failure::none);
}

// -- crashes --------------------------------------------------------------------------------------

TEST_F(mapobjects_store_actor, whatever_crashes_a_sighting_counts_once_and_is_answered_in_the_end) {
  for (const auto point : points)
    for (int skipped = 0; skipped < 5; ++skipped) { // so many handlings go well before
      scratch_folder other;
      process p(other.file());
      const auto asked = p.world.ask(p.store, 1s, seen(10, place(0)));
      for (int i = 0; i < skipped; ++i)
        if (!p.world.step(1))
          static_cast<void>(p.map->step());
      p.world.crash_at("mapobjects_store", point);
      p.work();
      p.world.advance(20ms);
      p.work();
      p.world.forget_planned_crashes();
      EXPECT_EQ(asked->answers + asked->failures, 1) << static_cast<int>(point) << ' ' << skipped;
      const auto answer = p.ask(seen(10, place(0)));
      ASSERT_TRUE(answer.seen) << static_cast<int>(point) << ' ' << skipped;
      EXPECT_EQ(answer.seen->what.kind, observation_kind::found) << "the second time it is the same observation";
      EXPECT_EQ(p.ask(get_map{}).pending, 1U) << static_cast<int>(point) << ' ' << skipped;
    }
}

TEST_F(mapobjects_store_actor, whatever_crashes_a_batch_has_the_same_rows) {
  for (const auto point : points)
    for (int skipped = 0; skipped < 5; ++skipped) {
      scratch_folder other;
      process p(other.file());
      for (std::uint64_t i = 0; i < 4; ++i)
        p.ask(seen(10 + i, place(100.0 * static_cast<double>(i))));
      const take_batch question{uuid(900), mission_a, destination::observations, 2};
      const auto asked = p.world.ask(p.store, 1s, question);
      for (int i = 0; i < skipped; ++i)
        if (!p.world.step(1))
          static_cast<void>(p.map->step());
      p.world.crash_at("mapobjects_store", point);
      p.work();
      p.world.advance(20ms);
      p.work();
      p.world.forget_planned_crashes();
      EXPECT_EQ(ids_of(p.ask(question)), (std::vector{uuid(10), uuid(11)}));
      EXPECT_EQ(p.ask(get_batches{}).batches.size(), 1U);
      EXPECT_EQ(p.ask(get_map{}).taken, 2U);
    }
}

TEST_F(mapobjects_store_actor, a_page_whose_outcome_is_unknown_is_sent_again_and_counts_once) {
  for (const auto point : points) {
    scratch_folder other;
    process p(other.file());
    const auto load = p.ask(begin_load{mission_a}).load;
    p.world.crash_at("mapobjects_store", point);
    EXPECT_EQ(p.ask(load_page{load, 0, {object(1, place(0))}, {}}).failure, map_failure::none);
    p.world.crash_at("mapobjects_store", point);
    EXPECT_EQ(p.ask(load_page{load, 1, {object(2, place(100))}, {}}).failure, map_failure::none);
    p.world.crash_at("mapobjects_store", point);
    EXPECT_EQ(p.ask(end_of(load, 2)).failure, map_failure::none);
    EXPECT_EQ(p.ask(get_map{}).objects, 2U);
  }
}

TEST_F(mapobjects_store_actor, an_incarnation_that_is_gone_leaves_its_answers_to_nobody) {
  process p(folder.file());
  const auto asked = p.world.ask(p.store, 1s, seen(10, place(0)));
  p.world.run_until_idle();
  ASSERT_TRUE(p.world.kill("mapobjects_store"));
  p.work();
  p.world.advance(20ms);
  p.work();
  EXPECT_EQ(asked->failure.code, runtime::ask_errc::outcome_unknown);
  EXPECT_FALSE(p.port->take().has_value());
  EXPECT_EQ(p.ask(get_map{}).pending, 1U);
}

TEST_F(mapobjects_store_actor, a_process_killed_after_an_answer_has_what_was_answered) {
  {
    process p(folder.file());
    p.ask(choose_mission{mission_a});
    ASSERT_TRUE(p.ask(seen(10, place(0))).seen);
    p.ask(take_batch{uuid(900), mission_a, destination::observations, 2});
    static_cast<void>(p.world.ask(p.store, 1s, seen(11, place(100)))); // not answered, and not happened
    p.world.run_until_idle();
  } // killed
  process again(folder.file());
  EXPECT_EQ(again.ask(get_batches{}).batches.at(0).key, uuid(900));
  EXPECT_EQ(again.ask(get_map{}).pending, 0U);
  EXPECT_EQ(again.ask(get_map{}).mission_id, mission_a);
  EXPECT_EQ(ids_of(again.ask(take_batch{uuid(900), mission_a, destination::observations, 2})), std::vector{uuid(10)});
}

// -- any order of events --------------------------------------------------------------------------

// A recogniser, a deliverer and a service, each of which asks until it is answered.
RC_GTEST_PROP(mapobjects_store_actor_property, whatever_crashes_each_sighting_reaches_the_service_once,
              (const std::vector<std::pair<std::uint8_t, std::uint8_t>>& story)) {
  scratch_folder folder;
  auto p = std::make_unique<process>(folder.file());
  std::set<std::string> answered;
  std::map<std::string, std::vector<std::string>> service; // by key
  std::uint64_t keys = 900;
  const auto deliver_some = [&](std::uint32_t limit) {
    std::vector<std::string> open;
    for (const auto& each : p->ask(get_batches{}).batches)
      open.push_back(each.key);
    open.push_back(uuid(++keys));
    for (const auto& key : open) {
      const auto rows = ids_of(p->ask(take_batch{key, mission_a, destination::observations, limit}));
      if (!rows.empty())
        RC_ASSERT(service.emplace(key, rows).first->second == rows);
      if (limit % 2 == 0)
        p->ask(batch_delivered{key});
    }
  };
  for (const auto& [what, number] : story) {
    switch (what % 5) {
    case 0:
    case 1: {
      const auto answer = p->ask(seen(number, place(50.0 * number)));
      RC_ASSERT(answer.seen.has_value());
      answered.insert(answer.seen->what.id);
      break;
    }
    case 2:
      deliver_some(number % 5);
      break;
    case 3:
      p->world.crash_at("mapobjects_store", points.at(number % points.size()));
      break;
    default:
      p.reset(); // killed
      p = std::make_unique<process>(folder.file());
      break;
    }
  }
  p->world.forget_planned_crashes();
  deliver_some(1000);
  deliver_some(1000);
  std::set<std::string> delivered;
  for (const auto& [key, rows] : service)
    for (const auto& id : rows)
      RC_ASSERT(delivered.insert(id).second);
  RC_ASSERT(delivered == answered);
}

} // namespace mapobjects_store_actor_test
} // namespace godwit::mapobjects_store
