// Looks into a journal without writing: for tools, beside a running writer or after it has gone.
//
// Each call reads what is committed at that moment. Lists are bounded by max_rows; go on with the last number seen.
// Thread: one at a time; open as many readers as you like.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/sqlite/database.hpp"
#include "runtime/journal/journal_file.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

struct actor_summary {
  std::string name;
  std::int64_t last_event = 0;
  std::int64_t events_after_snapshot = 0;
  std::int64_t pending_effects = 0;
};

class journal_reader {
public:
  static constexpr std::size_t max_rows = 10'000;

  template <class T>
  using result = tl::expected<T, journal_error>;

  // The same refusals as for the writer: missing, foreign, newer, corrupt.
  [[nodiscard]] static result<journal_reader> open(const std::string& path, const std::string& vfs = {});

  [[nodiscard]] result<std::vector<actor_summary>> actors();
  [[nodiscard]] result<std::vector<event_record>> events(const std::string& actor, std::int64_t after_number = 0);
  [[nodiscard]] result<std::optional<snapshot_record>> snapshot(const std::string& actor);
  [[nodiscard]] result<std::vector<effect_record>> effects(const std::string& actor);
  [[nodiscard]] result<std::vector<outbox_row>> outbox(const std::string& actor);
  [[nodiscard]] result<std::vector<dead_letter>> dead_letters(const std::string& actor);

  [[nodiscard]] result<void> check(integrity_check check = integrity_check::full);

  // For typed tables: the connection itself. Read only.
  [[nodiscard]] io::sqlite::database& database() { return db_; }

private:
  journal_reader(io::sqlite::database db, std::string path) : db_(std::move(db)), path_(std::move(path)) {}

  template <class Row, class Take, class... Values>
  result<std::vector<Row>> list(const std::string& sql, const Take& take, const Values&... values);

  io::sqlite::database db_;
  std::string path_;
};

} // namespace godwit::runtime
