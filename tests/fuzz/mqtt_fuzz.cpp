// Arbitrary bytes as what a broker of MQTT sends; what must hold is in the harness.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/mqtt_harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  if (const auto found = godwit::io::mqtt::fuzz::check_mqtt(input)) {
    std::fprintf(stderr, "finding: %s\n", found->c_str());
    std::abort();
  }
  return 0;
}
