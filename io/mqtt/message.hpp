// What is published. Thread: plain values.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace godwit::io::mqtt {

struct message {
  std::string topic;
  std::shared_ptr<const std::string> payload; // JSON
  bool is_acknowledged = false;               // QoS 1; else 0
  bool is_retained = false;
  std::uint32_t expires_s = 0; // the broker keeps it no longer for who is away; 0: for ever
};

} // namespace godwit::io::mqtt
