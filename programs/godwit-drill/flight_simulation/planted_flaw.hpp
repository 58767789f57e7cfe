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

constexpr auto enum_names(planted_flaw) {
  return io::names<planted_flaw>({{planted_flaw::none, "none"},
                                  {planted_flaw::lose_report, "lose_report"},
                                  {planted_flaw::double_report, "double_report"},
                                  {planted_flaw::order_to_person, "order_to_person"},
                                  {planted_flaw::forget_delivery, "forget_delivery"},
                                  {planted_flaw::end_process, "end_process"}});
}

} // namespace godwit::drill
