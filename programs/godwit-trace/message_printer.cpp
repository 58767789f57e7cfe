#include "programs/godwit-trace/message_printer.hpp"

#include <algorithm>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/message_json.hpp"
#include "programs/godwit-trace/message_text.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

constexpr std::size_t seconds_width = 12; // 99999.999999: more than a day
constexpr std::size_t sender_width = 7;   // 255/255

void pad_to(std::string& out, std::size_t begin, std::size_t width) {
  const auto size = out.size() - begin;
  out.append(width - std::min(width, size), ' ');
}

} // namespace

void message_printer::append(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame) const {
  if (form_ == print_form::json) {
    append_message_json(out, time_us, frame);
  } else {
    append_head(out, time_us, frame.from());
    append_message_text(out, frame);
    out += frame.is_signed() ? " (signed)" : "";
  }
  out += '\n';
}

void message_printer::append_head(std::string& out, std::uint64_t time_us, io::mavlink::sender from) const {
  if (time_ == print_time::utc) {
    append_utc(out, time_us);
  } else {
    std::string seconds;
    append_seconds(seconds, static_cast<std::int64_t>(time_us - begin_us_));
    out.append(seconds_width - std::min(seconds_width, seconds.size()), ' ').append(seconds);
  }
  out += ' ';
  const auto begin = out.size();
  io::append_json_number(out, from.system);
  out += '/';
  io::append_json_number(out, from.component);
  pad_to(out, begin, sender_width);
  out += ' ';
}

} // namespace godwit::trace_tool
