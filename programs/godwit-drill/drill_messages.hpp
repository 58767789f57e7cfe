// What the actors of the runtime drill say to each other.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "runtime/define_message.hpp"
#include "runtime/seam.hpp"

namespace godwit::drill {

// One of the messages that are counted, numbered from 1 over all senders.
struct work {
  std::uint32_t sender = 0;
  std::uint64_t seq = 0;
  bool poison = false; // crashes its handler each time
  GODWIT_FIELDS(work, "drill.work", sender, seq, poison);
};

// It has been handled; for one with a durable effect: and the effect is on the disk.
struct receipt {
  std::uint32_t sender = 0;
  std::uint64_t seq = 0;
  GODWIT_FIELDS(receipt, "drill.receipt", sender, seq);
};

// Every tenth message has a durable effect: a row (sender, seq) of the table drill_effect.
inline constexpr std::uint64_t durable_every = 10;

constexpr bool is_durable(std::uint64_t seq) { return seq % durable_every == 0; }

using auditor_handle = runtime::mailbox<runtime::tells<receipt>>;
using worker_handle = runtime::mailbox<runtime::tells<work>>;

} // namespace godwit::drill
