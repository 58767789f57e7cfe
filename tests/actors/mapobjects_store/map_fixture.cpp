#include "tests/actors/mapobjects_store/map_fixture.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>

#include <unistd.h>

#include "actors/domain/geo/local_projection.hpp"
#include "actors/mapobjects_store/garbage.hpp"
#include "actors/mapobjects_store/map_file.hpp"
#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/sightings.hpp"

namespace godwit::tests {

using namespace mapobjects_store;

std::string uuid(std::uint64_t number) {
  char text[37];
  std::snprintf(text, sizeof text, "%08x-0000-4000-8000-%012llx", static_cast<unsigned>(number >> 24),
                static_cast<unsigned long long>(number));
  return text;
}

namespace {

// In memory where there is such a place: what is tested is the order of things, and syncing a disk takes most of the
// time.
std::filesystem::path place_for_folders() {
  const std::filesystem::path memory = "/dev/shm";
  return ::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
}

} // namespace

scratch_folder::scratch_folder() {
  static std::atomic<int> made{0};
  path_ =
      place_for_folders() / ("godwit_map_test_" + std::to_string(::getpid()) + "_" + std::to_string(made.fetch_add(1)));
  std::filesystem::remove_all(path_);
}

scratch_folder::~scratch_folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

geo_position place(double east_m, double north_m) {
  const auto at = geo::local_projection({48, 16}).to_globe({east_m, north_m});
  return {at.latitude_deg, at.longitude_deg, std::nullopt};
}

sighting seen(std::uint64_t id, const geo_position& at, std::int64_t at_ns, const std::string& mission) {
  return {.id = uuid(id),
          .mission_id = mission,
          .class_group = "vehicle",
          .position = at,
          .at_ns = at_ns,
          .confidence = 0.5};
}

map_object object(std::uint64_t id, const geo_position& at, const std::string& mission) {
  return {.id = uuid(id),
          .mission_id = mission,
          .class_group = "vehicle",
          .position = at,
          .first_seen_ns = 1,
          .last_seen_ns = 1,
          .confidence = 0.5};
}

operator_verdict verdict_on(std::uint64_t id, const geo_position& at, verdict said, const std::string& mission) {
  return {.id = uuid(id), .mission_id = mission, .class_group = "vehicle", .position = at, .said = said, .at_ns = 1};
}

void map_test::open(const settings& rules) {
  store.reset();
  auto opened = map_store::open({.file = {.path = folder.file()}, .rules = rules});
  ASSERT_TRUE(opened.has_value()) << opened.error().message();
  store = std::move(*opened);
}

observation map_test::record(const sighting& what) {
  const auto done = store->transact([&](map_tables& t) { return mapobjects_store::record(t, what); });
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message());
  return done ? done->what : observation{};
}

std::int64_t map_test::begin_load(const std::string& mission) {
  const auto number = store->transact([&](map_tables& t) { return begin(t, {mission}); });
  EXPECT_TRUE(number.has_value()) << (number ? "" : number.error().message());
  return number ? number->number : 0;
}

map_result<void> map_test::add_page(load_page page) {
  page_stage stage(std::move(page), [](const map_result<void>&) {});
  return store->run(stage);
}

void map_test::load(const std::vector<map_object>& objects, const std::vector<ignored_item>& ignored,
                    const std::string& mission) {
  const auto number = begin_load(mission);
  const auto added = add_page({.load = number, .objects = objects, .ignored = ignored});
  ASSERT_TRUE(added.has_value()) << added.error().message();
  const auto done =
      finish(number, static_cast<std::int64_t>(objects.size()), static_cast<std::int64_t>(ignored.size()));
  ASSERT_TRUE(done.has_value()) << done.error().message();
}

map_result<void> map_test::finish(std::int64_t load, std::int64_t objects, std::int64_t ignored) {
  load_finish end({.load = load, .objects = objects, .ignored = ignored, .at_ns = 5}, [](const map_result<void>&) {});
  return store->run(end);
}

void map_test::load_change(const std::vector<map_object>& objects, const std::vector<std::string>& removed,
                           const std::string& mark) {
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = objects, .ignored = {}, .removed = removed}));
  load_finish end({.load = number,
                   .objects = static_cast<std::int64_t>(objects.size()),
                   .at_ns = 6,
                   .is_change = true,
                   .mark = mark},
                  [](const map_result<void>&) {});
  const auto done = store->run(end);
  ASSERT_TRUE(done.has_value()) << done.error().message();
}

std::vector<std::string> ids_of(const batch& taken) {
  std::vector<std::string> ids;
  for (const auto& each : taken.observations)
    ids.push_back(each.id);
  for (const auto& each : taken.ignored_items)
    ids.push_back(each.id);
  return ids;
}

map_result<batch> map_test::try_take(std::uint64_t key, std::uint32_t limit, const std::string& mission,
                                     destination to) {
  const take_batch asked{.key = uuid(key), .mission_id = mission, .to = to, .limit = limit};
  return store->transact([&](map_tables& t) { return mapobjects_store::take(t, asked); });
}

batch map_test::take(std::uint64_t key, std::uint32_t limit, const std::string& mission, destination to) {
  auto taken = try_take(key, limit, mission, to);
  EXPECT_TRUE(taken.has_value()) << (taken ? "" : taken.error().message());
  return taken.value_or(batch{});
}

void map_test::delivered(std::uint64_t key) {
  const auto done = store->transact([&](map_tables& t) { return deliver(t, {uuid(key)}); });
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message());
}

void map_test::deliver_all(const std::string& mission) {
  for (const auto to : {destination::observations, destination::ignored_items})
    for (;;) {
      const auto key = 0xd000000000 + ++made_keys_;
      if (ids_of(take(key, 1000, mission, to)).empty())
        break;
      delivered(key);
    }
}

std::vector<owed> owed_in(const std::string& file) {
  auto db = open_map_for_reading(file);
  sql q(*db);
  return all_owed(q).value();
}

void map_test::collect_garbage(std::int64_t keep_delivered) {
  garbage_collection garbage(keep_delivered);
  const auto done = store->run(garbage);
  ASSERT_TRUE(done.has_value()) << done.error().message();
}

std::vector<std::string> map_test::shown() {
  auto reader = map_reader::open(folder.file());
  EXPECT_TRUE(reader.has_value());
  std::vector<std::string> ids;
  for (std::optional<object_place> next = object_place{}; next;) {
    const auto page = reader->objects(*next);
    EXPECT_TRUE(page.has_value());
    for (const auto& each : page->objects)
      ids.push_back(each.id);
    next = page->next;
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::int64_t map_test::count(const std::string& from) {
  auto db = open_map_for_reading(folder.file());
  EXPECT_TRUE(db.has_value());
  return db->query_integer("SELECT count(*) FROM " + from).value_or(-1);
}

} // namespace godwit::tests
