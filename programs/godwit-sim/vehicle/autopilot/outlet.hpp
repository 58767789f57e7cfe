// The ways out for everything that an autopilot says: frames with their sequence numbers, sentences in STATUSTEXTs, on
// each line that leads to it.
//
//   const auto there = out.aim(out.line_of_event());    // frames go there alone while THERE lives
//
// Frames and sentences go out on every line, unless they are aimed at some. Each line numbers its own frames and
// sentences, and has its own sentences that wait. Which senders were heard on which line is kept here as well: an
// autopilot answers where it was asked (ArduPilot), or where it has heard the one that it answers (PX4).
//
// Sentences that are said during a turn, that is while one event is handled, go out at its end: an autopilot answers
// first and explains afterwards. They can be held back for longer. A frame is made on the stack; nothing is allocated.
// Bounds: lines (max_lines); sentences that wait on a line (max_waiting_texts; the oldest is dropped); senders of a
// line (max_senders, as MAX_REMOTE_COMPONENTS of PX4; a later one is not known there). Thread: one at a time.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

using line_number = std::size_t; // from 0

class outlet {
public:
  using frame_sink = std::function<void(std::span<const std::byte>)>;

  static constexpr std::size_t max_lines = 8;
  static constexpr std::size_t max_waiting_texts = 32;
  static constexpr std::size_t max_senders = 16;

  using line_set = std::bitset<max_lines>;

  // Its line 0. NUMBERS_EACH_TEXT: PX4 gives each sentence an id, others only one that needs several frames.
  outlet(mavlink::sender ourselves, frame_sink send, bool numbers_each_text);

  // There are fewer than max_lines.
  line_number add_line(frame_sink send);
  [[nodiscard]] std::size_t line_count() const { return lines_.size(); }
  [[nodiscard]] mavlink::sender ourselves() const { return ourselves_; }

  // -- where to

  // Frames go to the lines of the newest of these that lives.
  class aimed {
  public:
    aimed(outlet& of, const line_set& lines) : of_(of), before_(std::exchange(of.aim_, lines)) {}
    aimed(const aimed&) = delete;
    aimed& operator=(const aimed&) = delete;
    ~aimed() { of_.aim_ = before_; }

  private:
    outlet& of_;
    line_set before_;
  };
  [[nodiscard]] aimed aim(const line_set& lines) { return {*this, lines}; }
  [[nodiscard]] aimed aim(line_number line) { return {*this, only(line)}; }

  [[nodiscard]] static line_set only(line_number line) { return line_set{}.set(line); }
  // On which the frame came that is handled.
  [[nodiscard]] line_number line_of_event() const { return line_of_event_; }
  // Where WHOM was heard since the start; component 0: somebody of its system; system 0: anybody.
  [[nodiscard]] line_set lines_of(mavlink::sender whom) const;
  // A frame of FROM came on LINE.
  void on_frame(mavlink::sender from, line_number line);

  // -- what goes out

  template <mavlink::message M>
  void send(const M& message) {
    if (is_silent_)
      return;
    for (line_number number = 0; number < lines_.size(); ++number)
      if (aim_.test(number))
        lines_[number].send(mavlink::encode(message, ourselves_, lines_[number].sequence++).span());
  }
  // By another component of the vehicle, which numbers its frames itself.
  template <mavlink::message M>
  void send_as(std::uint8_t component, const M& message) {
    if (is_silent_)
      return;
    for (auto& each : lines_)
      each.send(mavlink::encode(message, {ourselves_.system, component}, each.sequence_of_others++).span());
  }
  // A frame of a message that has no struct.
  void send_payload(std::uint32_t id, std::uint8_t crc_extra, mavlink::byte_view payload);

  void say(mavlink::mav_severity severity, std::string_view words);
  void say(std::uint8_t severity, std::string_view words);
  void say_on(const line_set& lines, std::uint8_t severity, std::string_view words);
  // Whoever plays the vehicle wants it said: also where it is held back.
  void say_at_once(mavlink::mav_severity severity, std::string_view words);

  // Lets the sentences out that wait, on the lines where they are not held back.
  void end_turn();
  // On every line, those that are added later among them; and on one.
  void hold_texts_back(bool held);
  void hold_texts_back(line_number line, bool held) { lines_[line].holds_texts_back = held; }

  // Nothing goes out, and what is said is lost: the autopilot is starting.
  void be_silent(bool silent) { is_silent_ = silent; }
  // As after a start: no sentence waits, nobody was heard, all numbers begin again.
  void restart();

private:
  struct sentence {
    std::uint8_t severity = 0;
    std::string words;
  };
  struct one_line {
    frame_sink send;
    bool holds_texts_back = false;
    std::uint8_t sequence = 0;
    std::uint8_t sequence_of_others = 0;
    std::uint16_t next_text_id = 0;
    std::deque<sentence> waiting;
    std::vector<mavlink::sender> heard;
  };
  void send_text(line_number line, const sentence& what);

  mavlink::sender ourselves_;
  bool numbers_each_text_;
  bool holds_texts_back_ = false; // on lines that are added
  bool is_silent_ = false;
  std::vector<one_line> lines_;
  line_set aim_ = line_set{}.set();
  line_number line_of_event_ = 0;
};

} // namespace godwit::sim
