// How much of the queue's bound a write takes. Thread: pure.
#pragma once

#include <cstddef>

#include "runtime/journal/records.hpp"

namespace godwit::runtime {

// Memory, roughly; only the order of magnitude matters.
[[nodiscard]] std::size_t bytes_of(const journal_write& write);

} // namespace godwit::runtime
