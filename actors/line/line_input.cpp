#include "actors/line/line_input.hpp"

#include <charconv>

#include "io/fields/hex_text.hpp"
#include "runtime/define_message.hpp"
#include "runtime/overloaded.hpp"

GODWIT_DEFINE_MESSAGE(godwit::line::line_input);
GODWIT_DEFINE_MESSAGE(godwit::line::line_drops);

namespace godwit::line {

line_input line_input::of(const line_news& news) {
  line_input result;
  std::visit(runtime::overloaded{[&](const io::link::link_status& status) {
                                   result.is_status = true;
                                   result.phase = status.phase;
                                   result.reason = status.reason;
                                   result.reconnects = status.reconnects;
                                 },
                                 [&](const io::link::arrival& came) {
                                   result.peer = came.peer;
                                   result.is_datagram = came.is_datagram;
                                   result.bytes = io::hex_of(came.bytes);
                                 }},
             news);
  return result;
}

line_news line_input::news() const {
  if (is_status)
    return io::link::link_status{phase, reason, reconnects};
  io::link::arrival result{peer, is_datagram, {}};
  for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2) {
    std::uint8_t byte = 0;
    (void)std::from_chars(bytes.data() + at, bytes.data() + at + 2, byte, 16);
    result.bytes.push_back(std::byte{byte});
  }
  return result;
}

} // namespace godwit::line
