#include "io/link/link.hpp"

#include <optional>

#include "io/link/io_thread.hpp"
#include "io/link/serial_port.hpp"
#include "io/link/stream_link.hpp"
#include "io/link/tcp_in_link.hpp"
#include "io/link/tcp_opener.hpp"
#include "io/link/udp_in_link.hpp"
#include "io/link/udp_out_link.hpp"

namespace godwit::io::link {
namespace {

constexpr std::size_t largest_datagram = 65'507; // a queue must take what UDP takes, or no sender could rely on a size
constexpr std::size_t largest_queue = 64 * 1024 * 1024;
constexpr std::size_t most_peers = 1'024; // they are searched one by one for each datagram

bool bad_cap(std::chrono::milliseconds cap, const link_options& options, std::chrono::milliseconds most) {
  return cap < options.first_retry || cap > most;
}

std::optional<std::string> mistake_in(const uri& where, const link_callbacks& callbacks, const link_options& options) {
  using std::chrono::milliseconds;
  if (const auto read_back = parse_uri(where.text()); !read_back)
    return read_back.error();
  else if (*read_back != where)
    return where.text() + ": not a link that a URI can name";
  if (!callbacks.received)
    return "nobody takes what the link receives";
  if (options.first_retry < milliseconds{1} || bad_cap(options.serial_retry_cap, options, max_serial_retry) ||
      bad_cap(options.udp_retry_cap, options, max_network_retry) ||
      bad_cap(options.tcp_retry_cap, options, max_network_retry))
    return "the first retry must come after 1 ms or more, and no cap may be below it, nor above 2 s for a serial line "
           "and 5 s for UDP and TCP";
  if (options.connect_timeout < milliseconds{1} || options.forget_peer_after < milliseconds{1})
    return "the time-outs of a link must be 1 ms or more";
  if (options.send_queue_bytes < largest_datagram || options.send_queue_bytes > largest_queue)
    return "the send queue must have from 65507 bytes to 64 MiB";
  if (options.max_peers < 1 || options.max_peers > most_peers)
    return "a link must have from 1 to 1024 peers";
  return std::nullopt;
}

std::unique_ptr<link> make(const uri& where, link_callbacks callbacks, const link_options& options) {
  switch (where.which) {
  case uri::kind::udp_in:
    return std::make_unique<udp_in_link>(where, std::move(callbacks), options);
  case uri::kind::udp_out:
    return std::make_unique<udp_out_link>(where, std::move(callbacks), options);
  case uri::kind::serial:
    return std::make_unique<stream_link>(
        where, std::move(callbacks), options, options.serial_retry_cap,
        [&](boost::asio::io_context&) { return std::make_unique<serial_opener>(where); });
  case uri::kind::tcp:
    return std::make_unique<stream_link>(
        where, std::move(callbacks), options, options.tcp_retry_cap,
        [&](boost::asio::io_context& io) { return std::make_unique<tcp_opener>(io, where, options.connect_timeout); });
  case uri::kind::tcp_in:
    return std::make_unique<tcp_in_link>(where, std::move(callbacks), options);
  }
  return nullptr;
}

// A link on a thread that goes on after it: it ends inside that thread, between two handlers.
class link_among_others final : public link {
public:
  link_among_others(std::shared_ptr<io_thread> thread, std::unique_ptr<link> one)
      : thread_(std::move(thread)), one_(std::move(one)) {}
  ~link_among_others() override {
    thread_->run_inside([this] { one_.reset(); });
  }

  bool send(std::span<const std::byte> bytes, peer_id to) override { return one_->send(bytes, to); }
  [[nodiscard]] link_counters counters() const override { return one_->counters(); }
  [[nodiscard]] std::string description() const override { return one_->description(); }

private:
  std::shared_ptr<io_thread> thread_;
  std::unique_ptr<link> one_;
};

} // namespace

tl::expected<std::unique_ptr<link>, std::string> open_link(const uri& where, link_callbacks callbacks,
                                                           link_options options) {
  if (auto wrong = mistake_in(where, callbacks, options))
    return tl::make_unexpected(*std::move(wrong));
  try {
    auto made = make(where, std::move(callbacks), options);
    if (options.thread == nullptr)
      return made;
    return std::make_unique<link_among_others>(std::move(options.thread), std::move(made));
  } catch (const std::exception& failure) {
    // What Asio and the standard library throw here comes from the system: no thread or no descriptor left.
    return tl::make_unexpected(where.text() + ": the system refused a thread or a descriptor: " + failure.what());
  }
}

} // namespace godwit::io::link
