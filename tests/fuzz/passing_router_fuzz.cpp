// Stations, the vehicle's components and an executor that say anything in any order to a port that passes on, with its
// real lists and budgets. The harness says what must hold.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/passing_router_harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const auto* const found = godwit::ground_port::fuzz::run({data, size}).play()) {
    std::fprintf(stderr, "finding: %s\n", found);
    std::abort();
  }
  return 0;
}
