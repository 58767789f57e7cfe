#include "actors/mapobjects_store/view_cursor.hpp"

#include <algorithm>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace view_cursor_test {

using namespace godwit::tests;

class view_cursor_test : public tests::map_test {
protected:
  view_cursor look(double radius_m = 100, const std::string& group = "vehicle") {
    pass_end pass;
    pass.class_groups = {group};
    pass.circles = {{place(0), radius_m}, {place(1), radius_m}}; // most of it is in view twice
    auto cursor = view_cursor::open(*open_map_for_reading(folder.file()), pass);
    EXPECT_TRUE(cursor.has_value());
    return std::move(*cursor);
  }
  static std::vector<std::string> in_view(view_cursor cursor) {
    std::vector<std::string> ids;
    for (auto row = cursor.next(); row && *row; row = cursor.next())
      if ((*row)->in_view)
        ids.push_back((*row)->object_id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

TEST_F(view_cursor_test, loaded_and_seen_objects_are_in_view_each_once) {
  load({object(1, place(0)), object(2, place(500))});
  record(seen(10, place(50)));
  EXPECT_EQ(in_view(look()), (std::vector{uuid(1), uuid(10)}));
}

TEST_F(view_cursor_test, an_object_that_moved_is_where_it_is_now) {
  load({object(1, place(0))});
  record(seen(10, place(25)));
  auto cursor = look();
  const auto row = cursor.next();
  ASSERT_TRUE(row && *row);
  EXPECT_EQ((*row)->object_id, uuid(1));
  EXPECT_EQ((*row)->loaded_number, 0);
  EXPECT_TRUE(in_view(look(5)).empty());
}

TEST_F(view_cursor_test, what_changes_later_is_not_seen_by_it) {
  record(seen(10, place(0)));
  auto cursor = look();
  record(seen(11, place(60)));
  load({});
  EXPECT_EQ(in_view(std::move(cursor)), std::vector{uuid(10)});
}

TEST_F(view_cursor_test, other_class_groups_are_not_in_view) {
  record(seen(10, place(0)));
  EXPECT_TRUE(in_view(look(100, "person")).empty());
}

} // namespace view_cursor_test
} // namespace godwit::mapobjects_store
