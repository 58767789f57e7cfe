#include "actors/executor/preflight/checks/free_space.hpp"

#include <string>

namespace godwit::executor::preflight {

namespace {

constexpr std::uint64_t bytes_per_mib = 1024 * 1024;

bool is_below(std::uint64_t bytes, std::int64_t limit_mib) {
  return limit_mib > 0 && bytes / bytes_per_mib < static_cast<std::uint64_t>(limit_mib);
}

std::string sentence_of(std::int64_t limit_mib) {
  return "Less than " + std::to_string(limit_mib) +
         " MiB are free on the disk of the journal; delete what is not needed.";
}

} // namespace

result look_at_free_space(const facts& seen, const settings& set) {
  if (!seen.journal.free_bytes)
    return degraded("It is not known how much is free on the disk of the journal; look at it yourself.");
  if (is_below(*seen.journal.free_bytes, set.journal_min_free_mib))
    return fail(sentence_of(set.journal_min_free_mib));
  if (is_below(*seen.journal.free_bytes, set.journal_low_free_mib))
    return degraded(sentence_of(set.journal_low_free_mib));
  return pass("The disk of the journal has room.");
}

} // namespace godwit::executor::preflight
