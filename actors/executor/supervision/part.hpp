// The parts of a flight, as far as supervision is another one in each. Thread: constants.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::executor::supervision {

// Of a flight.
enum class part {
  ground, // before it
  flight,
  after // what is owed for it is delivered
};

GODWIT_ENUM_NAMES(part, ground, flight, after);

} // namespace godwit::executor::supervision
