// What each declared actor of a system has counted of its mail, and how much of it waits now. Thread: any, once the
// system is started.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/address/address_options.hpp"

namespace godwit::runtime {

class system;

struct mail_view {
  std::string actor;
  std::uint64_t waiting = 0; // now, in the mailbox or parked
  address_counters counted;
};

// In the order in which they were declared.
[[nodiscard]] std::vector<mail_view> look_at_mail(const system& actors);

} // namespace godwit::runtime
