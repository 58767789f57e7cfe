#include "programs/godwit-sim/vehicle/autopilot/outlet.hpp"

#include <algorithm>

#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::sim {

void outlet::send_payload(std::uint32_t id, std::uint8_t crc_extra, mavlink::byte_view payload) {
  if (!is_silent_)
    send_(mavlink::frame_buffer(id, crc_extra, payload, ourselves_, sequence_++, false).span());
}

void outlet::say(mavlink::mav_severity severity, std::string_view words) { say(mavlink::number(severity), words); }

void outlet::say(std::uint8_t severity, std::string_view words) {
  if (is_silent_)
    return;
  if (waiting_.size() == max_waiting_texts)
    waiting_.pop_front();
  waiting_.push_back({severity, std::string(words)});
}

void outlet::end_turn() {
  if (holds_texts_back_)
    return;
  while (!waiting_.empty()) {
    const auto next = std::move(waiting_.front());
    waiting_.pop_front();
    send_text(next);
  }
}

void outlet::restart() {
  waiting_.clear();
  sequence_ = 0;
  next_text_id_ = 0;
}

void outlet::send_text(const sentence& what) {
  mavlink::statustext message{.severity = what.severity};
  const bool is_long = what.words.size() > message.text.size();
  if (is_long && !numbers_each_text_ && next_text_id_ == 0)
    next_text_id_ = 1; // 0 says that this is the whole sentence
  if (is_long || numbers_each_text_)
    message.id = next_text_id_++;
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
