// A line on stderr that says how far a long run is. On a terminal it is redrawn, elsewhere a line appears each tenth of
// the way. Thread: one owner.
#pragma once

#include <cstdint>
#include <string>

namespace godwit::drill {

class progress_bar {
public:
  explicit progress_bar(std::uint64_t total);
  // NOTE stands after the bar, e.g. "412 crashes". Cheap when nothing is to be drawn.
  void show(std::uint64_t done, const std::string& note);
  void finish();

private:
  std::uint64_t total_;
  std::uint64_t drawn_step_ = UINT64_MAX;
  bool terminal_;
};

} // namespace godwit::drill
