// Prints messages in the form that was asked for, one a line. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/mavlink/frame.hpp"

namespace godwit::trace_tool {

enum class print_form { text, json };
enum class print_time { utc, since_begin };

class message_printer {
public:
  explicit message_printer(print_form form, print_time time = print_time::utc) : form_(form), time_(time) {}

  // What print_time::since_begin counts from.
  void begin_at(std::uint64_t time_us) { begin_us_ = time_us; }

  // TIME_US: since 1970 UTC.
  void append(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame) const;

private:
  void append_head(std::string& out, std::uint64_t time_us, io::mavlink::sender from) const;

  print_form form_;
  print_time time_;
  std::uint64_t begin_us_ = 0;
};

} // namespace godwit::trace_tool
