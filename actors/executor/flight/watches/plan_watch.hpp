// In flight: whether the vehicle still flies godwit's plan, and whether it was where it says it was.
//
//   doubt (somebody else's upload, a start, a place that the track contradicts) ──> the plan is read back
//     ├── ours      ──> as before
//     ├── another   ──> paused, as where the vehicle's plan id shows it
//     └── no answer ──> read again; told after told_after_ns
//
// Nothing of the flight is touched by it; a task that moves a plan goes first. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/watches/track.hpp"

namespace godwit::executor {

inline constexpr std::uint64_t first_of_plan_watch = 1ULL << 35U;

class plan_watch {
public:
  static constexpr std::int64_t read_again_ns = 2'000'000'000;
  static constexpr std::int64_t told_after_ns = 30'000'000'000;

  explicit plan_watch(flight_context& flight) : flight_(flight) {}

  void on_position(instant now);
  // To be asked before everything else.
  void check(effects& out, instant now);
  [[nodiscard]] bool awaits(std::uint64_t number) const { return number == reading_; }
  void on_transfer(effects& out, std::uint64_t number, const vehicle_link::transfer::outcome& outcome, instant now);

  // What the vehicle says of an item: that it is its current one, that its plan is complete there, or that it was
  // reached.
  enum class told { at, complete, reached };
  // Of the places that it has passed then, those that it was never near to.
  [[nodiscard]] std::vector<std::uint16_t> never_near(std::uint16_t sequence, told how) const;
  // An item was not reached after all: the sentence for people.
  [[nodiscard]] std::string missed_sentence(const std::string& item_id) const;

private:
  void follow_plan(instant now);
  // The start under way, or the last one, was seen to begin, and the vehicle was heard throughout since.
  [[nodiscard]] bool is_start_heard() const;
  [[nodiscard]] bool may_read() const;

  flight_context& flight_;
  track track_;
  std::optional<std::uint32_t> followed_; // the generation whose places the track has
  std::uint32_t resolved_ = 0;            // of it
  bool has_start_ = true;                 // one is under way; of the incarnation before, as long as none is seen
  std::int64_t start_ns_ = 0;             // when the next one was about to begin by a start; 0: it is not, or not seen
  bool was_heard_at_start_ = false;       // the followed one has begun by a start that this incarnation has seen
  std::uint64_t reading_ = 0;             // the number of the download; 0: none
  std::uint64_t last_number_ = first_of_plan_watch;
  std::int64_t begun_ns_ = 0; // that download
  std::int64_t next_ns_ = 0;
  bool is_told_ = false; // that it can not be read
};

} // namespace godwit::executor
