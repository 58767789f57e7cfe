// What has to be done next is a function of the durable state: this finds it, and makes events of the answers.
//
//   state, time ──> plan() ──> calls to the service, questions to the map store, events, when to wake up
//   answers ──────> on_answer(), on_store() ──> events for the durable core, further calls
//
// It holds only what may be forgotten: what is under way, and how often it failed in this life. Give it the events that
// it asked for before it plans again. Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "actors/mission_client/asking_next.hpp"
#include "actors/mission_client/fetching.hpp"
#include "actors/mission_client/outbox/backlog.hpp"
#include "actors/mission_client/outbox/deliveries.hpp"
#include "actors/mission_client/planning_context.hpp"
#include "actors/mission_client/polling.hpp"
#include "actors/mission_client/pulling.hpp"
#include "runtime/condition.hpp"

namespace godwit::mission_client {

class planner {
public:
  // SEED: another one in each life, so that no key is made twice.
  planner(settings configured, std::uint64_t seed) : settings_(configured), random_(seed) {}

  [[nodiscard]] requests plan(const state& s, instant now);
  [[nodiscard]] requests on_answer(const state& s, instant now, ticket number, const service_answer& answer);
  [[nodiscard]] requests on_store(const state& s, instant now, ticket number, const store_answer& answer);
  void on_disk(const mission_client::on_disk& news);

  // Monotonic; of the last plan().
  [[nodiscard]] std::int64_t wake_ns() const { return wake_ns_; }
  [[nodiscard]] service_status status(const state& s) const;
  [[nodiscard]] runtime::condition health(const state& s) const;

private:
  [[nodiscard]] part* take_waiting(ticket number);
  // Of all kinds of call that begin so.
  [[nodiscard]] std::string last_error(std::string_view kinds = {}) const;

  settings settings_;
  runtime::random_source random_;
  ledger book_;
  deliveries deliveries_;
  backlog backlog_{deliveries_};
  store_operations store_operations_{backlog_};
  asking_next asking_next_;
  fetching fetching_;
  asking_progress asking_progress_;
  looking_up looking_up_;
  pulling pulling_;
  polling polling_;
  std::int64_t wake_ns_ = never_ns;
  connection_state connection_ = connection_state::unknown;
};

} // namespace godwit::mission_client
