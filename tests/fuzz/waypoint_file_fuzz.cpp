// Arbitrary text as a plan file; what must hold is in the harness.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/waypoint_harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  if (const auto found = godwit::io::mavlink::fuzz::check_waypoints(text)) {
    std::fprintf(stderr, "finding: %s\n", found->c_str());
    std::abort();
  }
  return 0;
}
