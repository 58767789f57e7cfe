// The end of a pass, in turns: what was in view and not seen becomes an observation.
//
// Not missed are: objects of class groups that were not looked for, what is on the ignore list, and what was seen since
// the pass started, be it after its end. What is in view is read on a connection of its own, from the map as it was
// when the review began; each object is looked at again before it is missed, and one of a map that was replaced
// meanwhile is not. The id of a missing follows from those of
// pass and object: a review that is done again misses nothing twice. Thread: the writer's.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <variant>
#include <vector>

#include "actors/domain/geo/bounding_box.hpp"
#include "actors/domain/geo/polygon.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/map_tables.hpp"
#include "actors/mapobjects_store/staged_work.hpp"
#include "io/sqlite/database.hpp"
#include "messages/mapobjects_store/pass.hpp"

namespace godwit::mapobjects_store {

// What was in view during a pass, as areas that can be asked one by one. Thread: pure.
struct circle_area {
  geo::point centre;
  double radius_m = 0;
};

using view_area = std::variant<circle_area, geo::polygon>;

// Input that was checked.
[[nodiscard]] std::vector<view_area> areas_of(const pass_end& pass);

[[nodiscard]] bool contains(const view_area& area, const geo::point& at);
[[nodiscard]] std::vector<geo::bounding_box> boxes_of(const view_area& area);

// The objects in view of a pass, one after the other, from the map as it was when the cursor was opened.
//
// It holds that state of the file with an open read transaction, on a connection of its own: writing goes on beside it,
// and only the log can not be shortened meanwhile. Thread: one at a time.
class view_cursor {
public:
  // PASS was checked.
  [[nodiscard]] static map_result<view_cursor> open(io::sqlite::database reader, const pass_end& pass);

  struct row {
    std::string object_id;
    std::int64_t loaded_number = 0; // 0 = it was seen here
    bool in_view = false;           // else it was only near, or was in view before
  };

  // Nothing after the last one.
  [[nodiscard]] map_result<std::optional<row>> next();

private:
  struct box_query {
    io::sqlite::statement prepared;
    bool is_loaded = false;
  };
  struct question {
    std::size_t query = 0;
    std::size_t area = 0;
    geo::bounding_box box;
  };

  view_cursor(io::sqlite::database reader, const pass_end& pass);
  [[nodiscard]] map_result<void> prepare(const char* text, bool is_loaded);
  row judge();

  std::unique_ptr<io::sqlite::database> reader_; // a place of its own, which the statements point to
  std::vector<box_query> queries_;               // gone before their connection
  std::int64_t pulled_observation_ = 0;
  std::vector<view_area> areas_;
  std::vector<question> questions_;
  std::size_t question_ = 0;
  bool asked_ = false; // the query runs for questions_[question_]
  std::unordered_set<std::string> groups_;
  std::unordered_set<std::int64_t> known_numbers_; // those seen here as negative ones; at most one for each in view
};

class pass_review final : public staged_work {
public:
  using callback = std::function<void(const map_result<pass_reviewed>&)>;

  // A pass that was checked.
  pass_review(pass_end pass, view_cursor in_view, callback done);

  [[nodiscard]] map_result<bool> stage(map_tables& t, decision_context& now) override;
  void committed() override;
  [[nodiscard]] bool must_be_synced() const override { return true; }
  void finish(const map_result<void>& result) override;

private:
  map_result<void> look_at(map_tables& t, const view_cursor::row& seen_then);
  map_result<void> miss(map_tables& t, const map_object& object);

  pass_end pass_;
  view_cursor in_view_;
  callback done_;
  std::vector<view_cursor::row> uncommitted_; // objects that come again when their transaction fails
  pass_reviewed staged_;
  pass_reviewed counts_;
};

// What of the map people are shown of a part of it: the newest objects, and how many there are.
//
// At most max_counted_objects of those that were pulled are looked at, and as many of those that were seen here,
// whatever the map has: it is asked in the thread that writes. Thread: the one of the database.
struct objects_found {
  std::vector<shown_object> list;
  std::uint64_t counted = 0;
  bool is_all = true;
};

[[nodiscard]] map_result<objects_found> look_at_objects(map_tables& t, const get_objects& asked);

} // namespace godwit::mapobjects_store
