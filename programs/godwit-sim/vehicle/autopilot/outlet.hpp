// The way out for everything that an autopilot says: frames with their sequence numbers, sentences in STATUSTEXTs.
//
// Sentences that are said during a turn, that is while one event is handled, go out at its end: an autopilot answers
// first and explains afterwards. They can be held back for longer. A frame is made on the stack; nothing is allocated.
// Bounds: sentences that wait (max_waiting_texts; the oldest is dropped). Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

class outlet {
public:
  using frame_sink = std::function<void(std::span<const std::byte>)>;

  static constexpr std::size_t max_waiting_texts = 32;

  // NUMBERS_EACH_TEXT: PX4 gives each sentence an id, others only one that needs several frames.
  outlet(mavlink::sender ourselves, frame_sink send, bool numbers_each_text)
      : ourselves_(ourselves), send_(std::move(send)), numbers_each_text_(numbers_each_text) {}

  [[nodiscard]] mavlink::sender ourselves() const { return ourselves_; }

  template <mavlink::message M>
  void send(const M& message) {
    if (!is_silent_)
      send_(mavlink::encode(message, ourselves_, sequence_++).span());
  }
  // A frame of a message that has no struct.
  void send_payload(std::uint32_t id, std::uint8_t crc_extra, mavlink::byte_view payload);

  void say(mavlink::mav_severity severity, std::string_view words);
  void say(std::uint8_t severity, std::string_view words);

  // Lets the sentences out that wait, unless they are held back.
  void end_turn();
  void hold_texts_back(bool held) { holds_texts_back_ = held; }

  // Nothing goes out, and what is said is lost: the autopilot is starting.
  void be_silent(bool silent) { is_silent_ = silent; }
  // As after a start: no sentence waits, all numbers begin again.
  void restart();

private:
  struct sentence {
    std::uint8_t severity = 0;
    std::string words;
  };
  void send_text(const sentence& what);

  mavlink::sender ourselves_;
  frame_sink send_;
  bool numbers_each_text_;
  bool holds_texts_back_ = false;
  bool is_silent_ = false;
  std::uint8_t sequence_ = 0;
  std::uint16_t next_text_id_ = 0;
  std::deque<sentence> waiting_;
};

} // namespace godwit::sim
