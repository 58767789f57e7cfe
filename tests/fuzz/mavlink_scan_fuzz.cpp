// Arbitrary bytes as a stream of MAVLink; what must hold is in the harness.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/scan_harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const auto found = godwit::io::mavlink::fuzz::check(std::as_bytes(std::span{data, size}))) {
    std::fprintf(stderr, "finding: %s\n", found->c_str());
    std::abort();
  }
  return 0;
}
