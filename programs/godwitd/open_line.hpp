// On which lines anybody can speak: networks without a key. Over UDP a sender can be made up, so there more than one
// heartbeat is needed before somebody is believed. Source: docs/decisions/links.md. Thread: pure.
#pragma once

#include <string>
#include <string_view>

#include "io/link/uri.hpp"

namespace godwit::daemon {

// Heartbeats until an autopilot or a station on this line is believed.
[[nodiscard]] int heartbeats_to_begin(const io::link::uri& line, bool is_signed);

// A serial line, or one that does not leave this computer.
[[nodiscard]] bool stays_in_vehicle(const io::link::uri& line);

// The text of a line that is reached from outside of this computer and has no key. Empty: it is none.
[[nodiscard]] std::string open_line(const io::link::uri& line, bool is_signed);

// What people are told of a line that is reached from outside of this computer and has no key. Empty: nothing.
// OPTION gives it one, as "--signing-key".
[[nodiscard]] std::string open_line_warning(const io::link::uri& line, bool is_signed, std::string_view option);

} // namespace godwit::daemon
