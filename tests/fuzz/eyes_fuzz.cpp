// What godwit-eyes says to the daemon: whatever comes is a sound message or an error.
#include <cstdint>
#include <cstdlib>

#include "io/eyes/codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace godwit::io::eyes;
  const auto read = decode(std::as_bytes(std::span(data, size)));
  if (!read)
    return 0;
  if (!problem_of(*read).empty())
    std::abort();
  const auto text = encode(*read);
  if (!decode(std::as_bytes(std::span(text))))
    std::abort();
  return 0;
}
