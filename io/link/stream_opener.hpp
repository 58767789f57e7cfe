// What differs between a serial line and a TCP connection; the rest is stream_link.
//
// Errors: sentences. Thread: the link's own, but for write, which any thread may call under the link's lock.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <sys/types.h>
#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"

namespace godwit::io::link {

class stream_opener {
public:
  using result = tl::expected<descriptor, std::string>; // does not block

  stream_opener() = default;
  virtual ~stream_opener() = default;
  stream_opener(const stream_opener&) = delete;
  stream_opener& operator=(const stream_opener&) = delete;

  // DONE is called once, before this returns or later.
  virtual void open(std::function<void(result)> done) = 0;
  // As write(2), and never raises SIGPIPE.
  [[nodiscard]] virtual ssize_t write(int stream, std::span<const std::byte> bytes) const = 0;
  // Before the stream is closed, so that closing it does not wait for what the other side does not take.
  virtual void discard_output(int stream) const = 0;
  [[nodiscard]] virtual std::string where() const = 0;
  // Why it ended: ERROR is the system's number, 0 for the end of the stream.
  [[nodiscard]] virtual std::string why_it_ended(int error) const = 0;
};

} // namespace godwit::io::link
