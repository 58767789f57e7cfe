#include "actors/domain/vehicle_text/text_assembler.hpp"

#include <utility>

#include "actors/domain/vehicle_text/vehicle_text.hpp"

namespace godwit::flight {

std::vector<vehicle_message> text_assembler::take(const io::mavlink::statustext& piece, std::int64_t now_ns) {
  std::vector<vehicle_message> complete;
  const auto text = text_of(piece);
  const bool goes_on = open_ && piece.id == open_->id && piece.chunk_seq == open_->next_piece;
  if (open_ && !goes_on)
    complete.push_back(cut_off());
  if (!open_) {
    const bool lacks_its_begin = piece.id != 0 && piece.chunk_seq != 0;
    open_ = open_text{.message = {piece.severity, lacks_its_begin ? "..." : ""}, .id = piece.id};
  }
  open_->message.text += text;
  open_->next_piece = static_cast<std::uint8_t>(piece.chunk_seq + 1);
  open_->since_ns = now_ns;
  const bool is_last = piece.id == 0 || text.size() < piece.text.size();
  if (is_last)
    complete.push_back(std::exchange(open_, {})->message);
  else if (open_->next_piece >= max_pieces)
    complete.push_back(cut_off());
  return complete;
}

std::optional<vehicle_message> text_assembler::take_late(std::int64_t now_ns) {
  if (!open_ || now_ns - open_->since_ns < piece_patience_ns)
    return std::nullopt;
  return cut_off();
}

vehicle_message text_assembler::cut_off() {
  auto result = std::exchange(open_, {})->message;
  result.text += "...";
  return result;
}

} // namespace godwit::flight
