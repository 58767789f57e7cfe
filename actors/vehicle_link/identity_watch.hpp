// Whether more than one speaks under the vehicle's name: a program that is no autopilot, or a second vehicle.
//
//   heartbeats that are no autopilot's      another program
//   two clocks since boot, in turn          two vehicles; a restart goes over to another clock once and stays there
//   two places, in turn                     two vehicles; so found where both were switched on at the same time
//   two counts of frames, in turn           two senders: either of these, or two ways of one vehicle
//
// Each is followed as two runs that go on steadily: who comes late or is lost continues neither. Found is what has gone
// to and fro often enough of late, and it lasts for lasts_ns after that. Pure: monotonic nanoseconds. Thread: a value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "actors/domain/geo/point.hpp"
#include "io/mavlink/frame.hpp"

namespace godwit::vehicle_link {

// Two runs of VALUE that are heard in turn.
template <class Value>
class two_runs {
public:
  static constexpr std::int64_t window_ns = 10'000'000'000;
  static constexpr std::size_t max_turns = 20;

  // HITS: of each run before it counts. TURNS: from one to the other, within the window.
  two_runs(int hits, std::size_t turns) : hits_(hits), turns_wanted_(turns) {}

  // APART(last of a run, VALUE): nothing where VALUE does not continue the run, else how far it is.
  template <class Apart>
  void note(const Value& value, std::int64_t now_ns, Apart apart) {
    auto* const continued = nearest(value, apart);
    auto& of = continued != nullptr ? *continued : older();
    if (continued == nullptr)
      of = {};
    of.newest = value;
    of.heard_ns = now_ns;
    ++of.hits;
    const auto index = &of - runs_.data();
    if (std::exchange(speaks_, index) == index || of.hits < hits_)
      return;
    turns_.push_back(now_ns);
    if (turns_.size() > max_turns)
      turns_.pop_front();
  }

  [[nodiscard]] bool are_two(std::int64_t now_ns) const {
    const auto of_late = turns_.size() >= turns_wanted_ && now_ns - turns_[turns_.size() - turns_wanted_] < window_ns;
    return of_late && runs_[0].hits >= hits_ && runs_[1].hits >= hits_;
  }
  [[nodiscard]] const Value& one() const { return runs_[0].newest; }
  [[nodiscard]] const Value& other() const { return runs_[1].newest; }

private:
  struct run {
    Value newest{};
    std::int64_t heard_ns = 0;
    int hits = 0; // 0: there is none
  };

  template <class Apart>
  run* nearest(const Value& value, Apart apart) {
    run* result = nullptr;
    double least = 0;
    for (auto& each : runs_) {
      const auto distance = each.hits == 0 ? std::optional<double>() : apart(each.newest, value);
      if (distance && (result == nullptr || *distance < least)) {
        result = &each;
        least = *distance;
      }
    }
    return result;
  }
  run& older() { return runs_[0].heard_ns <= runs_[1].heard_ns ? runs_[0] : runs_[1]; }

  int hits_;
  std::size_t turns_wanted_;
  std::array<run, 2> runs_{};
  std::ptrdiff_t speaks_ = -1; // whose turn it is
  std::deque<std::int64_t> turns_;
};

class identity_watch {
public:
  static constexpr std::int64_t lasts_ns = 10'000'000'000;
  static constexpr std::int64_t clocks_apart_ms = 5'000; // UDP may bring a frame late, but not by so much
  static constexpr double places_apart_m = 100;          // no vehicle flies so far between two positions
  static constexpr std::uint8_t counts_apart = 16;       // frames of one count that overtake each other are nearer

  void on_other_program(std::int64_t now_ns) { other_program_ns_ = now_ns; }
  void on_boot_time(std::uint32_t boot_ms, std::int64_t now_ns);
  void on_place(const geo::point& where, std::int64_t now_ns);
  void on_sequence(std::uint8_t sequence, std::int64_t now_ns);

  // Sentences for people about NAME; empty: nothing of the kind.
  [[nodiscard]] std::string twin(io::mavlink::sender name, std::int64_t now_ns) const;
  [[nodiscard]] std::string other_sender(io::mavlink::sender name, std::int64_t now_ns) const;

private:
  struct clock {
    std::int64_t offset_ms = 0; // of the time since boot to ours
  };

  two_runs<clock> clocks_{3, 6};
  two_runs<geo::point> places_{3, 6};
  two_runs<std::uint8_t> counts_{10, 20};
  std::optional<std::int64_t> other_program_ns_;
};

} // namespace godwit::vehicle_link
