// The drill's table for people. Thread: pure.
#pragma once

#include <string>

#include "programs/godwit-drill/runtime_drill.hpp"

namespace godwit::drill {

[[nodiscard]] std::string to_table(const runtime_drill_result& result);

} // namespace godwit::drill
