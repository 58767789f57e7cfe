// Arbitrary bytes as an MCAP file: the readers and the repair must end, within their bounds, and agree.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "io/mcap/file_summary.hpp"
#include "io/mcap/repair.hpp"
#include "io/mcap/salvage_reader.hpp"
#include "tests/support/strict_mcap_reader.hpp"

namespace godwit::io::mcap {
namespace {

struct ending {
  bool complete = false;
  std::uint64_t messages = 0;
};

ending read(byte_view bytes) {
  const memory_source source{bytes};
  strict_mcap_reader reader{source};
  ending seen;
  for (;;) {
    const auto item = reader.next();
    if (!item || std::holds_alternative<truncated>(*item)) {
      return seen;
    }
    if (std::holds_alternative<end_of_file>(*item)) {
      seen.complete = true;
      return seen;
    }
    seen.messages += std::holds_alternative<message_record>(*item) ? 1 : 0;
  }
}

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

// Where the strict reader comes to the end, the other one finds no less.
void salvage(byte_view bytes, const ending& strict) {
  const memory_source source{bytes};
  static_cast<void>(read_summary(source));
  salvage_reader reader{source};
  std::uint64_t messages = 0;
  for (;;) {
    const auto item = reader.next();
    require(item.has_value());
    if (std::holds_alternative<end_of_file>(*item)) {
      break;
    }
    messages += std::holds_alternative<message_record>(*item) ? 1 : 0;
  }
  require(messages >= strict.messages || !strict.complete);
}

} // namespace

static void read_and_complete(byte_view bytes) {
  salvage(bytes, read(bytes));
  const memory_source source{bytes};
  static_cast<void>(has_end(source));
  const auto plan = plan_completion(source);
  if (!plan) {
    return;
  }
  // What a repair makes must be complete for the reader, with the messages that the repair counted, and stay as it is.
  byte_buffer completed(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(plan->keep_bytes));
  append_bytes(completed, plan->tail);
  const ending seen = read(completed);
  require(seen.complete && seen.messages == plan->messages);
  const memory_source again{completed};
  require(has_end(again).value_or(false));
}

} // namespace godwit::io::mcap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  godwit::io::mcap::read_and_complete(std::as_bytes(std::span{data, size}));
  return 0;
}
