// A bar on stderr that says how far a transfer is: redrawn on a terminal, nothing elsewhere. Thread: one.
#pragma once

#include "messages/vehicle_link/transfer.hpp"
#include "programs/godwit-trace/output.hpp"

namespace godwit::trace_tool {

class transfer_progress {
public:
  static constexpr int width = 40; // of the bar, in characters

  // Draws only if the words go to a terminal.
  explicit transfer_progress(console& to);
  void show(const vehicle_link::transfer::progress& how_far);
  void finish(); // takes the bar away

private:
  console& to_;
  bool is_drawn_ = false;
  bool draws_;
};

} // namespace godwit::trace_tool
