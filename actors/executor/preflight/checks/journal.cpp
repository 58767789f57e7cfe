#include "actors/executor/preflight/checks/journal.hpp"

namespace godwit::executor::preflight {

result look_at_journal(const facts& seen, const settings&) {
  if (!seen.journal.is_sound)
    return fail(
        "The journal did not pass its integrity check; move the file away and start again, or take a new disk.");
  if (!seen.journal.is_writable)
    return fail("The journal can not be written; look at the disk: whether it is full, broken or read-only.");
  if (seen.journal.is_nearly_full)
    return fail(
        "The journal's disk is too slow: what waits to be written is near its bound; wait, or take another disk.");
  return pass("The journal is sound and can be written.");
}

} // namespace godwit::executor::preflight
