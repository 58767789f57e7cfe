#include "actors/executor/flight/vehicle_messages.hpp"

#include <algorithm>
#include <utility>

#include "io/mavlink/enums.hpp"

namespace godwit::executor {

namespace {

using io::mavlink::mav_severity;
using io::mavlink::number;

} // namespace

std::vector<flight::vehicle_message> vehicle_messages::take(effects& out, const io::mavlink::statustext& piece,
                                                            std::int64_t now_ns) {
  auto complete = look(out, now_ns);
  for (auto& each : pieces_.take(piece, now_ns)) {
    tell(out, each, now_ns);
    complete.push_back(std::move(each));
  }
  return complete;
}

std::vector<flight::vehicle_message> vehicle_messages::look(effects& out, std::int64_t now_ns) {
  std::vector<flight::vehicle_message> complete;
  if (auto late = pieces_.take_late(now_ns)) {
    tell(out, *late, now_ns);
    complete.push_back(*std::move(late));
  }
  if (now_ns - window_began_ns_ >= window_ns)
    begin_window(out, now_ns);
  return complete;
}

void vehicle_messages::begin_window(effects& out, std::int64_t now_ns) {
  if (left_out_ > 0)
    out.emplace_back(
        announce{"the vehicle has sent " + std::to_string(left_out_) + " more texts, which are left out", true});
  window_began_ns_ = now_ns;
  lines_ = left_out_ = 0;
}

void vehicle_messages::tell(effects& out, const flight::vehicle_message& message, std::int64_t now_ns) {
  if (message.text.empty() || message.severity >= number(mav_severity::debug) || is_repeated(message.text, now_ns))
    return;
  if (lines_ == max_lines) {
    ++left_out_;
    return;
  }
  ++lines_;
  if (told_.size() == max_remembered)
    told_.pop_front();
  told_.push_back({message.text, now_ns});
  out.emplace_back(
      announce{"the vehicle reports: " + message.text, message.severity <= number(mav_severity::warning), true});
}

bool vehicle_messages::is_repeated(const std::string& text, std::int64_t now_ns) {
  std::erase_if(told_, [&](const told_text& each) { return now_ns - each.at_ns >= repeat_ns; });
  return std::ranges::find(told_, text, &told_text::text) != told_.end();
}

} // namespace godwit::executor
