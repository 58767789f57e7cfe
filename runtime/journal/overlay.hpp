// What a write will do to the recovered state of its actor, in memory: the database's answer plus this, for each write
// that still waits, is what the database will answer once they are committed.
//
// Pure. Thread: any.
#pragma once

#include "runtime/journal/records.hpp"

namespace godwit::runtime {

void lay_over(recovered& base, const journal_write& write);

} // namespace godwit::runtime
