// What must hold for any bytes that a broker sends; the fuzzer tries bytes, and a test plants defects to show that they
// are found.
//
//   - the reader gives the packets that a second reading of the standard finds, and refuses where that refuses: it is
//     written down here without the first, byte for byte and without a table of its own forms;
//   - it gives the same in pieces of each size, and holds no more than 4 KiB;
//   - the session ends by itself when nothing more comes; it reports `closed` once and last, each message once, and no
//     more of them wait for an acknowledgement than the broker bears.
//
// Reader and session are passed in as types. Thread: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/mqtt/cursor.hpp"
#include "io/mqtt/decoder.hpp"
#include "io/mqtt/session.hpp"

namespace godwit::io::mqtt::fuzz {

using finding = std::optional<std::string>;

// -- the second reading

struct judged {
  std::size_t packets = 0;
  bool is_refused = false;
  int receive_maximum = 65'535; // of the first CONNACK
};

inline std::uint8_t byte_at(std::string_view bytes, std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); }

// How long the value of a property is; 0: it must not be there, or is not whole.
inline std::size_t value_size(int type, int which, std::string_view rest) {
  const auto text = [&](std::size_t from) -> std::size_t {
    if (rest.size() < from + 2)
      return 0;
    const std::size_t size = byte_at(rest, from) * 256U + byte_at(rest, from + 1);
    return rest.size() < from + 2 + size || !is_mqtt_text(rest.substr(from + 2, size)) ? 0 : 2 + size;
  };
  if (which == 0x1F)
    return text(0);
  if (which == 0x26)
    return text(0) == 0 || text(text(0)) == 0 ? 0 : text(0) + text(text(0));
  if (which == 0x1C && type != 4)
    return text(0);
  if (type != 2)
    return 0;
  switch (which) {
  case 0x11:
    return 4;
  case 0x27:
    return rest.size() >= 4 && rest.substr(0, 4) == std::string_view("\0\0\0\0", 4) ? 0 : 4;
  case 0x13:
  case 0x22:
    return 2;
  case 0x21:
    return rest.size() >= 2 && rest.substr(0, 2) == std::string_view("\0\0", 2) ? 0 : 2;
  case 0x24:
  case 0x25:
  case 0x28:
  case 0x29:
  case 0x2A:
    return !rest.empty() && byte_at(rest, 0) > 1 ? 0 : 1;
  default:
    return 0;
  }
}

inline bool are_sound(int type, std::string_view bytes, judged& to) {
  std::size_t length = 0;
  std::size_t head = 0;
  for (;; ++head) {
    if (head == bytes.size() || head == 4)
      return false;
    length += std::size_t{byte_at(bytes, head)} % 128 << 7 * head;
    if (byte_at(bytes, head) < 128)
      break;
  }
  if ((head > 0 && byte_at(bytes, head) == 0) || length != bytes.size() - head - 1)
    return false;
  std::set<int> seen;
  for (auto rest = bytes.substr(head + 1); !rest.empty();) {
    const int which = byte_at(rest, 0);
    rest.remove_prefix(1);
    const auto size = value_size(type, which, rest);
    if (size == 0 || size > rest.size() || (!seen.insert(which).second && which != 0x26))
      return false;
    if (which == 0x21 && to.packets == 0)
      to.receive_maximum = byte_at(rest, 0) * 256 + byte_at(rest, 1);
    rest.remove_prefix(size);
  }
  return true;
}

inline bool is_sound(int type, std::string_view body, judged& to) {
  switch (type) {
  case 2:
    if (body.size() < 2)
      return false;
    if (body.size() == 2)
      return body[1] != '\0';
    return body[0] == '\0' && (body[1] == '\0' || byte_at(body, 1) >= 0x80) && are_sound(type, body.substr(2), to);
  case 4:
    if (body.size() < 2 || body.substr(0, 2) == std::string_view("\0\0", 2))
      return false;
    if (body.size() == 2)
      return true;
    return (body[2] == '\0' || byte_at(body, 2) == 0x10 || byte_at(body, 2) >= 0x80) &&
           (body.size() == 3 || are_sound(type, body.substr(3), to));
  case 13:
    return body.empty();
  default:
    return body.size() < 2 || are_sound(type, body.substr(1), to);
  }
}

inline judged judge(std::string_view bytes) {
  judged result;
  while (!bytes.empty()) {
    const int type = byte_at(bytes, 0) / 16;
    result.is_refused = byte_at(bytes, 0) % 16 != 0 || (type != 2 && type != 4 && type != 13 && type != 14);
    if (result.is_refused || bytes.size() < 2)
      return result;
    std::size_t length = byte_at(bytes, 1) % 128;
    std::size_t head = 2;
    if (byte_at(bytes, 1) >= 128) {
      if (bytes.size() < 3 && type != 13)
        return result; // the second byte of its length is not there
      if (bytes.size() < 3) {
        result.is_refused = length > 0;
        return result;
      }
      length += byte_at(bytes, 2) * 128U;
      head = 3;
      result.is_refused = byte_at(bytes, 2) == 0 || byte_at(bytes, 2) >= 128;
    }
    result.is_refused = result.is_refused || length > max_packet_bytes - 3 || (type == 13 && length > 0) ||
                        ((type == 2 || type == 4) && length < 2);
    if (result.is_refused || bytes.size() < head + length)
      return result;
    result.is_refused = !is_sound(type, bytes.substr(head, length), result);
    if (result.is_refused)
      return result;
    ++result.packets;
    bytes.remove_prefix(head + length);
  }
  return result;
}

// -- the reader

template <class Reader>
finding check_reader(std::string_view bytes, std::size_t piece_bytes, const judged& expected) {
  Reader reader;
  std::size_t packets = 0;
  for (auto rest = bytes; !rest.empty();) {
    auto piece = rest.substr(0, piece_bytes);
    rest.remove_prefix(piece.size());
    for (;;) {
      const auto next = reader.read(piece);
      if (reader.held_bytes() > max_packet_bytes)
        return "more than 4 KiB are held";
      if (!next) {
        const bool is_right = expected.is_refused && packets == expected.packets && !next.error().sentence.empty();
        return is_right ? finding() : "refused what is sound: " + next.error().sentence;
      }
      if (!*next)
        break;
      if (++packets > bytes.size())
        return "packets without bytes";
    }
    if (!piece.empty())
      return "bytes were left";
  }
  if (expected.is_refused || packets != expected.packets)
    return "taken what is not sound";
  return {};
}

// -- the session

// The publisher's packets, as far as it matters here: QoS 1 counts.
inline std::size_t acknowledged_in(std::string_view sent) {
  std::size_t result = 0;
  while (!sent.empty()) {
    std::size_t length = 0;
    std::size_t head = 1;
    for (std::size_t shift = 0;; shift += 7) {
      length += std::size_t{byte_at(sent, head)} % 128 << shift;
      if (byte_at(sent, head++) < 128)
        break;
    }
    result += (byte_at(sent, 0) & 0xF6U) == 0x32U ? 1 : 0;
    sent.remove_prefix(head + length);
  }
  return result;
}

template <class Session>
class observed {
public:
  explicit observed(int receive_maximum) : receive_maximum_(static_cast<std::size_t>(receive_maximum)) {
    session_.begin(nullptr, now_ms_);
    pump();
  }

  [[nodiscard]] const finding& found() const { return found_; }

  void hear(std::string_view bytes) {
    session_.on_bytes(bytes, now_ms_);
    pump();
  }
  void publish_some() {
    if (!session_.is_open() || token_ >= 60)
      return;
    for (const bool is_acknowledged : {true, false, true}) {
      session_.publish({"t", text_, is_acknowledged, true, 5}, ++token_, now_ms_);
      if (is_acknowledged)
        acknowledged_.insert(token_);
    }
    pump();
  }
  // Nothing more comes.
  void wait_for_end() {
    for (int turns = 0; turns < 100 && !session_.is_over(); ++turns) {
      now_ms_ = std::max(now_ms_ + 1, session_.next_due_ms());
      session_.on_time(now_ms_);
      pump();
    }
    if (!session_.is_over())
      found_ = "a session that does not end in silence";
    else if (!is_closed_)
      found_ = "a session that ends without a word";
  }

private:
  void pump() {
    collect();
    for (auto batch = session_.take_batch(now_ms_); !batch.empty(); batch = session_.take_batch(now_ms_)) {
      waiting_ += acknowledged_in(batch);
      if (waiting_ > receive_maximum_)
        found_ = "more messages wait for an acknowledgement than the broker bears";
      session_.on_written(now_ms_);
      collect();
    }
  }
  void collect() {
    for (const auto& event : session_.take_events()) {
      if (is_closed_)
        found_ = "an event after the last";
      if (std::holds_alternative<session_opened>(event) && std::exchange(is_opened_, true))
        found_ = "opened twice";
      if (const auto* const m = std::get_if<session_published>(&event)) {
        if (!is_opened_ || m->token == 0 || m->token > token_ + 3 || !reported_.insert(m->token).second)
          found_ = "a message that was not sent, or one twice";
        waiting_ -= acknowledged_.contains(m->token) ? 1 : 0;
      }
      is_closed_ |= std::holds_alternative<session_closed>(event);
    }
  }

  const std::shared_ptr<const std::string> text_ = std::make_shared<const std::string>("{}");
  Session session_{{"rover-7", "", 15}, {"gw/v1/rover-7/status", text_, true, true, 0}};
  std::size_t receive_maximum_;
  std::int64_t now_ms_ = 0;
  std::uint64_t token_ = 0;
  std::set<std::uint64_t> acknowledged_;
  std::set<std::uint64_t> reported_;
  std::size_t waiting_ = 0;
  bool is_opened_ = false;
  bool is_closed_ = false;
  finding found_;
};

template <class Session>
finding check_session(std::string_view bytes, std::size_t piece_bytes, const judged& expected) {
  observed<Session> broker(expected.receive_maximum);
  for (; !bytes.empty() && !broker.found(); bytes.remove_prefix(std::min(piece_bytes, bytes.size()))) {
    broker.hear(bytes.substr(0, piece_bytes));
    broker.publish_some();
  }
  if (!broker.found())
    broker.wait_for_end();
  return broker.found();
}

// The first byte of an input says how large the pieces are.
template <class Reader = packet_reader, class Session = session>
finding check_mqtt(std::string_view input) {
  if (input.empty())
    return {};
  const std::size_t piece_bytes = std::size_t{byte_at(input, 0)} + 1;
  input.remove_prefix(1);
  const auto expected = judge(input);
  for (const auto size : {std::max<std::size_t>(1, input.size()), piece_bytes, std::size_t{1}})
    if (auto found = check_reader<Reader>(input, size, expected))
      return found;
  return check_session<Session>(input, piece_bytes, expected);
}

} // namespace godwit::io::mqtt::fuzz
