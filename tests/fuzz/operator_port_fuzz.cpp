// Arbitrary bytes as what a stranger says to the operator's port: as the address of a stream, as the name and the
// origin of a request, and as what comes over a WebSocket. It must end, within its bounds, and nothing of it may come
// back.
//
// The first byte says as what the rest is taken, and how it is cut on its way.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "io/http/server/websocket.hpp"
#include "programs/godwitd/operator_port/host_check.hpp"
#include "programs/godwitd/operator_port/stream_query.hpp"

namespace godwit::operator_port {
namespace {

namespace http = io::http;

void require(bool holds) {
  if (!holds)
    std::abort();
}

void read_query(std::string_view text) {
  const auto read = read_topics(text);
  if (read) {
    require(!read->empty() && read->size() <= telemetry_stream::topic_count);
    for (const auto& each : *read)
      require(each.interval_ns >= 0);
  } else {
    require(read.error().find_first_of("<>\"\\\r\n") == std::string::npos && read.error().size() < 512);
  }
}

void judge_names(std::string_view text) {
  const auto name = host_name(text);
  require(name.size() <= text.size() && text.starts_with(name));
  require(!is_ours(text, "127.0.0.1", {}) || text.size() < 32);
  if (is_same_origin(text, "localhost:1", false) && !text.empty())
    require(text.size() == std::string_view("http://localhost:1").size());
}

// A WebSocket on one end of a pair of sockets; the other end says the bytes, and goes.
void speak(std::span<const std::uint8_t> bytes, std::size_t piece_bytes) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends) != 0)
    return;
  boost::asio::io_context io;
  boost::asio::ip::tcp::socket ours(io);
  ours.assign(boost::asio::ip::tcp::v4(), ends[0]);
  const http::websocket_settings set;
  int ended = 0;
  const auto line = std::make_shared<http::websocket>(
      io, set,
      http::websocket_hooks{{},
                            [&](std::string_view text) { require(text.size() <= set.max_message_bytes); },
                            [&](const std::string&) { ++ended; }});
  http::server_request asked{"GET", "/", {}, {}};
  asked.headers = {{"Host", "x"},
                   {"Connection", "Upgrade"},
                   {"Upgrade", "websocket"},
                   {"Sec-WebSocket-Version", "13"},
                   {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="}};
  line->accept(asked, std::make_unique<http::connection>(std::move(ours)), {});
  io.poll();
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(piece_bytes, bytes.size()));
    bytes = bytes.subspan(piece.size());
    if (::send(ends[1], piece.data(), piece.size(), MSG_NOSIGNAL) < 0)
      break;
    io.restart();
    io.poll();
    std::uint8_t heard[4096];
    while (::recv(ends[1], heard, sizeof heard, 0) > 0) // so that it is never held up by us
      ;
  }
  ::close(ends[1]);
  io.restart();
  io.poll();
  line->end("the input has ended");
  io.restart();
  io.poll();
  require(ended == 1);
}

void take(std::span<const std::uint8_t> input) {
  if (input.empty())
    return;
  const auto choice = input[0];
  const auto bytes = input.subspan(1);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  switch (choice % 4) {
  case 0:
    return read_query(text);
  case 1:
    return judge_names(text);
  default:
    return speak(bytes, 1U + (choice >> 2U));
  }
}

} // namespace
} // namespace godwit::operator_port

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  godwit::operator_port::take(std::span(data, size));
  return 0;
}
