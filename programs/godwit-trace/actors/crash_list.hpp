// The crashes in a trace: which actor, on which message, with what in front of it, and how it went on.
//
// Found in the deliveries that ended `crashed`, and in what the guardian tells of its children (runtime.child_event),
// which also knows crashes outside of a handler, kills, and the exception's text. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::trace_tool {

// A delivery with a body of its own.
struct kept {
  runtime::delivery what;
  std::string body;
  explicit kept(const runtime::delivery& each) : what(each), body(each.body) {}
};

// What an incarnation began with (runtime.restored).
struct restored_state {
  std::uint64_t bytes = 0;
  std::int64_t last_event = 0;
  std::size_t effects = 0; // that had not gone out
  bool is_known = false;   // else it is too large to be shown
};

struct crash {
  std::uint64_t run = 0;
  std::string actor;
  std::uint64_t incarnation = 0;
  std::int64_t at_ns = 0;
  std::string reason;                     // the exception's text; empty: nobody told
  std::optional<kept> crashed_on;         // absent: not in a handler, or the trace does not have it
  std::vector<kept> before;               // what the actor took before that, the newest last
  std::optional<restored_state> restored; // what the next incarnation began with
  std::optional<kept> first_after;        // of the next incarnation
  std::uint64_t delivered_again = 0;      // how often the message was given to later incarnations
  std::string last_delivery_ended;        // of these, the newest: how it ended
};

class crash_list {
public:
  static constexpr std::size_t max_crashes = 1'000;

  // Keeps BEFORE deliveries of each actor.
  crash_list(const runtime::name_table& names, std::size_t before) : names_(names), before_(before) {}

  // In the order of time.
  void add(const runtime::delivery& each);

  [[nodiscard]] const std::vector<crash>& crashes() const { return crashes_; }
  [[nodiscard]] std::uint64_t not_kept() const { return not_kept_; }

private:
  struct actor_history {
    std::uint64_t run = 0;
    std::deque<kept> newest;
    std::vector<std::size_t> open; // crashes that wait for the next incarnation
  };
  void take_event(const runtime::delivery& each);
  crash* crash_of(std::uint64_t run, const std::string& actor, std::uint64_t incarnation);
  crash* begin_crash(const runtime::delivery& each, const std::string& actor, std::uint64_t incarnation);
  void close(const runtime::delivery& each, actor_history& history);
  void take_restored(const runtime::delivery& each, const actor_history& history);

  const runtime::name_table& names_;
  std::size_t before_;
  std::map<std::string, actor_history> actors_;
  std::vector<crash> crashes_;
  std::uint64_t not_kept_ = 0;
};

} // namespace godwit::trace_tool
