#include "actors/telemetry_stream/actor.hpp"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "runtime/simulation/simulation.hpp"

namespace telemetry_stream_actor_test {

using namespace godwit;
using namespace godwit::telemetry_stream;
using namespace std::chrono_literals;
using nlohmann::json;

using map_handle = runtime::mailbox<runtime::asks<mapobjects_store::get_map, mapobjects_store::map_status>>;

class map_stand_in final : public runtime::actor_base<map_handle> {
public:
  map_stand_in(runtime::spawn_context context, int* asked) : actor_base(std::move(context)), asked_(asked) {}

protected:
  behavior_type handlers() override {
    return {on<mapobjects_store::get_map>([this](const mapobjects_store::get_map&) {
      ++*asked_;
      return mapobjects_store::map_status{};
    })};
  }

private:
  int* asked_;
};

class scan_stand_in final : public runtime::actor_base<
                                runtime::mailbox<runtime::asks<scan_controller::get_points, scan_controller::points>>> {
public:
  scan_stand_in(runtime::spawn_context context, scan_controller::points* seen)
      : actor_base(std::move(context)), seen_(seen) {}

protected:
  behavior_type handlers() override {
    return {on<scan_controller::get_points>([this](const scan_controller::get_points&) { return *seen_; })};
  }

private:
  scan_controller::points* seen_;
};

struct process {
  process() : world(disk, 1) {
    const auto others = std::make_shared<peers>();
    others->map = world.actors().add<map_stand_in>({.name = "map"}, {}, &asked);
    others->pictured = [this] { return pictured; };
    others->points = world.actors().add<scan_stand_in>({.name = "scan_controller"}, {}, &seen);
    who = world.actors().add<actor>({.name = "telemetry_stream", .policy = runtime::on_crash::lose}, {},
                                    std::shared_ptr<const peers>(others), all);
    world.start();
    world.run_until_idle();
  }
  std::vector<std::string> topics_of(subscriber& of) const {
    std::vector<std::string> result;
    while (const auto text = of.take())
      result.push_back(json::parse(*text).at("topic"));
    return result;
  }
  std::vector<json> texts_of(subscriber& of, std::string_view topic) const {
    std::vector<json> result;
    while (const auto text = of.take())
      if (auto said = json::parse(*text); said.at("topic") == topic)
        result.push_back(std::move(said.at("data")));
    return result;
  }
  int asked = 0;
  scan_controller::points seen;
  std::vector<std::uint64_t> pictured; // points that the camera has shown
  std::shared_ptr<hub> all = std::make_shared<hub>(1);
  runtime::simulated_disk disk;
  runtime::simulation world;
  own_handle who;
};

TEST(telemetry_stream, what_an_actor_says_is_with_the_subscribers_before_anything_else_happens) {
  process p;
  const auto place = p.all->subscribe({{topic::flight, 0}, {topic::authority, 0}}, [] {}).value();
  (void)p.topics_of(*place);
  p.world.tell(p.who, executor::flight_status{});
  p.world.run_until_idle();
  auto heard = p.topics_of(*place);
  std::erase(heard, "clock"); // which everybody hears
  EXPECT_EQ(heard, (std::vector<std::string>{"flight", "authority"}));
}

TEST(telemetry_stream, it_beats_each_second) {
  process p;
  const auto place = p.all->subscribe({{topic::clock, 0}}, [] {}).value();
  p.world.advance(1500ms);
  (void)p.topics_of(*place);
  p.world.advance(5s);
  const auto heard = p.topics_of(*place);
  EXPECT_EQ(std::ranges::count(heard, "clock"), 5);
}

TEST(telemetry_stream, the_map_is_asked_only_while_somebody_listens) {
  process p;
  p.world.advance(10s);
  EXPECT_EQ(p.asked, 0);
  const auto place = p.all->subscribe({{topic::map, 0}}, [] {}).value();
  p.world.advance(10s);
  EXPECT_EQ(p.asked, 5);
  const auto heard = p.topics_of(*place);
  EXPECT_EQ(std::ranges::count(heard, "map"), 1) << "it has not changed";
}

TEST(telemetry_stream, a_crash_loses_what_was_under_way_and_no_subscriber) {
  process p;
  const auto place = p.all->subscribe({{topic::flight, 0}}, [] {}).value();
  (void)p.topics_of(*place);
  p.world.crash_at("telemetry_stream", runtime::crash_point::after_handler);
  p.world.tell(p.who, executor::flight_status{});
  p.world.advance(1s);
  EXPECT_EQ(p.world.counters("telemetry_stream").crashes, 1U);
  EXPECT_EQ(p.world.counters("telemetry_stream").dead_lettered, 0U);
  p.world.tell(p.who, executor::flight_status{});
  p.world.run_until_idle();
  const auto heard = p.topics_of(*place);
  EXPECT_EQ(std::ranges::count(heard, "flight"), 1);
}

TEST(telemetry_stream, who_comes_hears_all_points_of_interest_and_then_each_change_at_once) {
  process p;
  p.seen.shown.emplace_back().number = 3;
  const auto place = p.all->subscribe({{topic::points, 0}}, [] {}).value();
  p.world.advance(2500ms);
  auto heard = p.texts_of(*place, "points");
  ASSERT_FALSE(heard.empty());
  EXPECT_EQ(heard.back().at("shown").at(0).at("number"), 3);
  p.seen.shown.emplace_back().number = 4;
  p.world.tell(p.who, scan_controller::point_shown{});
  p.world.run_until_idle();
  heard = p.texts_of(*place, "points");
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].at("shown").size(), 2U);
  p.seen.confirmed = std::exchange(p.seen.shown, {});
  p.world.tell(p.who, scan_controller::point_closed{});
  p.world.run_until_idle();
  heard = p.texts_of(*place, "points");
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].at("confirmed").size(), 2U);
  p.world.advance(10s);
  EXPECT_TRUE(p.texts_of(*place, "points").empty()) << "nothing has changed";
}

TEST(telemetry_stream, a_point_says_whether_it_has_a_picture_and_again_when_it_gets_one) {
  process p;
  p.seen.shown.emplace_back().number = 3;
  p.seen.shown.emplace_back().number = 4;
  p.pictured = {4};
  const auto place = p.all->subscribe({{topic::points, 0}}, [] {}).value();
  p.world.advance(2500ms);
  auto heard = p.texts_of(*place, "points");
  ASSERT_FALSE(heard.empty());
  EXPECT_EQ(heard.back().at("shown").at(0).at("has_picture"), false);
  EXPECT_EQ(heard.back().at("shown").at(1).at("has_picture"), true);
  p.pictured = {3, 4};
  p.world.advance(2s);
  heard = p.texts_of(*place, "points");
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].at("shown").at(0).at("has_picture"), true);
}

} // namespace telemetry_stream_actor_test
