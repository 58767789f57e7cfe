// A link over one stream of bytes: a serial line or a TCP connection, whichever the opener opens.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <sys/types.h>
#include <tl/expected.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/descriptor.hpp"
#include "io/link/io_thread.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/liveness.hpp"
#include "io/link/open_stream.hpp"

namespace godwit::io::link {

// What differs between a serial line and a TCP connection; the rest is stream_link.
//
// Errors: sentences. Thread: the link's own, but for write, which any thread may call under the link's lock.
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

class stream_link final : public link {
public:
  using make_opener = std::function<std::unique_ptr<stream_opener>(boost::asio::io_context&)>;

  stream_link(const uri& where, link_callbacks callbacks, const link_options& options,
              std::chrono::milliseconds retry_cap, const make_opener& opener);
  ~stream_link() override { thread_.stop(); }

  bool send(std::span<const std::byte> bytes, peer_id to) override;
  [[nodiscard]] link_counters counters() const override;
  [[nodiscard]] std::string description() const override { return where_.text(); }

private:
  void open();
  void opened(descriptor stream);
  [[nodiscard]] open_stream::hooks hooks();

  uri where_;
  std::function<void(peer_id, std::span<const std::byte>, bool)> received_;
  counter_set counters_;
  link_thread thread_;
  std::unique_ptr<stream_opener> opener_;
  lifecycle life_;
  open_stream stream_;
  liveness alive_;
};

} // namespace godwit::io::link
