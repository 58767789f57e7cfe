#include "actors/ground_port/text_queue.hpp"

#include <algorithm>
#include <tuple>

namespace godwit::ground_port {

void text_queue::put(io::mavlink::mav_severity severity, std::string_view text, io::link::peer_id to) {
  constexpr auto piece = std::tuple_size_v<decltype(io::mavlink::statustext::text)>;
  text = text.substr(0, piece * max_frames_of_a_text - 1);
  // A text in pieces ends with a NUL; one that fills all its pieces is followed by an empty one.
  const auto pieces = text.size() <= piece ? std::size_t{1} : text.size() / piece + 1;
  if (waiting_.size() + pieces > max_waiting_frames) {
    ++dropped_;
    return;
  }
  // An id of 0 says that the text is whole.
  const bool is_whole = pieces == 1;
  if (!is_whole && ++last_id_ == 0)
    ++last_id_;
  for (std::size_t i = 0; i < pieces; ++i) {
    entry next{to, {.severity = static_cast<std::uint8_t>(severity)}};
    const auto part = text.substr(std::min(i * piece, text.size()), piece);
    std::copy(part.begin(), part.end(), next.frame.text.begin());
    next.frame.id = is_whole ? std::uint16_t{0} : last_id_;
    next.frame.chunk_seq = static_cast<std::uint8_t>(i);
    waiting_.push_back(next);
  }
}

std::optional<text_queue::entry> text_queue::due(std::int64_t now_ns) {
  if (now_ns < next_due_ns())
    return std::nullopt;
  const auto result = waiting_.front();
  waiting_.pop_front();
  paid_until_ns_ = std::max(paid_until_ns_, now_ns) + gap_ns;
  return result;
}

} // namespace godwit::ground_port
