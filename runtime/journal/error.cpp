#include "runtime/journal/error.hpp"

namespace godwit::runtime {

std::string journal_error::message() const { return "journal " + file + ": " + what + ". " + remedy; }

const char* to_string(journal_errc code) {
  switch (code) {
  case journal_errc::locked:
    return "locked";
  case journal_errc::missing:
    return "missing";
  case journal_errc::foreign:
    return "foreign";
  case journal_errc::newer:
    return "newer";
  case journal_errc::corrupt:
    return "corrupt";
  case journal_errc::read_only:
    return "read_only";
  case journal_errc::disk_full:
    return "disk_full";
  case journal_errc::io:
    return "io";
  case journal_errc::queue_full:
    return "queue_full";
  case journal_errc::stale_incarnation:
    return "stale_incarnation";
  case journal_errc::closed:
    return "closed";
  }
  return "unknown";
}

} // namespace godwit::runtime
