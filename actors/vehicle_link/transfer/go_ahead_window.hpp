// How many items may be under way before their requests have come back.
//
//   as long as the line has never been full      grow by what was acknowledged: double in a round trip
//   it has been full, and is not now             one more in each round trip
//   1 to 2 items wait somewhere: it is full      stay
//   more than that                               one less in each round trip
//   something was lost                           at most 1.8 times the items that come through between two losses;
//                                                half, if the line has been full
//
// What waits is estimated from the round trip, as TCP Vegas does: with W items under way and a round trip of R where S
// was the shortest, W * (1 - S / R) of them stand in a queue. So a fast line is filled within three or four round
// trips; there it costs nothing to send in vain. A slow line, or a vehicle that takes an item each 20 ms, is given what
// it can take and little more, and after a loss the window opens slowly: all that is under way when an item is lost was
// sent in vain and comes again, on the same slow line. Bounds: 1 or min_after_loss, and the peer's max_window. Source:
// Brakmo and Peterson, "TCP Vegas", 1995. Thread: one at a time.
#pragma once

#include <cstdint>

namespace godwit::vehicle_link::transfer {

class go_ahead_window {
public:
  static constexpr int enough_waiting = 1;
  static constexpr int too_many_waiting = 2;
  // The item asked for and the next: either may be lost, and either's request is an answer.
  static constexpr int min_after_loss = 2;

  go_ahead_window(int first, int max) : size_(first), max_(max) {}

  [[nodiscard]] int size() const { return size_; }

  // ITEMS more were taken by the vehicle; the last of them was sent ROUND_TRIP_NS ago. Not certain: it was sent before,
  // too, so that its round trip may have been longer. Then the window opens slowly.
  void on_progress(int items, std::int64_t round_trip_ns, bool is_certain);
  void on_loss();

  // Something was lost of late.
  [[nodiscard]] bool is_lossy() const { return lost_ > 0; }
  // The line, or the vehicle, has been seen to be the bottleneck.
  [[nodiscard]] bool is_fillable() const { return is_fillable_; }

private:
  [[nodiscard]] double waiting(std::int64_t round_trip_ns) const;

  [[nodiscard]] int largest() const;

  int size_;
  int max_;
  double taken_in_all_ = 0;  // of late
  double lost_ = 0;          // in the same time
  int taken_ = 0;            // since the size was last changed by one
  bool is_fillable_ = false; // the line, or the vehicle, has been seen to be the bottleneck
  std::int64_t shortest_ns_ = 0;
};

} // namespace godwit::vehicle_link::transfer
