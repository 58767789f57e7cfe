// What `godwitd doctor` finds: a sentence about one thing, and what to do about it. Thread: plain values.
#pragma once

#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::daemon::doctor {

enum class grade {
  good,
  warning, // it flies, and something is lost or open
  problem  // it does not fly
};
GODWIT_ENUM_NAMES(grade, good, warning, problem);

struct finding {
  grade how = grade::good;
  std::string subject; // "serial line", "clock"
  std::string sentence;
  std::string remedy = {}; // empty: nothing is to be done
};

using findings = std::vector<finding>;

} // namespace godwit::daemon::doctor
