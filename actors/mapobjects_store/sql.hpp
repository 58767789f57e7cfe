// Statements on the map's tables, one call each: binds C++ values, runs, takes the rows, and speaks of errors in the
// map's words.
//
// Texts of statements are literals: they are the keys of a cache. A `take` must not run the same statement again.
// Thread: the one of its database.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "actors/mapobjects_store/sqlite_error.hpp"
#include "io/fields/field_table.hpp"
#include "io/sqlite/statement_cache.hpp"

namespace godwit::mapobjects_store {

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

} // namespace godwit::mapobjects_store
