// The records of the journal as rows: applies writes inside the caller's transaction and reads an actor's state back.
//
// Thread: the one of its database.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "io/sqlite/database.hpp"
#include "io/sqlite/statement_cache.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

[[nodiscard]] const char* to_string(delivery_state state);

// Of one actor: the oldest go first. With 64 KiB each they are 64 MiB at most.
inline constexpr std::int64_t max_dead_letters = 1'000;

class record_store {
public:
  explicit record_store(io::sqlite::database& db) : db_(&db), statements_(db) {}

  // Asserts that the events' numbers go on from the actor's last and that a snapshot does not go back.
  [[nodiscard]] io::sqlite::result<void> apply(const journal_write& write);

  // Numbers seen by apply count only once their transaction has ended: call one of these then.
  void keep_numbers();
  void drop_numbers() { staged_.clear(); }

  [[nodiscard]] io::sqlite::result<recovered> read(const std::string& actor);

  // Gives back the statements, so that the database can be closed.
  void close() { statements_.clear(); }

private:
  template <class... Values>
  io::sqlite::result<void> run(std::string_view sql, const Values&... values);
  template <class Take, class... Values>
  io::sqlite::result<void> each(std::string_view sql, const Take& take, const Values&... values);

  io::sqlite::result<void> apply(const row_change& change);
  io::sqlite::result<std::int64_t> last_number(const std::string& actor);
  io::sqlite::result<void> add_event(const std::string& actor, const event_record& event);
  io::sqlite::result<void> replace_snapshot(const std::string& actor, const snapshot_record& snapshot);
  io::sqlite::result<void> add_effects(const journal_write& write);
  io::sqlite::result<void> add_marks(const journal_write& write);
  io::sqlite::result<void> add_outbox(const journal_write& write);
  io::sqlite::result<void> add_dead_letters(const journal_write& write);

  io::sqlite::database* db_;
  io::sqlite::statement_cache statements_;
  // Highest event number of each actor that wrote in this run: in the database, and in the open transaction.
  std::unordered_map<std::string, std::int64_t> committed_;
  std::unordered_map<std::string, std::int64_t> staged_;
};

} // namespace godwit::runtime
