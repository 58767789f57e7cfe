// What is said to and by fleet_link. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "io/mqtt/failure.hpp"

namespace godwit::fleet_link {

using broker_failure = io::mqtt::failure;

// -- from the port. ATTEMPT: which connection; one that is not the newest is old.

struct broker_opened {
  std::uint64_t attempt = 0;
  std::uint32_t max_packet_bytes = 1024 * 1024; // of a message with its topic: what the broker takes
  GODWIT_FIELDS(broker_opened, "fleet_link.broker_opened", attempt, max_packet_bytes);
};

struct broker_closed {
  std::uint64_t attempt = 0;
  broker_failure why = broker_failure::lost;
  std::string sentence;
  GODWIT_FIELDS(broker_closed, "fleet_link.broker_closed", attempt, why, sentence);
};

// The broker has the event of this number.
struct event_taken {
  std::uint64_t attempt = 0;
  std::uint64_t number = 0;
  GODWIT_FIELDS(event_taken, "fleet_link.event_taken", attempt, number);
};

// One more of what is not acknowledged has left for the network.
struct text_left {
  std::uint64_t attempt = 0;
  GODWIT_FIELDS(text_left, "fleet_link.text_left", attempt);
};

// -- for people

// Answered from memory, at once.
struct get_fleet {
  static constexpr auto fields = io::table("fleet_link.get_fleet");
};

struct fleet_view {
  bool is_connected = false;
  std::string broker;
  std::string vehicle;          // as it is called there
  std::string sentence;         // why not, and what to do; empty: connected
  std::int64_t next_try_ms = 0; // from now; 0: connected, or a try is under way
  std::uint64_t waiting = 0;    // events that the broker does not have
  std::uint64_t delivered = 0;  // events, since the journal began
  std::uint64_t dropped = 0;    // the same: there was no room for them any more
  std::uint64_t connects = 0;   // these are of this incarnation
  std::uint64_t failures = 0;
  std::uint64_t texts = 0;     // of what is live
  std::uint64_t skipped = 0;   // of it: the network was too slow, and a newer one went out instead
  std::uint64_t too_large = 0; // for the broker: of what is live, not sent; of events, sent without data
  GODWIT_FIELDS(fleet_view, "fleet_link.fleet_view", is_connected, broker, vehicle, sentence, next_try_ms, waiting,
                delivered, dropped, connects, failures, texts, skipped, too_large);
};

} // namespace godwit::fleet_link
