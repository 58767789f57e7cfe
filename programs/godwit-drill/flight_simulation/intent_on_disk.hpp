// What the executor has on the disk of what it means to do, as a process would find it that begins now. Thread: pure.
#pragma once

#include "runtime/journal/records.hpp"

namespace godwit::drill {

struct intent_on_disk {
  bool brings_plan = false; // an upload is intended, and its end is not known
  bool starts = false;      // the same of a start
};

// EXECUTOR: what the journal has of it.
[[nodiscard]] intent_on_disk read_intent(const runtime::recovered& executor);

} // namespace godwit::drill
