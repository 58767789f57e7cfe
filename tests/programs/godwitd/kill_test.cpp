// SIGKILL of godwitd right before and right after every commit of its journal and of its map, one run after the other:
// whatever commit it is, the next run goes on, and the service has every row once.
//
// The places are enumerated and not drawn: the first run dies at the first commit, the next one at the second, until a
// run ends by itself. Each has a mission of its own, so that some can run side by side. TEST_FULL=1 makes it the size
// of a flight.
#include <gtest/gtest.h>

#include "tests/programs/godwitd/daemon_world.hpp"
#include "tests/programs/godwitd/process.hpp"
#include "tests/support/run_options.hpp"

namespace kill_test {

using namespace godwit;
using namespace godwit::test;
using sim::missions::row_kind;

const std::string killable = GODWITD_KILLABLE;

struct kill_run : testing::TestWithParam<const char*> {
  const bool is_full = tests::is_full_run();
  const int rows = is_full ? 500 : 100;
  const int batch = is_full ? 50 : 10;
  static constexpr int at_once = 8; // runs side by side: they mostly wait for the disk
  daemon_world world;
  std::vector<std::string> common;

  void SetUp() override {
    const auto config = world.folder.write("config.json", R"({"delivery": {"page_rows": 20, "batch_rows": )" +
                                                              std::to_string(batch) + "}}");
    common = {"--config", config, "--sightings", world.folder.write("seen", sighting_lines(rows)), "--once"};
  }

  // A mission of its own for each commit, with a map to pull.
  std::vector<std::string> words(int number) {
    EXPECT_TRUE(world.service->add_mission(small_mission(number)));
    EXPECT_TRUE(world.service->set_map_objects(mission_id(number), objects_on_map()));
    return world.words(std::to_string(number), number) + common;
  }

  // Where none of the sightings is.
  static std::vector<mission::map_object> objects_on_map() {
    std::vector<mission::map_object> result(50);
    for (int number = 0; number < 50; ++number) {
      auto& each = result[static_cast<std::size_t>(number)];
      each.object_id = sighting_id(900'000 + number);
      each.class_group = "vehicle";
      each.latitude = 46.0 + number * 0.001;
      each.longitude = 7.0;
      each.confidence = 0.5;
      each.first_seen = each.last_seen = "2026-05-01T08:00:00Z";
    }
    return result;
  }

  void expect_each_row_once(int number) {
    const auto stored = world.service->rows(mission_id(number), row_kind::observation);
    EXPECT_EQ(stored.size(), static_cast<std::size_t>(rows)) << "commit " << number;
    for (const auto& each : stored)
      EXPECT_EQ(each.deliveries, 1U) << "commit " << number << ", row " << each.id;
  }

  // An insert that nobody could deliver within two seconds has failed, and whoever asked has to decide anew: it may be
  // absent. It is never there twice, and nothing else has changed the mission.
  int inserts(int number) {
    const auto mission = world.service->current_mission(mission_id(number));
    const auto changes = world.service->rows(mission_id(number), row_kind::change).size();
    EXPECT_LE(changes, 1U) << "commit " << number;
    EXPECT_EQ(mission->items.size(), 3 + changes) << "commit " << number;
    EXPECT_EQ(mission->revision, 1 + static_cast<int>(changes)) << "commit " << number;
    return static_cast<int>(changes);
  }
};

// One place of death: a run that dies there, and one that goes on.
struct life {
  int number;
  std::vector<std::string> words;
  std::unique_ptr<program> running;
};

TEST_P(kill_run, a_daemon_that_is_killed_at_any_commit_delivers_every_row_once) {
  int inserted = 0;
  int last = 0; // the first place that no run reached
  for (int first = 1; last == 0; first += at_once) {
    std::vector<life> lives;
    for (int number = first; number < first + at_once; ++number)
      lives.push_back({number, words(number), nullptr});
    for (auto& each : lives)
      each.running = std::make_unique<program>(
          killable, std::vector<std::string>{GetParam(), std::to_string(each.number)} + each.words);
    for (auto& each : lives) {
      const int code = each.running->ends();
      EXPECT_TRUE(code == -1 || code == 0) << "commit " << each.number << "\n" << each.running->said();
      if (code != -1 && last == 0)
        last = each.number;
      each.running = std::make_unique<program>(killable, std::vector<std::string>{"after", "0"} + each.words);
    }
    for (auto& each : lives) {
      ASSERT_EQ(each.running->ends(), 0) << "commit " << each.number << "\n" << each.running->said();
      expect_each_row_once(each.number);
      inserted += inserts(each.number);
    }
  }
  std::printf("%d commits; inserts done: %d\n", last - 1, inserted);
  EXPECT_GT(last, rows / batch) << "each batch is at least one commit";
  EXPECT_GT(inserted, 0);
  EXPECT_EQ(world.service->figures().rows[row_kind::observation].repeated, 0U);
  EXPECT_EQ(world.service->figures().rows[row_kind::observation].differing, 0U);
}

INSTANTIATE_TEST_SUITE_P(place, kill_run, testing::Values("before", "after"),
                         [](const auto& place) { return std::string(place.param); });

} // namespace kill_test
