#include "actors/executor/preflight/checks/camera.hpp"

namespace godwit::executor::preflight {

result look_at_camera(const facts& seen, const settings&) {
  switch (seen.camera.state) {
  case camera_state::off:
    return skipped("The camera is off.");
  case camera_state::ready:
    return pass("The camera is ready.");
  case camera_state::not_ready:
    return degraded("The camera gives no picture" + (seen.camera.problem.empty() ? "" : ": " + seen.camera.problem) +
                    "; look at its cable and power, or fly without pictures.");
  case camera_state::unknown:
    break;
  }
  return fail("Nothing was heard of the camera yet; wait, or switch it off in the configuration.");
}

} // namespace godwit::executor::preflight
