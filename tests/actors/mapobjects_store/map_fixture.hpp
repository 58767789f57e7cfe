// A map in a folder of its own, and short ways to say what happens to it. Thread: the test's.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/map_reader.hpp"
#include "actors/mapobjects_store/map_store.hpp"

namespace godwit::tests {

// UUIDs that are easy to tell apart.
[[nodiscard]] std::string uuid(std::uint64_t number);

inline const std::string mission_a = uuid(0xa0000000);
inline const std::string mission_b = uuid(0xb0000000);

// A folder that is gone afterwards.
class scratch_folder {
public:
  scratch_folder();
  ~scratch_folder();
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;

  [[nodiscard]] std::string file() const { return (path_ / "map.db").string(); }

private:
  std::filesystem::path path_;
};

// Of the file that a writer may have open.
[[nodiscard]] std::vector<mapobjects_store::owed> owed_in(const std::string& file);

// Metres to the east and north of a place in Austria.
[[nodiscard]] mapobjects_store::geo_position place(double east_m, double north_m = 0);

[[nodiscard]] mapobjects_store::sighting seen(std::uint64_t id, const mapobjects_store::geo_position& at,
                                              std::int64_t at_ns = 1, const std::string& mission = mission_a);
[[nodiscard]] mapobjects_store::map_object object(std::uint64_t id, const mapobjects_store::geo_position& at,
                                                  const std::string& mission = mission_a);
[[nodiscard]] mapobjects_store::operator_verdict
verdict_on(std::uint64_t id, const mapobjects_store::geo_position& at,
           mapobjects_store::verdict said = mapobjects_store::verdict::declined,
           const std::string& mission = mission_a);

// Ids of what is in it, in its order.
[[nodiscard]] std::vector<std::string> ids_of(const mapobjects_store::batch& taken);

class map_test : public ::testing::Test {
public: // also used as a value, by property tests
  map_test() { open(); }

  void open(const mapobjects_store::settings& rules = {});
  void close() { store.reset(); }

  mapobjects_store::observation record(const mapobjects_store::sighting& what);
  mapobjects_store::observation_kind kind(const mapobjects_store::sighting& what) { return record(what).kind; }
  void load(const std::vector<mapobjects_store::map_object>& objects,
            const std::vector<mapobjects_store::ignored_item>& ignored = {}, const std::string& mission = mission_a);
  std::int64_t begin_load(const std::string& mission = mission_a);
  [[nodiscard]] mapobjects_store::map_result<void> add_page(mapobjects_store::load_page page);
  [[nodiscard]] mapobjects_store::map_result<void> finish(std::int64_t load, std::int64_t objects,
                                                          std::int64_t ignored = 0);
  // What has changed since the load before.
  void load_change(const std::vector<mapobjects_store::map_object>& objects, const std::vector<std::string>& removed,
                   const std::string& mark = {});
  // KEY: number of the UUID.
  [[nodiscard]] mapobjects_store::map_result<mapobjects_store::batch>
  try_take(std::uint64_t key, std::uint32_t limit = 1000, const std::string& mission = mission_a,
           mapobjects_store::destination to = mapobjects_store::destination::observations);
  mapobjects_store::batch take(std::uint64_t key, std::uint32_t limit = 1000, const std::string& mission = mission_a,
                               mapobjects_store::destination to = mapobjects_store::destination::observations);
  void delivered(std::uint64_t key);
  void deliver_all(const std::string& mission = mission_a);
  void collect_garbage(std::int64_t keep_delivered = 0);

  // Ids of what is shown, in their order.
  std::vector<std::string> shown();
  [[nodiscard]] std::vector<mapobjects_store::owed> what_is_owed() { return owed_in(folder.file()); }
  std::int64_t count(const std::string& from); // rows, e.g. "observation WHERE delivery = 'taken'"

  scratch_folder folder;
  std::unique_ptr<mapobjects_store::map_store> store;

private:
  std::uint64_t made_keys_ = 0;
};

} // namespace godwit::tests
