#include "actors/executor/preflight/checks/operator_session.hpp"

namespace godwit::executor::preflight {

result look_at_operator_session(const facts& seen, const settings& set) {
  if (!set.is_operator_session_required)
    return skipped("No operator has to be there.");
  if (!seen.is_operator_session_alive)
    return fail("An operator has to be there, and none is; connect and log in.");
  return pass("An operator is there.");
}

} // namespace godwit::executor::preflight
