// The objects in view of a pass, one after the other, from the map as it was when the cursor was opened.
//
// It holds that state of the file with an open read transaction, on a connection of its own: writing goes on beside it,
// and only the log can not be shortened meanwhile. Thread: one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/view.hpp"
#include "io/sqlite/database.hpp"
#include "messages/mapobjects_store/pass.hpp"

namespace godwit::mapobjects_store {

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

} // namespace godwit::mapobjects_store
