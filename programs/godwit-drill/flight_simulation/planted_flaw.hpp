// What a flight can be made to do wrong on purpose, so that whoever judges flights shows that it would see it.
// Thread: values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::drill {

enum class planted_flaw {
  none,
  lose_report,     // the service forgets the third report
  double_report,   // the service has the third report twice
  order_to_person, // the vehicle is sent an order 2 s after godwit has seen that a person has it
  forget_delivery, // the record lacks the second report to mission_client
  end_process      // an assertion fails at the third report
};

GODWIT_ENUM_NAMES(planted_flaw, none, lose_report, double_report, order_to_person, forget_delivery, end_process);

} // namespace godwit::drill
