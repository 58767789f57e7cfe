// Why there is no connection to a broker. Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::io::mqtt {

enum class failure {
  none,
  not_resolved,   // its name
  unreachable,    // nobody answers there
  lost,           // it was connected
  certificate,    // TLS: the broker is not who it should be, or will not have us
  not_authorised, // user, password, or what this user may publish
  taken_over,     // somebody else has connected under the same name
  refused,        // the broker says no for another reason, or what does not belong here
  retain_refused, // it keeps no messages for who comes later
  unusable        // of our own: a file can not be read
};

GODWIT_ENUM_NAMES(failure, none, not_resolved, unreachable, lost, certificate, not_authorised, taken_over, refused,
                  retain_refused, unusable);

} // namespace godwit::io::mqtt
