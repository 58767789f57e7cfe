// How a component is: a colour, and why in a sentence for people. Thread: plain values.
#pragma once

#include <string>

namespace godwit::runtime {

enum class health_colour { green, yellow, red };

struct condition {
  health_colour how = health_colour::green;
  std::string reason;
  friend bool operator==(const condition&, const condition&) = default;
};

} // namespace godwit::runtime
