// What can be set about operators. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::operator_bridge {

struct settings {
  std::int64_t session_idle_s = 1'800;  // without a word for so long, a session ends
  std::int64_t session_most_s = 43'200; // and after so long whatever is done in it: a long day
  static constexpr auto fields =
      io::table("operator_bridge.settings", io::field("session_idle_s", &settings::session_idle_s),
                io::field("session_most_s", &settings::session_most_s));
};

} // namespace godwit::operator_bridge
