// What each part of the planner works with: the state, the time, and a place for what it asks for.
//
// A part that starts a call or a question gets a ticket; the answer comes back to that part with the same ticket.
// Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "actors/mission_client/events.hpp"
#include "actors/mission_client/retry_policy.hpp"
#include "actors/mission_client/service_port.hpp"
#include "actors/mission_client/settings.hpp"
#include "actors/mission_client/state.hpp"
#include "actors/mission_client/store_messages.hpp"
#include "runtime/random.hpp"

namespace godwit::mission_client {

using ticket = std::uint64_t; // from 1 on; 0: none

struct instant {
  std::int64_t monotonic_ns = 0;
  std::int64_t wall_ns = 0;
};

inline constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

struct requested_call {
  ticket number = 0;
  service_call call;
};

struct requested_query {
  ticket number = 0;
  store_question question;
};

struct requests {
  std::vector<requested_call> calls;
  std::vector<requested_query> questions;
  std::vector<ticket> cancelled; // nobody waits for these calls any more
  std::vector<event> events;     // for the durable core, in this order
};

class planning_context;

class part {
public:
  part() = default;
  part(const part&) = delete;
  part& operator=(const part&) = delete;
  virtual ~part() = default;

  // Starts what is to be done now; called again, it starts nothing twice.
  virtual void plan(planning_context& d) = 0;
  virtual void on_answer(planning_context& d, ticket number, const service_answer& answer) {
    (void)d;
    (void)number;
    (void)answer;
  }
  // The page of this call comes; NEXT is the place of the one after it.
  virtual void on_page_begun(planning_context& d, ticket number, const std::string& next) {
    (void)d;
    (void)number;
    (void)next;
  }
  virtual void on_store(planning_context& d, ticket number, const store_answer& answer) {
    (void)d;
    (void)number;
    (void)answer;
  }
};

// One that asks no more when the service does not allow it, until a person has acted.
class blockable_part : public part {
public:
  void free() { is_blocked_ = false; }
  [[nodiscard]] bool is_blocked() const { return is_blocked_; }

protected:
  bool is_blocked_ = false; // not allowed
};

// What outlives one turn and is common to all parts.
struct ledger {
  ticket next_ticket = 1;
  std::map<ticket, part*> waiting;             // whose answer; bounded by what the parts start
  std::map<std::string, std::string> troubles; // by kind of call: why the last one failed; a kind without is well
  std::uint64_t fetch_errors = 0;
};

class planning_context {
public:
  planning_context(const state& known, instant when, const settings& by, ledger& book, runtime::random_source& source)
      : s(known), now(when), set(by), random(source), book_(book) {}

  [[nodiscard]] ticket call(part& from, service_call what) {
    out.calls.push_back({take_ticket(from), std::move(what)});
    return out.calls.back().number;
  }
  [[nodiscard]] ticket ask(part& from, store_question what) {
    out.questions.push_back({take_ticket(from), std::move(what)});
    return out.questions.back().number;
  }
  void cancel(ticket number) {
    if (book_.waiting.erase(number) != 0)
      out.cancelled.push_back(number);
  }
  void happened(event what) { out.events.push_back(std::move(what)); }
  void wake_at(std::int64_t monotonic_ns) { wake_ns = std::min(wake_ns, monotonic_ns); }
  // The same for a time of the wall clock.
  void wake_at_wall(std::int64_t wall_ns) {
    wake_at(now.monotonic_ns + std::max<std::int64_t>(wall_ns - now.wall_ns, 0));
  }

  void went_well(const std::string& kind) { book_.troubles.erase(kind); }
  void went_wrong(const std::string& kind, std::string sentence) { book_.troubles[kind] = std::move(sentence); }
  void count_fetch_error() { ++book_.fetch_errors; }

  const state& s;
  const instant now;
  const settings& set;
  runtime::random_source& random;
  requests out;
  std::int64_t wake_ns = never_ns; // monotonic; something is due then

private:
  ticket take_ticket(part& from) {
    book_.waiting.emplace(book_.next_ticket, &from);
    return book_.next_ticket++;
  }

  ledger& book_;
};

// Whoever has no end to his tries asks about twice a minute: somebody flies, and waits for it.
inline constexpr std::uint32_t failures_that_count = 6;

// One call or question that is made again with growing pauses.
struct attempt {
  ticket waiting = 0;
  std::uint32_t failed = 0; // in a row
  std::int64_t not_before_ns = 0;

  [[nodiscard]] bool may_start(planning_context& d) const {
    if (waiting != 0)
      return false;
    if (d.now.monotonic_ns >= not_before_ns)
      return true;
    d.wake_at(not_before_ns);
    return false;
  }
  // Whether this is the answer that is waited for; it is not any more then.
  [[nodiscard]] bool ends_with(ticket number) {
    if (number != waiting)
      return false;
    waiting = 0;
    return true;
  }
  void fail(const planning_context& d, const std::string& key, std::optional<std::int64_t> retry_after_ns = {}) {
    ++failed;
    not_before_ns = d.now.monotonic_ns + pause_ns(failed, key, retry_after_ns);
  }
  void fail_without_end(const planning_context& d, const std::string& key,
                        std::optional<std::int64_t> retry_after_ns = {}) {
    failed = std::min(failed, failures_that_count - 1);
    fail(d, key, retry_after_ns);
  }
  void succeed() {
    failed = 0;
    not_before_ns = 0;
  }
  void forget(planning_context& d) {
    if (waiting != 0)
      d.cancel(waiting);
    *this = {};
  }
};

} // namespace godwit::mission_client
