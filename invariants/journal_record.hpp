// What the journal has of a flight, as far as promises are about it: plain values, whoever has read them.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/journal/records.hpp"

namespace godwit::invariants {

struct given_up_message {
  std::string actor;
  runtime::dead_letter letter;
};

struct journal_record {
  std::vector<runtime::outbox_row> outbox;           // of mission_client; delivered rows are kept for a while
  std::map<std::string, std::uint64_t> last_reports; // that mission_client has taken, by mission; the newest missions
  std::vector<runtime::effect_record> owed;          // by the executor: not confirmed by who is to take it
  std::vector<given_up_message> given_up;
};

} // namespace godwit::invariants
