// What can be set about the broker. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/mqtt/broker_uri.hpp"

namespace godwit::fleet_link {

struct settings {
  io::mqtt::broker_uri broker;
  std::string vehicle; // its name there: client id, and part of each topic
  std::string username;
  std::string password_file;
  std::string ca_file;
  std::string certificate_file;
  std::string key_file;
  std::int64_t interval_ms = 1'000; // between two positions
};

// What can not be, as a sentence that begins with the name of the setting; nothing: it can be used.
[[nodiscard]] std::optional<std::string> objection_to(const settings& configured);

} // namespace godwit::fleet_link
