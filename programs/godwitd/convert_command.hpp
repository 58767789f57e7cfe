// `godwitd convert IN OUT`: a mission from one file format into another.
//
// The formats follow from the endings of the names. What can not be carried over is listed and refused, unless partial
// conversions are allowed. OUT is written whole or not at all.
//
// VEHICLE: what it takes, refuses and ignores decides what is lost.
//
// Ends with: ok; failed: a file that can not be read or written, is no mission, or would lose something; usage: an
// ending that means no format. Thread: the caller's; blocks on the disk.
#pragma once

#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "actors/domain/mission/convert/convert.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon {

struct convert_arguments {
  std::string in;
  std::string out;
  std::string vehicle{};              // a vehicle_profile; empty: as far as the file says it
  std::optional<double> altitude_m{}; // above home, of places without heights
};

[[nodiscard]] runtime::exit_code run_convert(const convert_arguments& given, bool allow_partial);

// The mission in FILE, whose name has the ending of a format. The error is for people.
[[nodiscard]] tl::expected<mission::imported, std::string>
load_mission_file(const std::string& file, bool allow_partial, const mission::allowed_commands& allowed = {});

} // namespace godwit::daemon
