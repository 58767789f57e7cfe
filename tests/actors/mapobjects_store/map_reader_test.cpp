#include "actors/mapobjects_store/map_reader.hpp"

#include <set>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_reader_test {

using namespace godwit::tests;

using map_reader_test = tests::map_test;

TEST_F(map_reader_test, page_by_page_each_object_comes_once) {
  std::vector<map_object> many;
  for (std::uint64_t i = 0; i < 2 * map_reader::max_objects + 1; ++i)
    many.push_back(object(i, place(0, 100 * static_cast<double>(i))));
  load(many);
  record(seen(100'000, place(500)));
  record(seen(100'001, place(20))); // moves a loaded one
  const auto ids = shown();
  EXPECT_EQ(ids.size(), many.size() + 1);
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size());
}

TEST_F(map_reader_test, an_object_that_moved_is_told_where_it_is_now) {
  load({object(1, place(0))});
  record(seen(10, place(20)));
  const auto page = map_reader::open(folder.file())->objects();
  ASSERT_EQ(page->objects.size(), 1U);
  EXPECT_EQ(page->objects[0].position.longitude_deg, place(20).longitude_deg);
}

TEST_F(map_reader_test, a_page_says_of_which_load_it_is) {
  load({object(1, place(0))});
  auto reader = map_reader::open(folder.file());
  const auto first = reader->objects()->generation;
  load({object(1, place(0))});
  EXPECT_NE(reader->objects()->generation, first);
}

TEST_F(map_reader_test, it_sees_the_map_row_as_it_is_on_the_disk) {
  load({object(1, place(0))});
  EXPECT_EQ(map_reader::open(folder.file())->map()->sync, sync_state::synced);
}

TEST_F(map_reader_test, a_file_that_is_not_there_is_an_error) {
  close();
  EXPECT_EQ(map_reader::open(folder.file() + ".other").error().code, map_errc::missing);
}

} // namespace map_reader_test
} // namespace godwit::mapobjects_store
