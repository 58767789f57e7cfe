// Stations that say anything in any order to a mission server; what must hold is in the harness.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/mission_server_harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const auto found = godwit::ground_port::mission_server::fuzz::run<>({data, size}).play()) {
    std::fprintf(stderr, "finding: %s\n", found->c_str());
    std::abort();
  }
  return 0;
}
