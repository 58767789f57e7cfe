// One end of the socket pair between the daemon and its eyes. A datagram is a message (codec.hpp).
//
// It never blocks: what does not fit into the socket is not sent, and the caller says so or says it anew later; poses
// and statuses are out of date in a moment anyway. Errors: values. Thread: send from any, receive from one.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "io/eyes/codec.hpp"
#include "io/link/descriptor.hpp"

namespace godwit::io::eyes {

enum class send_result { sent, no_room, closed };

struct received {
  std::optional<message> said; // nothing: no more is there now
  bool is_closed = false;      // the other side is gone
};

class channel {
public:
  // SOCKET: SOCK_SEQPACKET.
  explicit channel(link::descriptor socket) : socket_(std::move(socket)), buffer_(max_datagram_bytes + 1) {}

  [[nodiscard]] send_result send(const message& said) const;
  // The next one. The error is that of a datagram that is none; the ones after it can be read all the same.
  [[nodiscard]] tl::expected<received, decode_error> receive();
  [[nodiscard]] int number() const { return socket_.number(); }

private:
  link::descriptor socket_;
  std::vector<std::byte> buffer_;
};

// Both ends; the error is a sentence.
[[nodiscard]] tl::expected<std::pair<channel, channel>, std::string> make_channel_pair();

} // namespace godwit::io::eyes
