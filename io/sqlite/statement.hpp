// A prepared statement.
//
// Text is bound without a copy: it must live until the next reset. An error of binding is kept and reported by step, so
// that a row of bind calls stays readable. Parameters count from 1 and columns from 0, as in SQLite. Thread: the one of
// its database.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/sqlite/store_error.hpp"

struct sqlite3_stmt;

namespace godwit::io::sqlite {

class statement {
public:
  explicit statement(sqlite3_stmt* handle) : handle_(handle) {}

  void bind(int parameter, std::nullptr_t);
  void bind(int parameter, std::int64_t value);
  void bind(int parameter, double value);
  void bind(int parameter, std::string_view value);

  // Binds all parameters from the first on.
  template <class... Values>
  statement& with(const Values&... values) {
    int parameter = 0;
    (bind_one(++parameter, values), ...);
    return *this;
  }

  // True: a row is there to be read. False: done. After an error or the last row call reset.
  [[nodiscard]] result<bool> step();

  // Steps to the end, drops any rows, and resets.
  [[nodiscard]] result<void> run();

  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] bool is_null(int column) const;
  [[nodiscard]] int parameter_count() const;
  [[nodiscard]] bool changes_data() const; // false for queries and for BEGIN, COMMIT and the like
  [[nodiscard]] std::string sql() const;

private:
  struct finalizer {
    void operator()(sqlite3_stmt* handle) const;
  };

  template <class Value>
  void bind_one(int parameter, const Value& value) {
    if constexpr (std::is_integral_v<Value>)
      bind(parameter, static_cast<std::int64_t>(value));
    else
      bind(parameter, value);
  }

  void keep(int code);

  std::unique_ptr<sqlite3_stmt, finalizer> handle_;
  int bind_code_ = 0;
};

} // namespace godwit::io::sqlite
