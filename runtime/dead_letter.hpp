// A message that its handler could not take, as the dead-letter table keeps it for people to read. Thread: pure.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/envelope.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

// The body as JSON, secrets left out; {"too_long":true} where it is longer than what the table keeps.
[[nodiscard]] dead_letter make_dead_letter(const envelope& m, std::int64_t at_ns, std::string sender, int crashes,
                                           std::string reason);

} // namespace godwit::runtime
