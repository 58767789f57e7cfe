// Who says something, as far as godwit knows: a name, what that person may do, and the session in which it is said.
//
// operator_bridge makes principals and judges them; nobody else does. Thread: plain values.
#pragma once

#include <string>
#include <string_view>

#include "io/fields/field_table.hpp"

namespace godwit::operators {

// Each may do what stands left of it, too.
enum class role {
  viewer,    // looks
  operator_, // flies: commands, with control; hold and return always
  engineer   // takes control from others
};

constexpr auto enum_names(role) {
  return io::names<role>({{role::viewer, "viewer"}, {role::operator_, "operator"}, {role::engineer, "engineer"}});
}

// The session of whoever reaches the control socket: it is open to the user of the daemon alone.
inline constexpr std::string_view local_session = "local";

struct principal {
  std::string name;
  operators::role role = operators::role::viewer;
  std::string session; // a number of operator_bridge's, or local_session; never the secret that opens it
  GODWIT_FIELDS(principal, "operator.principal", name, role, session);
  friend bool operator==(const principal&, const principal&) = default;
};

} // namespace godwit::operators
