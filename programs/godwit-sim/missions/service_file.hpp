// The file of a missions service: missions, assignments, what vehicles delivered, and the answers that they got.
//
// The first error is kept, and from then on nothing is read or written until take_error: so a row of statements stays
// readable, and who commits learns whether all of them worked. Commits are not forced to the disk (synchronous=NORMAL):
// a computer that loses its power may lose the last of them, which is good enough for a service to try things on.
//
// Errors: open gives a sentence; the others as above. Thread: one at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

#include "io/sqlite/database.hpp"
#include "io/sqlite/statement_cache.hpp"

namespace godwit::sim::missions {

class service_file {
public:
  [[nodiscard]] static tl::expected<std::unique_ptr<service_file>, std::string> open(const std::string& path);
  service_file(const service_file&) = delete;
  service_file& operator=(const service_file&) = delete;
  ~service_file() = default;

  // Calls ON_ROW with each row of what SQL gives for VALUES.
  template <class OnRow, class... Values>
  void each_row(std::string_view sql, const OnRow& on_row, const Values&... values) {
    auto* const prepared = prepare(sql);
    if (prepared == nullptr)
      return;
    prepared->with(values...);
    while (step(*prepared))
      on_row(std::as_const(*prepared));
    prepared->reset();
  }

  template <class... Values>
  void run(std::string_view sql, const Values&... values) {
    each_row(
        sql, [](const io::sqlite::statement&) {}, values...);
  }

  // What TAKE makes of the first row, or nothing.
  template <class Take, class... Values>
  [[nodiscard]] auto first_row(std::string_view sql, const Take& take, const Values&... values) {
    std::optional<decltype(take(std::declval<const io::sqlite::statement&>()))> found;
    each_row(
        sql,
        [&](const io::sqlite::statement& row) {
          if (!found)
            found = take(row);
        },
        values...);
    return found;
  }

  template <class... Values>
  [[nodiscard]] std::optional<std::int64_t> number(std::string_view sql, const Values&... values) {
    return first_row(
        sql, [](const io::sqlite::statement& row) { return row.integer(0); }, values...);
  }

  void begin() { run("BEGIN IMMEDIATE"); }
  void rollback();
  // False: nothing of the transaction is in the file; see take_error.
  [[nodiscard]] bool commit();
  [[nodiscard]] bool has_failed() const { return error_.has_value(); }
  // The sentence about what went wrong, which is forgotten here; empty: nothing.
  [[nodiscard]] std::string take_error();

private:
  explicit service_file(io::sqlite::database opened) : db_(std::move(opened)), statements_(db_) {}

  [[nodiscard]] tl::expected<void, std::string> prepare_schema();
  [[nodiscard]] io::sqlite::statement* prepare(std::string_view sql);
  [[nodiscard]] bool step(io::sqlite::statement& prepared);

  io::sqlite::database db_;
  io::sqlite::statement_cache statements_;
  std::optional<io::sqlite::error> error_;
};

} // namespace godwit::sim::missions
