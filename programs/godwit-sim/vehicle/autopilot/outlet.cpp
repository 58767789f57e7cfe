#include "programs/godwit-sim/vehicle/autopilot/outlet.hpp"

#include <algorithm>

#include "io/mavlink/messages/heartbeat.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

outlet::outlet(mavlink::sender ourselves, frame_sink send, bool numbers_each_text)
    : ourselves_(ourselves), numbers_each_text_(numbers_each_text) {
  add_line(std::move(send));
}

line_number outlet::add_line(frame_sink send) {
  GODWIT_ASSERT(lines_.size() < max_lines, "a vehicle has room for so many lines");
  lines_.push_back({.send = std::move(send), .holds_texts_back = holds_texts_back_, .waiting = {}, .heard = {}});
  return lines_.size() - 1;
}

// -- who is heard where -----------------------------------------------------------------------------

void outlet::on_frame(mavlink::sender from, line_number line) {
  GODWIT_ASSERT(line < lines_.size(), "a frame comes on one of the lines");
  line_of_event_ = line;
  auto& heard = lines_[line].heard;
  if (heard.size() < max_senders && std::find(heard.begin(), heard.end(), from) == heard.end())
    heard.push_back(from);
}

outlet::line_set outlet::lines_of(mavlink::sender whom) const {
  line_set result;
  for (line_number number = 0; number < lines_.size(); ++number)
    if (std::any_of(lines_[number].heard.begin(), lines_[number].heard.end(), [&](const mavlink::sender& each) {
          return whom.system == 0 ||
                 (each.system == whom.system && (whom.component == 0 || each.component == whom.component));
        }))
      result.set(number);
  return result;
}

// -- what goes out ----------------------------------------------------------------------------------

void outlet::send_payload(std::uint32_t id, std::uint8_t crc_extra, mavlink::byte_view payload) {
  if (is_silent_)
    return;
  for (line_number number = 0; number < lines_.size(); ++number)
    if (aim_.test(number))
      lines_[number].send(
          mavlink::frame_buffer(id, crc_extra, payload, ourselves_, lines_[number].sequence++, false).span());
}

void outlet::say(mavlink::mav_severity severity, std::string_view words) { say(mavlink::number(severity), words); }

void outlet::say(std::uint8_t severity, std::string_view words) { say_on(line_set{}.set(), severity, words); }

void outlet::say_on(const line_set& lines, std::uint8_t severity, std::string_view words) {
  if (is_silent_)
    return;
  for (line_number number = 0; number < lines_.size(); ++number) {
    if (!lines.test(number))
      continue;
    auto& waiting = lines_[number].waiting;
    if (waiting.size() == max_waiting_texts)
      waiting.pop_front();
    waiting.push_back({severity, std::string(words)});
  }
}

void outlet::say_at_once(mavlink::mav_severity severity, std::string_view words) {
  for (line_number number = 0; number < lines_.size() && !is_silent_; ++number)
    send_text(number, {mavlink::number(severity), std::string(words)});
}

void outlet::end_turn() {
  for (line_number number = 0; number < lines_.size(); ++number)
    while (!lines_[number].holds_texts_back && !lines_[number].waiting.empty()) {
      const auto next = std::move(lines_[number].waiting.front());
      lines_[number].waiting.pop_front();
      send_text(number, next);
    }
}

void outlet::hold_texts_back(bool held) {
  holds_texts_back_ = held;
  for (auto& each : lines_)
    each.holds_texts_back = held;
}

void outlet::restart() {
  for (auto& each : lines_) {
    each.waiting.clear();
    each.heard.clear();
    each.sequence = 0;
    each.next_text_id = 0;
  }
}

void outlet::send_text(line_number line, const sentence& what) {
  auto& next_text_id = lines_[line].next_text_id;
  mavlink::statustext message{.severity = what.severity};
  const bool is_long = what.words.size() > message.text.size();
  if (is_long && !numbers_each_text_ && next_text_id == 0)
    next_text_id = 1; // 0 says that this is the whole sentence
  if (is_long || numbers_each_text_)
    message.id = next_text_id++;
  const auto there = aim(line);
  std::string_view left = what.words;
  do {
    const auto part = left.substr(0, message.text.size());
    message.text.fill('\0');
    std::copy(part.begin(), part.end(), message.text.begin());
    send(message);
    ++message.chunk_seq;
    left.remove_prefix(part.size());
  } while (!left.empty());
}

} // namespace godwit::sim
