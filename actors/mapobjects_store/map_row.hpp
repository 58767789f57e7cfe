// The one row that says which map is shown and how far it can be relied on.
//
// What is shown: the objects and ignored items of the last load, as long as the chosen mission is the one that they
// were pulled for; and what was seen here with a number above `pulled_...`, because the load does not contain it.
// Changing this row replaces the whole map at once. Thread: plain value; load and save the one of the database.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/mapobjects_store/error.hpp"
#include "io/fields/field_table.hpp"
#include "io/sqlite/statement_cache.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mapobjects_store {

// A place of the map's messages as the geodesics take it. Thread: pure.
[[nodiscard]] inline geo::point point_of(const geo_position& at) { return {at.latitude_deg, at.longitude_deg}; }

// Statements on the map's tables, one call each: binds C++ values, runs, takes the rows, and speaks of errors in the
// map's words.
//
// Texts of statements are literals: they are the keys of a cache. A `take` must not run the same statement again.
// Thread: the one of its database.
class sql {
public:
  using row = io::sqlite::statement;

  explicit sql(io::sqlite::database& db) : db_(&db), statements_(db) {}

  // Calls TAKE(row) for each row; TAKE returns nothing, or false to stop.
  template <class Take, class... Values>
  [[nodiscard]] map_result<void> each(std::string_view text, const Take& take, const Values&... values);

  template <class... Values>
  [[nodiscard]] map_result<void> run(std::string_view text, const Values&... values) {
    return each(
        text, [](row&) {}, values...);
  }

  // TAKE(row) of the first row, nothing where there is none.
  template <class Take, class... Values>
  [[nodiscard]] auto first(std::string_view text, const Take& take, const Values&... values)
      -> map_result<std::optional<decltype(take(std::declval<row&>()))>>;

  // Of the row that was inserted last.
  [[nodiscard]] map_result<std::int64_t> inserted_number() {
    return first("SELECT last_insert_rowid()", [](row& there) { return there.integer(0); }).map([](const auto& number) {
      return number.value_or(0);
    });
  }

  // Rows that the last statement changed.
  [[nodiscard]] std::int64_t changes() const { return db_->changes(); }

  // Gives back the statements, so that the database can be closed.
  void close() { statements_.clear(); }

private:
  template <class Value>
  static void bind(row& to, int parameter, const Value& value) {
    if constexpr (io::is_optional<Value>::value) {
      if (value)
        bind(to, parameter, *value);
      else
        to.bind(parameter, nullptr);
    } else if constexpr (io::named_enum<Value>) {
      to.bind(parameter, io::name_of(value));
    } else if constexpr (std::is_integral_v<Value>) {
      to.bind(parameter, static_cast<std::int64_t>(value));
    } else {
      to.bind(parameter, value);
    }
  }

  io::sqlite::database* db_;
  io::sqlite::statement_cache statements_;
};

template <class Take, class... Values>
map_result<void> sql::each(std::string_view text, const Take& take, const Values&... values) {
  auto found = statements_.get(text);
  if (!found)
    return tl::unexpected(from_sqlite(found.error(), "preparing it"));
  auto& statement = **found;
  int parameter = 0;
  (bind(statement, ++parameter, values), ...);
  for (;;) {
    auto there = statement.step();
    if (!there || !*there) {
      statement.reset();
      if (!there)
        return tl::unexpected(from_sqlite(there.error(), "running it"));
      return {};
    }
    if constexpr (std::is_same_v<decltype(take(statement)), bool>) {
      if (!take(statement)) {
        statement.reset();
        return {};
      }
    } else {
      take(statement);
    }
  }
}

template <class Take, class... Values>
auto sql::first(std::string_view text, const Take& take, const Values&... values)
    -> map_result<std::optional<decltype(take(std::declval<row&>()))>> {
  std::optional<decltype(take(std::declval<row&>()))> result;
  const auto stop_at_first = [&](row& there) {
    result.emplace(take(there));
    return false;
  };
  if (auto done = each(text, stop_at_first, values...); !done)
    return tl::unexpected(std::move(done.error()));
  return result;
}

struct map_row {
  std::string mission_id; // chosen; empty = none
  sync_state sync = sync_state::fresh_boot;

  std::string pulled_mission_id; // what the last load was for; empty = there was none
  std::int64_t pulled_ns = 0;
  std::int64_t generation = 0;   // number of the last load
  std::int64_t first_object = 1; // its rows
  std::int64_t last_object = 0;
  std::int64_t ignored_items = 0;      // how many it has
  std::int64_t tree = 0;               // the tree that has its places
  std::int64_t pulled_observation = 0; // numbers up to these are contained in the load
  std::int64_t pulled_ignored_item = 0;
  std::int64_t last_generation = 0; // highest number ever used for a load
  std::string pulled_mark;          // of the last load, as the service names it; empty = it did not

  [[nodiscard]] bool has_copy() const { return !pulled_mission_id.empty() && pulled_mission_id == mission_id; }
  // No row has the generation -1.
  [[nodiscard]] std::int64_t shown_generation() const { return has_copy() ? generation : -1; }
};

[[nodiscard]] map_result<map_row> load_map_row(sql& q);
[[nodiscard]] map_result<void> save_map_row(sql& q, const map_row& map);

} // namespace godwit::mapobjects_store
