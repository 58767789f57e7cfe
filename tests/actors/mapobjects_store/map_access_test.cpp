// The writer of the map without its thread: what happens in which transaction.
#include "actors/mapobjects_store/map_access.hpp"

#include "actors/mapobjects_store/map_writer.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "io/sqlite/fault_vfs.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_target_test {

using io::sqlite::fault_kind;
using io::sqlite::fault_vfs;
using namespace godwit::tests;

class map_target_test : public ::testing::Test {
protected:
  map_target_test() {
    map_writer_options options;
    options.store.file.path = folder.file();
    options.store.file.vfs = (fault_vfs::instance(), fault_vfs::name);
    options.own_thread = false;
    options.clock = [this] { return now; };
    writer = std::move(*map_writer::open(options));
    for (int i = 0; i < 3; ++i) // the first look for garbage
      writer->run_once();
  }
  ~map_target_test() override { fault_vfs::instance().disarm(); }

  void post_sighting(std::uint64_t id) {
    EXPECT_TRUE(writer->post([=](map_tables& t) { return record(t, seen(id, place(100.0 * static_cast<double>(id)))); },
                             [this](const map_result<observed>& done) { done ? ++recorded : ++refused; }));
  }
  std::int64_t begin_load() {
    std::int64_t number = 0;
    EXPECT_TRUE(writer->post([](map_tables& t) { return begin(t, {mission_a}); },
                             [&](const map_result<begun_load>& done) { number = done ? done->number : 0; }));
    writer->run_once();
    EXPECT_NE(number, 0);
    return number;
  }
  void post_page(std::int64_t load, std::uint64_t objects = 100) {
    load_page page{.load = load, .objects = {}, .ignored = {}};
    for (std::uint64_t i = 0; i < objects; ++i)
      page.objects.push_back(object(1000 + i, place(static_cast<double>(i), 1000)));
    EXPECT_TRUE(
        writer->add_page(std::move(page), [this](const map_result<void>& done) { done ? ++pages : ++refused; }));
  }

  scratch_folder folder;
  std::chrono::steady_clock::time_point now{std::chrono::hours(1)};
  int recorded = 0;
  int refused = 0;
  int pages = 0;
  std::unique_ptr<map_writer> writer; // tells of the rest when it is closed
};

TEST_F(map_target_test, what_waits_commits_in_one_transaction) {
  begin_load();
  const auto before = writer->status().commits;
  for (std::uint64_t id = 1; id <= 5; ++id)
    post_sighting(id);
  EXPECT_EQ(recorded, 0);
  writer->run_once();
  EXPECT_EQ(recorded, 5);
  EXPECT_EQ(writer->status().commits, before + 1);
}

TEST_F(map_target_test, a_job_waits_for_changes_and_gets_its_turn_after_100_ms_all_the_same) {
  const auto load = begin_load();
  writer->run_once(); // garbage of the beginning
  post_page(load);
  post_sighting(1);
  writer->run_once();
  EXPECT_EQ(recorded, 1);
  EXPECT_EQ(pages, 0);
  post_sighting(2);
  now += std::chrono::milliseconds(101);
  writer->run_once();
  EXPECT_EQ(recorded, 1);
  EXPECT_EQ(pages, 1);
}

TEST_F(map_target_test, a_job_that_the_disk_refuses_comes_again) {
  const auto load = begin_load();
  writer->run_once();
  fault_vfs::instance().arm({.kind = fault_kind::disk_full, .at = 1, .from_then_on = true});
  post_page(load);
  writer->run_once();
  EXPECT_TRUE(writer->status().failing);
  EXPECT_EQ(pages + refused, 0);
  fault_vfs::instance().disarm();
  now += std::chrono::seconds(2);
  writer->run_once();
  EXPECT_EQ(pages, 1);
  EXPECT_FALSE(writer->status().failing);
}

TEST_F(map_target_test, closing_ends_a_job_that_is_not_finished) {
  post_page(begin_load(), max_chunk_rows + 1);
  writer->close();
  EXPECT_EQ(refused, 1);
}

} // namespace map_target_test
} // namespace godwit::mapobjects_store
