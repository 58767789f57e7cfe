// The texts of MQTT: well-formed UTF-8 without U+0000. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 1.5.4; RFC 3629, 4.
#pragma once

#include <string_view>

namespace godwit::io::mqtt {

[[nodiscard]] bool is_mqtt_text(std::string_view text);

} // namespace godwit::io::mqtt
