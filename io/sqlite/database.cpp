#include "io/sqlite/database.hpp"

#include <string_view>
#include <utility>

#include <sqlite3.h>

namespace godwit::io::sqlite {

namespace {

// A file name as a URI: everything but the plainest characters is escaped, so that no name can carry options of its
// own.
std::string as_uri(const std::string& path) {
  static constexpr std::string_view digits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                       c == '.' || c == '-' || c == '_';
    if (plain)
      uri += c;
    else
      uri.append({'%', digits[byte >> 4], digits[byte & 15]});
  }
  return uri;
}

int flags_of(open_mode mode) {
  switch (mode) {
  case open_mode::read_only:
  case open_mode::immutable:
    return SQLITE_OPEN_READONLY;
  case open_mode::read_write:
    return SQLITE_OPEN_READWRITE;
  case open_mode::create:
    return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  return SQLITE_OPEN_READONLY;
}

} // namespace

void database::closer::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle); // v2: statements that outlive the connection keep it until they are gone
}

result<database> database::open(const std::string& path, const open_options& options) {
  sqlite3* raw = nullptr;
  const auto uri = as_uri(path) + (options.mode == open_mode::immutable ? "?immutable=1" : "");
  const int flags = flags_of(options.mode) | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
  const int code = sqlite3_open_v2(uri.c_str(), &raw, flags, options.vfs.empty() ? nullptr : options.vfs.c_str());
  handle_ptr handle(raw);
  if (code != SQLITE_OK)
    return tl::unexpected(last_error(raw, code));
  sqlite3_busy_timeout(raw, options.busy_timeout_ms);
  return database(std::move(handle));
}

result<void> database::exec(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK)
    return tl::unexpected(last_error(handle_.get(), code, sql));
  return {};
}

result<statement> database::prepare(const std::string& sql) {
  sqlite3_stmt* raw = nullptr;
  const char* rest = nullptr;
  const int code = sqlite3_prepare_v3(handle_.get(), sql.c_str(), static_cast<int>(sql.size()) + 1,
                                      SQLITE_PREPARE_PERSISTENT, &raw, &rest);
  if (code != SQLITE_OK)
    return tl::unexpected(last_error(handle_.get(), code, sql));
  statement prepared(raw);
  const bool alone = std::string_view(rest).find_first_not_of(" \t\r\n;") == std::string_view::npos;
  if (raw == nullptr || !alone)
    return tl::unexpected(last_error(nullptr, SQLITE_MISUSE, sql));
  return prepared;
}

namespace {

// The first column of the first row by TAKE; a default value where there is no row.
template <class Value, class Take>
result<Value> first_value(result<statement> prepared, const Take& take) {
  if (!prepared)
    return tl::unexpected(std::move(prepared.error()));
  auto row = prepared->step();
  if (!row)
    return tl::unexpected(std::move(row.error()));
  return *row ? take(*prepared) : Value{};
}

} // namespace

result<std::int64_t> database::query_integer(const std::string& sql) {
  return first_value<std::int64_t>(prepare(sql), [](statement& row) { return row.integer(0); });
}

result<std::string> database::query_text(const std::string& sql) {
  return first_value<std::string>(prepare(sql), [](statement& row) { return row.text(0); });
}

bool database::in_transaction() const { return sqlite3_get_autocommit(handle_.get()) == 0; }

void database::leave_log_at_close() { sqlite3_db_config(handle_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr); }

bool database::read_only() const { return sqlite3_db_readonly(handle_.get(), "main") == 1; }

std::int64_t database::changes() const { return sqlite3_changes64(handle_.get()); }

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char each : text)
    result.append(each == '\'' ? 2 : 1, each);
  return result + "'";
}

result<transaction> transaction::begin(database& db) {
  auto begun = db.exec("BEGIN IMMEDIATE");
  if (!begun)
    return tl::unexpected(std::move(begun.error()));
  return transaction(db);
}

transaction::transaction(transaction&& other) noexcept : db_(std::exchange(other.db_, nullptr)) {}

transaction::~transaction() { rollback(); }

result<void> transaction::commit() {
  auto committed = db_->exec("COMMIT");
  if (!committed)
    rollback();
  db_ = nullptr;
  return committed;
}

void transaction::rollback() {
  // SQLite ends a transaction by itself on some errors; a second ROLLBACK would only be an error of its own.
  if (db_ != nullptr && db_->in_transaction())
    static_cast<void>(db_->exec("ROLLBACK"));
  db_ = nullptr;
}

result<void> back_up(database& from, const std::string& to) {
  auto copy = database::open(to, {.mode = open_mode::create});
  if (!copy)
    return tl::unexpected(copy.error());
  auto* const backup = sqlite3_backup_init(copy->handle(), "main", from.handle(), "main");
  if (backup == nullptr)
    return tl::unexpected(last_error(copy->handle(), sqlite3_errcode(copy->handle())));
  constexpr int all_pages = -1;
  const int code = sqlite3_backup_step(backup, all_pages);
  sqlite3_backup_finish(backup);
  if (code != SQLITE_DONE)
    return tl::unexpected(last_error(copy->handle(), code));
  return copy->exec("PRAGMA journal_mode = DELETE"); // what it brings along of the original asks for a -wal
}

} // namespace godwit::io::sqlite
