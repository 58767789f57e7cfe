// The broker's half of MQTT 5 for tests: reads what a publisher sends and makes what a broker sends, right or wrong.
// Written from the standard and not from io/mqtt, so that a mistake there does not stand here too. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 3.1 to 3.4, 3.12 to 3.14; what mosquitto 2.0.11 answers: tests/data/mqtt/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace godwit::tests::mqtt {

inline constexpr int connect_type = 1;
inline constexpr int publish_type = 3;
inline constexpr int pingreq_type = 12;
inline constexpr int disconnect_type = 14;

struct raw_packet {
  int type = 0;
  int flags = 0;
  std::string body;
};

class fields {
public:
  explicit fields(std::string bytes) : bytes_(std::move(bytes)) {}

  std::uint32_t number(std::size_t size) {
    std::uint32_t result = 0;
    for (const char each : take(size))
      result = result * 256 + static_cast<unsigned char>(each);
    return result;
  }
  std::size_t varint() {
    std::size_t result = 0;
    std::size_t factor = 1;
    for (;; factor *= 128) {
      const auto byte = number(1);
      result += (byte % 128) * factor;
      if (byte < 128)
        return result;
    }
  }
  std::string text() { return take(number(2)); }
  std::string take(std::size_t size) {
    if (at_ + size > bytes_.size())
      throw std::runtime_error("a packet of the publisher is cut off");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  [[nodiscard]] std::string rest() { return take(bytes_.size() - at_); }
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }

private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// Takes whole packets from the front of BYTES.
inline std::vector<raw_packet> packets_in(std::string& bytes) {
  std::vector<raw_packet> result;
  for (;;) {
    std::size_t length = 0;
    std::size_t head = 1;
    for (std::size_t factor = 1;; factor *= 128) {
      if (head >= bytes.size())
        return result;
      const auto byte = static_cast<unsigned char>(bytes[head++]);
      length += (byte % 128) * factor;
      if (byte < 128)
        break;
    }
    if (bytes.size() < head + length)
      return result;
    const auto first = static_cast<unsigned char>(bytes[0]);
    result.push_back({first / 16, first % 16, bytes.substr(head, length)});
    bytes.erase(0, head + length);
  }
}

// Numbers, as far as a publisher sends them.
using property_map = std::map<int, std::string>;

inline property_map read_properties(fields& from) {
  property_map result;
  fields each(from.take(from.varint()));
  while (!each.is_at_end()) {
    const auto which = static_cast<int>(each.number(1));
    std::string value = which == 0x03   ? each.text()
                        : which == 0x02 ? std::to_string(each.number(4))
                        : which == 0x27 ? std::to_string(each.number(4))
                                        : throw std::runtime_error("a property that no publisher of ours sends");
    if (!result.emplace(which, std::move(value)).second)
      throw std::runtime_error("a property twice");
  }
  return result;
}

struct connect_packet {
  std::string protocol;
  int version = 0;
  int flags = 0;
  int keep_alive_s = 0;
  property_map properties;
  std::string client_id;
  property_map will_properties;
  std::string will_topic;
  std::string will;
  std::optional<std::string> user;
  std::optional<std::string> password;
};

inline connect_packet read_connect(const raw_packet& packet) {
  fields from(packet.body);
  connect_packet result;
  result.protocol = from.text();
  result.version = static_cast<int>(from.number(1));
  result.flags = static_cast<int>(from.number(1));
  result.keep_alive_s = static_cast<int>(from.number(2));
  result.properties = read_properties(from);
  result.client_id = from.text();
  if ((result.flags & 0x04) != 0) {
    result.will_properties = read_properties(from);
    result.will_topic = from.text();
    result.will = from.text();
  }
  if ((result.flags & 0x80) != 0)
    result.user = from.text();
  if ((result.flags & 0x40) != 0)
    result.password = from.text();
  if (!from.is_at_end())
    throw std::runtime_error("bytes after a CONNECT");
  return result;
}

struct publish_packet {
  int qos = 0;
  bool is_retained = false;
  std::string topic;
  int id = 0;
  property_map properties;
  std::string payload;
};

inline publish_packet read_publish(const raw_packet& packet) {
  fields from(packet.body);
  publish_packet result;
  result.qos = packet.flags / 2 % 4;
  result.is_retained = packet.flags % 2 != 0;
  result.topic = from.text();
  if (result.qos != 0)
    result.id = static_cast<int>(from.number(2));
  result.properties = read_properties(from);
  result.payload = from.rest();
  return result;
}

// -- what a broker sends

inline std::string number(std::uint64_t value, std::size_t size) {
  std::string result(size, '\0');
  for (; size-- > 0; value /= 256)
    result[size] = static_cast<char>(value % 256);
  return result;
}

inline std::string varint(std::size_t value) {
  std::string result;
  do {
    result += static_cast<char>(value % 128 + (value >= 128 ? 128 : 0));
    value /= 128;
  } while (value != 0);
  return result;
}

inline std::string text(std::string_view value) { return number(value.size(), 2) + std::string(value); }

inline std::string packet(int first_byte, const std::string& body) {
  return number(static_cast<std::uint64_t>(first_byte), 1) + varint(body.size()) + body;
}

inline std::string property(int which, const std::string& value) {
  return number(static_cast<std::uint64_t>(which), 1) + value;
}

inline std::string connack(int reason = 0, const std::string& properties = {}, int flags = 0) {
  return packet(0x20, number(static_cast<std::uint64_t>(flags), 1) + number(static_cast<std::uint64_t>(reason), 1) +
                          varint(properties.size()) + properties);
}

inline std::string puback(int id) { return packet(0x40, number(static_cast<std::uint64_t>(id), 2)); }
inline std::string puback(int id, int reason, const std::string& properties = {}) {
  return packet(0x40, number(static_cast<std::uint64_t>(id), 2) + number(static_cast<std::uint64_t>(reason), 1) +
                          varint(properties.size()) + properties);
}
inline std::string pingresp() { return packet(0xD0, {}); }
inline std::string disconnect(int reason, const std::string& properties = {}) {
  return packet(0xE0, number(static_cast<std::uint64_t>(reason), 1) + varint(properties.size()) + properties);
}

} // namespace godwit::tests::mqtt
