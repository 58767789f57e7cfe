// What is written to and read from the journal: plain values, no SQLite and no CAF.
//
// An effect has an id (actor, event number, n): event numbers rise by one for each actor from 1 on and never repeat; n
// counts the effects of one event from 0 on. All bodies are JSON texts; all times are nanoseconds since 1970 (UTC).
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

namespace godwit::runtime {

// What can go wrong with a journal, as a value for the caller and a sentence for people.
//
// Every error names the file and the remedy. Thread: plain value, any thread.
enum class journal_errc {
  locked,            // another process writes this journal
  missing,           // asked to open an existing journal, there is none
  foreign,           // the file is something else than a godwit journal
  newer,             // written by a later version of godwit or of one of its tables
  corrupt,           // the integrity check failed
  read_only,         // the file or its folder can not be written
  disk_full,         // no space left
  io,                // the disk reported an error
  queue_full,        // the writer is late by its bound; nothing was taken
  stale_incarnation, // a crashed incarnation tried to write after its successor had started
  closed,            // the journal is shutting down
};

struct journal_error {
  journal_errc code{};
  std::string file;   // the path concerned
  std::string what;   // what is wrong, with the detail that SQLite or the system gave
  std::string remedy; // what a person can do about it

  // "journal /var/lib/godwit/journal.db: disk is full (...). Free some space; godwit goes on by itself."
  [[nodiscard]] std::string message() const;
};

struct event_record {
  std::int64_t number = 0; // 1, 2, 3, ... for each actor
  std::int64_t at_ns = 0;
  std::string type;
  std::string body;
};

struct snapshot_record {
  std::int64_t number = 0; // the last event that it covers; 0 = before the first
  std::int64_t at_ns = 0;
  int version = 0; // of the state's JSON form; migration is the reader's business
  std::string body;
};

struct effect_id {
  std::int64_t event = 0;
  std::uint32_t n = 0;
  friend constexpr std::strong_ordering operator<=>(const effect_id&,
                                                    const effect_id&) = default; // NOLINT(modernize-use-nullptr)
};

struct effect_record {
  effect_id id;
  std::string type;
  std::string body;
  std::uint64_t answer_to = 0; // id of the request that it answers; 0 = it is not an answer
};

// The highest effect of SOURCE that an actor has taken; what is not above it is a repetition.
struct seen_mark {
  std::string source;
  effect_id upto;
};

struct dead_letter {
  std::uint64_t message_id = 0;
  std::uint64_t cause_id = 0;
  std::int64_t at_ns = 0;
  std::string sender;
  std::string type;
  std::string body; // JSON, secrets left out
  int attempts = 0;
  std::string reason;
};

using sql_value = std::variant<std::nullptr_t, std::int64_t, double, std::string>;

// One statement on a typed table. The text must be a literal or otherwise live as long as the journal and take few
// different values: it is the key of the prepared-statement cache.
struct row_change {
  std::string sql;
  std::vector<sql_value> values;
};

enum class delivery_state { pending, delivered, orphaned, expired };

// A thing owed to the world outside. The key is made before the first try and never changes.
struct outbox_row {
  std::string idempotency_key;
  std::string destination; // what kind of delivery, e.g. "progress"
  std::string body;        // JSON
  std::int64_t created_ns = 0;
  delivery_state state = delivery_state::pending;
  std::int64_t tries = 0;
  std::string last_error;
  std::int64_t next_try_ns = 0;
  std::int64_t first_failure_ns = 0; // 0 = has not failed yet
};

using commit_result = tl::expected<void, journal_error>;

// What one actor wants to become durable at once. All of it commits in one transaction, or none.
struct journal_write {
  std::string actor;
  std::uint64_t incarnation = 0;
  std::vector<event_record> events;        // consecutive
  std::optional<snapshot_record> snapshot; // replaces the older one and deletes the events that it covers
  std::vector<effect_record> effects;      // kept until released
  std::vector<effect_id> released;
  std::vector<seen_mark> seen;
  std::vector<row_change> rows;   // typed tables
  std::vector<outbox_row> outbox; // inserted, or replaced where the key is known
  std::vector<dead_letter> dead_letters;
  // Called once on the writer thread, after fdatasync returned. Must be quick and must not throw. Never called with an
  // error while the writer still tries; it is called with one when the journal closes with the write undone.
  std::function<void(const commit_result&)> done;
};

// Everything of one actor that survived: the newest snapshot, the events after it, the effects not released yet in
// their order, the marks of what it has seen.
struct recovered {
  std::optional<snapshot_record> snapshot;
  std::vector<event_record> events;
  std::vector<effect_record> effects;
  std::vector<seen_mark> seen;
  std::int64_t last_event = 0; // highest event number ever used by this actor
  std::int64_t durable_upto =
      0; // events up to here are on the disk; above it (only while the disk fails) they still wait
};

// How much of the queue's bound a write takes. Thread: pure.

// Memory, roughly; only the order of magnitude matters.
[[nodiscard]] std::size_t bytes_of(const journal_write& write);

} // namespace godwit::runtime
