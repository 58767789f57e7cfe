// Where one recorded actor is run again: the real actor, alone, in one thread, with every input handed to it by hand.
//
//   actor_bench bench;
//   auto handles = add_all(bench.actors());             // as the program does; nobody of them is started
//   bench.choose("executor");
//   bench.begin({.number = 1, .restored = ..., .first_id = ..., .at = ...});
//   auto done = bench.deliver(input);                   // what it sent, and how its handlers ended
//
// Nothing happens by itself: no time passes, no timer fires, no disk writes, nobody answers. What the actor sends is
// given back and reaches nobody. Ids count on from those of the record, so that each message that is sent again has the
// id that it had. Errors: sentences. Thread: one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "runtime/clock.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/system.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

struct bench_moment {
  std::int64_t monotonic_ns = 0;
  std::int64_t wall_ns = 0;
};

// What was recorded of an input.
struct bench_input {
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::string_view sender;     // name
  bool may_be_question = true; // the sender is an actor, and not a thread that can not be answered
  std::string_view type;
  std::string_view body; // JSON
  bench_moment at;
};

struct bench_incarnation {
  std::uint64_t number = 1;
  recovered restored;
  std::uint64_t first_id = 0; // of the first message that it made
  bench_moment at;
};

// A message that the actor sent.
struct bench_sending {
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::string to;
  std::string_view type;
  std::string body; // JSON
  std::int64_t delay_ns = 0;
  bool is_question = false;
  bool is_answer = false;
};

// A handler that ran.
struct bench_handling {
  std::uint64_t id = 0;
  std::string_view type;
  outcome how = outcome::handled;
};

// What came in or was done beside the mailbox.
struct handler_beside {
  std::optional<std::size_t> expected; // place in what was expected of this step; none: nothing was
  std::string produced;                // JSON of the outside_call; empty: what was expected did not happen
};

struct bench_result {
  std::vector<bench_sending> sent; // in the order of their ids
  std::vector<handler_beside> beside;
  std::vector<bench_handling> handled;
  std::string crash; // the reason, when the incarnation has ended
};

class actor_bench {
public:
  // RUN: of the record; ids and counts begin with it.
  explicit actor_bench(std::uint64_t run);
  actor_bench(const actor_bench&) = delete;
  actor_bench& operator=(const actor_bench&) = delete;
  ~actor_bench();

  // For whoever declares the actors of the program, before choose().
  [[nodiscard]] runtime::system& actors();
  [[nodiscard]] const time_source& time() const;
  [[nodiscard]] const journal& disk() const;

  // False: it was not declared.
  [[nodiscard]] bool choose(const std::string& actor);

  // A new life of the actor; the one before has ended or is ended now.
  [[nodiscard]] bench_result begin(bench_incarnation from);
  // What came in or was done beside the mailbox during the next begin() or deliver(), in order.
  [[nodiscard]] tl::expected<void, std::string> expect_observed(std::string_view type, std::string_view body);
  [[nodiscard]] tl::expected<bench_result, std::string> deliver(const bench_input& input);
  // What the actor sent as SENT was RECORDED: an answer to that is one to this.
  void note_recorded_id(std::uint64_t sent, std::uint64_t recorded);
  // Its next message has this id.
  void continue_ids_from(std::uint64_t id);

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

// The private parts of the bench: its time, disk and record. For runtime/replay alone.
class bench_time final : public time_source {
public:
  void set(const bench_moment& to) { now_ = to; }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return now_.monotonic_ns; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return now_.wall_ns; }

private:
  bench_moment now_;
};

// Takes every write, keeps none, and never says that one is on the disk: the record does.
class bench_journal final : public journal {
public:
  explicit bench_journal(std::uint64_t run) : run_(run) {}
  [[nodiscard]] tl::expected<void, journal_error> submit(journal_write&& write) override {
    const auto taken = std::exchange(write, {});
    return {};
  }
  void recover(std::string, std::uint64_t, recovered_callback) override {}
  [[nodiscard]] journal_status status() const override {
    journal_status result;
    result.run = run_;
    return result;
  }

private:
  const std::uint64_t run_;
};

// How handlers ended.
class bench_record final : public trace_sink {
public:
  [[nodiscard]] std::int64_t ticks() const noexcept override { return 0; }
  void record(const trace_entry& entry, const message_type& type, const void*) noexcept override {
    if (&type != &type_of<restored>())
      handled_.push_back({entry.id, type.name, entry.how});
  }
  [[nodiscard]] std::vector<bench_handling> take() { return std::exchange(handled_, {}); }

private:
  std::vector<bench_handling> handled_;
};

} // namespace godwit::runtime
