#include "io/sqlite/statement.hpp"

#include <sqlite3.h>

namespace godwit::io::sqlite {

void statement::finalizer::operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }

void statement::keep(int code) {
  if (bind_code_ == SQLITE_OK)
    bind_code_ = code;
}

void statement::bind(int parameter, std::nullptr_t) { keep(sqlite3_bind_null(handle_.get(), parameter)); }

void statement::bind(int parameter, std::int64_t value) { keep(sqlite3_bind_int64(handle_.get(), parameter, value)); }

void statement::bind(int parameter, double value) { keep(sqlite3_bind_double(handle_.get(), parameter, value)); }

void statement::bind(int parameter, std::string_view value) {
  // A null pointer would bind NULL, and an empty view may hold one.
  const char* data = value.data() != nullptr ? value.data() : "";
  keep(sqlite3_bind_text64(handle_.get(), parameter, data, value.size(), SQLITE_STATIC, SQLITE_UTF8));
}

result<bool> statement::step() {
  auto* connection = sqlite3_db_handle(handle_.get());
  if (bind_code_ != SQLITE_OK)
    return tl::unexpected(last_error(connection, bind_code_, sql()));
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW)
    return true;
  if (code == SQLITE_DONE)
    return false;
  return tl::unexpected(last_error(connection, code, sql()));
}

result<void> statement::run() {
  auto row = step();
  while (row && *row)
    row = step();
  reset();
  if (!row)
    return tl::unexpected(std::move(row.error()));
  return {};
}

void statement::reset() {
  sqlite3_reset(handle_.get()); // its code repeats the error of the last step, which step has reported
  bind_code_ = SQLITE_OK;
}

std::int64_t statement::integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }

double statement::real(int column) const { return sqlite3_column_double(handle_.get(), column); }

bool statement::is_null(int column) const { return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL; }

std::string statement::text(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  if (data == nullptr)
    return {};
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

int statement::parameter_count() const { return sqlite3_bind_parameter_count(handle_.get()); }

bool statement::changes_data() const { return sqlite3_stmt_readonly(handle_.get()) == 0; }

std::string statement::sql() const { return sqlite3_sql(handle_.get()); }

} // namespace godwit::io::sqlite
