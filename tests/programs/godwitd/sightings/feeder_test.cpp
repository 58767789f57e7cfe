// The feeder of a flight, with a map store that is busy and a gate that is closed at first.
#include "programs/godwitd/sightings/feeder.hpp"

#include <semaphore>
#include <set>

#include <gtest/gtest.h>

#include "messages/mission_client/handle.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/programs/godwitd/scratch.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"

namespace feeder_test {

using namespace godwit;
using namespace std::chrono_literals;
using mapobjects_store::map_failure;

constexpr int lines = 300; // more than may be under way
const std::string this_mission = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

// Outside of the stand-in, where no crash reaches it.
struct store_log {
  std::set<std::string> seen;
  int asks = 0;
  int busy_every = 0; // 0: never
  int chosen = 0;
  mapobjects_store::observation_kind kind = mapobjects_store::observation_kind::found;
};

class store_stand_in final : public runtime::actor_base<sightings::store_handle> {
public:
  store_stand_in(runtime::spawn_context context, store_log* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    namespace ms = mapobjects_store;
    return {on<ms::sighting>([this](const ms::sighting& m) {
              ms::sighting_answer answer;
              if (log_->busy_every != 0 && ++log_->asks % log_->busy_every == 0)
                answer.failure = map_failure::busy;
              else
                answer.seen = ms::observed{
                    {m.id, m.mission_id, m.id, log_->kind, m.class_group, m.position, m.at_ns, m.confidence},
                    log_->kind == ms::observation_kind::found};
              if (answer.seen)
                log_->seen.insert(m.id);
              return answer;
            }),
            on<ms::choose_mission>([this](const ms::choose_mission&) {
              ++log_->chosen;
              return ms::map_answer{};
            })};
  }

private:
  store_log* log_;
};

struct scan_log {
  std::set<std::string> offered;
  int asks = 0;
  bool answers = true;
  scan_controller::candidate_answer answer;
};

class scan_stand_in final : public runtime::actor_base<scan_controller::candidate_handle> {
public:
  scan_stand_in(runtime::spawn_context context, scan_log* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    namespace sc = scan_controller;
    return {on_deferred<sc::candidate, sc::candidate_answer>([this](const sc::candidate& m, std::uint64_t request_id) {
      ++log_->asks;
      log_->offered.insert(m.id);
      if (log_->answers)
        answer_later(request_id, log_->answer);
    })};
  }

private:
  scan_log* log_;
};

struct picture_log {
  std::vector<mission_client::deliver_picture> asked;
  bool answers = true;
};

class client_stand_in final : public runtime::actor_base<mission_client::picture_handle> {
public:
  client_stand_in(runtime::spawn_context context, picture_log* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    using namespace mission_client;
    return {on_deferred<deliver_picture, picture_noted>([this](const deliver_picture& m, std::uint64_t request_id) {
      log_->asked.push_back(m);
      if (log_->answers)
        answer_later(request_id, picture_noted{});
    })};
  }

private:
  picture_log* log_;
};

struct process {
  explicit process(bool chooses) : world(disk, 1) {
    feed = daemon::sighting_feed::open(folder.write("seen", test::sighting_lines(lines)), this_mission).value();
    feed->start([this] { woken_up.release(); }, [](const std::string&) {});
    for (int word = 0; word < 2; ++word) // there is something; all is read
      EXPECT_TRUE(woken_up.try_acquire_for(20s));
    auto& actors = world.actors();
    const auto store = actors.add<store_stand_in>({.name = "store"}, {}, &log);
    const auto scan = actors.add<scan_stand_in>({.name = "scan"}, {}, &offers);
    const auto client = actors.add<client_stand_in>({.name = "client"}, {}, &delivered);
    who = actors.add<sightings::feeder>({.name = "sightings"}, {}, sightings::feeder_settings{this_mission, chooses},
                                        store, scan, client, feed, pictures, [](const std::string&) {});
    world.start();
    world.advance(2s);
  }
  void supervise(const runtime::child_entry& entry) {
    runtime::supervise table;
    table.epoch = {1, ++epoch};
    table.list = {entry};
    (void)world.ask(world.actors().guardian(), 1s, table);
    world.advance(1s);
  }
  sightings::feeder_handle who;
  std::uint64_t epoch = 0;
  test::scratch folder;
  store_log log;
  scan_log offers;
  picture_log delivered;
  runtime::simulated_disk disk;
  std::counting_semaphore<> woken_up{0};
  std::shared_ptr<daemon::sighting_feed> feed;
  std::shared_ptr<daemon::point_pictures> pictures = std::make_shared<daemon::point_pictures>(folder.file("pictures"));
  runtime::simulation world;
};

TEST(feeder, nothing_flows_before_the_gate_is_open_and_then_all_does) {
  process p(false);
  EXPECT_TRUE(p.log.seen.empty());
  p.feed->set_gate(true);
  p.world.advance(2s);
  EXPECT_EQ(p.log.seen.size(), static_cast<std::size_t>(lines));
  EXPECT_EQ(p.log.chosen, 0) << "mission_client tells the map which mission it is";
}

TEST(feeder, the_picture_of_a_sighting_becomes_that_of_its_point) {
  process p(false);
  p.offers.answer = {scan_controller::candidate_fate::opened, 5};
  p.pictures->add("of the camera", {7, 100, 48, 48, {std::byte{0xFF}}});
  p.feed->set_gate(true);
  mapobjects_store::sighting seen;
  seen.id = "of the camera";
  seen.mission_id = this_mission;
  p.world.tell(p.who, seen);
  p.world.advance(2s);
  EXPECT_TRUE(p.pictures->of(5));
}

TEST(feeder, pictures_are_handed_over_on_the_ground_one_by_one_until_each_is_noted) {
  process p(false);
  p.feed->set_gate(true);
  p.world.advance(1s);
  for (const std::string each : {"a", "b"}) {
    p.pictures->add(each, {7, 100, 48, 48, {std::byte{0xFF}}});
    p.pictures->belongs(each, {each == "a" ? 1U : 2U, this_mission, each == "a" ? 100 : 200});
  }
  p.world.advance(5s);
  EXPECT_TRUE(p.delivered.asked.empty()) << "it flies";
  p.delivered.answers = false;
  p.feed->set_gate(false);
  p.world.advance(sightings::feeder::answer_timeout + 2s);
  ASSERT_EQ(p.delivered.asked.size(), 2U) << "asked again for want of an answer, and only this one";
  EXPECT_EQ(p.delivered.asked[1].observation_id, "a");
  p.delivered.answers = true;
  p.world.advance(sightings::feeder::answer_timeout + 2s);
  ASSERT_EQ(p.delivered.asked.size(), 4U);
  EXPECT_EQ(p.delivered.asked[3].observation_id, "b");
  EXPECT_EQ(p.delivered.asked[3].mission_id, this_mission);
  EXPECT_FALSE(p.pictures->next());
}

TEST(feeder, what_the_camera_sees_flows_with_the_rest_and_what_finds_no_room_is_counted) {
  process p(false);
  p.feed->set_gate(true);
  p.world.advance(2s);
  const auto seen = [](int number) {
    mapobjects_store::sighting result;
    result.id = "of the camera " + std::to_string(number);
    result.mission_id = this_mission;
    return result;
  };
  p.world.tell(p.who, seen(0)); // the file is at its end
  p.world.advance(2s);
  EXPECT_TRUE(p.log.seen.contains("of the camera 0"));
  EXPECT_EQ(p.feed->counts().refused, 0U);
  p.feed->set_gate(false);
  constexpr int more = 10;
  for (int i = 1; i <= static_cast<int>(daemon::sighting_feed::max_waiting) + more; ++i)
    p.world.tell(p.who, seen(i));
  p.world.advance(2s);
  EXPECT_EQ(p.feed->counts().refused, static_cast<std::uint64_t>(more));
}

TEST(feeder, a_store_that_is_busy_is_asked_again) {
  process p(false);
  p.log.busy_every = 7;
  p.feed->set_gate(true);
  p.world.advance(60s);
  EXPECT_EQ(p.log.seen.size(), static_cast<std::size_t>(lines));
  EXPECT_EQ(p.feed->counts().recorded, static_cast<std::uint64_t>(lines));
}

TEST(feeder, what_the_map_makes_a_finding_of_is_offered_to_who_looks_for_points_of_interest) {
  process p(false);
  p.feed->set_gate(true);
  p.world.advance(2s);
  EXPECT_EQ(p.offers.offered, p.log.seen);
  EXPECT_EQ(p.offers.asks, lines);
}

TEST(feeder, what_is_ignored_is_not_offered) {
  process p(false);
  p.log.kind = mapobjects_store::observation_kind::ignored;
  p.feed->set_gate(true);
  p.world.advance(2s);
  EXPECT_EQ(p.offers.asks, 0);
}

TEST(feeder, who_does_not_answer_is_asked_three_times_and_holds_up_no_sighting_for_ever) {
  process p(false);
  p.offers.answers = false;
  p.feed->set_gate(true);
  p.world.advance(60s);
  EXPECT_EQ(p.log.seen.size(), static_cast<std::size_t>(lines));
  EXPECT_EQ(p.offers.asks, 3 * lines);
  EXPECT_EQ(p.feed->counts().recorded, static_cast<std::uint64_t>(lines));
  EXPECT_EQ(p.feed->counts().not_offered, static_cast<std::uint64_t>(lines));
}

TEST(feeder, what_was_found_while_nobody_ran_is_offered_when_somebody_does) {
  process p(false);
  runtime::child_entry away{"scan", false, {}};
  p.supervise(away);
  p.feed->set_gate(true);
  p.world.advance(2s);
  EXPECT_EQ(p.offers.asks, 0);
  EXPECT_EQ(p.feed->counts().recorded, static_cast<std::uint64_t>(lines)) << "the map has it";
  away.wanted = true;
  p.supervise(away);
  p.world.advance(2s);
  EXPECT_EQ(p.offers.offered.size(), sightings::feeder::max_untaken) << "the oldest were given up";
}

TEST(feeder, who_does_not_run_holds_up_nothing) {
  process p(false);
  for (int crashes = 0; crashes < 7; ++crashes) {
    (void)p.world.kill("scan");
    p.world.advance(10s);
  }
  p.feed->set_gate(true);
  p.world.advance(2s);
  EXPECT_EQ(p.feed->counts().recorded, static_cast<std::uint64_t>(lines));
  EXPECT_EQ(p.offers.asks, 0);
}

TEST(feeder, without_a_service_it_tells_the_map_which_mission_it_is) {
  process p(true);
  EXPECT_EQ(p.log.chosen, 1);
  p.feed->set_gate(true);
  p.world.advance(2s);
  EXPECT_EQ(p.log.seen.size(), static_cast<std::size_t>(lines));
}

} // namespace feeder_test
