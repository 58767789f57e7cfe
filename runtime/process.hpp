// Everything that a program with actors owns, made in one order and taken down in the other:
// names and health, journal, trace, actors; then actors, trace, journal.
//
//   auto host = process::open(options);
//   if (!host) { print(host.error()); return 1; }
//   auto log = (*host)->actors().add<flight_log>({.name = "flight_log"}, {});
//   (*host)->actors().start();
//   ...
//   return (*host)->finish(0);
//
// Thread: one owner.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "runtime/clock.hpp"
#include "runtime/crash_points.hpp"
#include "runtime/directory.hpp"
#include "runtime/health_board.hpp"
#include "runtime/journal/sqlite_journal.hpp"
#include "runtime/system.hpp"
#include "runtime/trace/ring_trace.hpp"

namespace godwit::runtime {

// What a program says to its service manager when it ends. 2 is a mistake on the command line or in the configuration.
enum class exit_code : int {
  ok = 0,
  failed = 1, // it could not do what it was asked; the reason stands on stderr
  usage = 2,
  essential_given_up = 70, // an essential actor crashed too often: start the process again
  unresponsive = 71,       // an essential actor, or all workers, hang in a handler: start the process again
  unknown_state = 72,      // what is on disk can not be trusted or read: a person has to look before the next start
};

[[nodiscard]] exit_code exit_code_for(exit_cause cause);

struct process_options {
  journal_options journal;
  std::optional<trace_options> trace; // run is filled in from the journal
  system_options actors;
  std::uint64_t seed = 0;
  crash_points* crashes = nullptr;
};

// The options that a configuration document (config/godwit.schema.json, complete with defaults) stands for.
[[nodiscard]] process_options options_from(const nlohmann::json& configuration);

class process {
public:
  // The error is a sentence for people: what is wrong, where, what to do.
  [[nodiscard]] static tl::expected<std::unique_ptr<process>, std::string> open(process_options options);
  process(const process&) = delete;
  process& operator=(const process&) = delete;
  ~process();

  [[nodiscard]] runtime::system& actors() { return *actors_; }
  [[nodiscard]] sqlite_journal& journal() { return *journal_; }
  [[nodiscard]] health_board& health() { return health_; }
  // How the journal is, told to the health board as well: a disk that hangs says nothing itself, and what waits for it
  // grows. To be called now and then.
  journal_status look_at_journal();
  [[nodiscard]] trace_counts traced() const { return trace_ ? trace_->counts() : trace_counts{}; }
  [[nodiscard]] const time_source& time() const { return time_; }

  // Stops the actors in reverse order, then the trace, then the journal. Returns CODE; where an actor hangs for good
  // the process leaves from here with that code, because its thread can not be joined.
  int finish(int code);

private:
  process() = default;

  system_time time_;
  directory names_;
  health_board health_;
  std::unique_ptr<sqlite_journal> journal_;
  std::unique_ptr<ring_trace> trace_;
  std::unique_ptr<runtime::system> actors_;
};

} // namespace godwit::runtime
