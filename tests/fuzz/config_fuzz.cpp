// Any bytes as a configuration: an error with a sentence, or a complete and valid document; never a crash, never slow.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/config/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto loaded = godwit::runtime::load_config(text, "fuzz", godwit::runtime::godwit_schema());
  if (!loaded) {
    if (loaded.error().problems.empty() || loaded.error().message().empty())
      std::abort();
    return 0;
  }
  // What was accepted is complete, and is accepted again without a change.
  const auto again = godwit::runtime::load_config(loaded->dump(), "again", godwit::runtime::godwit_schema());
  if (!again || *again != *loaded || !loaded->at("supervision").at("ping_period_ms").is_number_integer())
    std::abort();
  return 0;
}
