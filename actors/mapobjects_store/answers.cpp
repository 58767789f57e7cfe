#include "actors/mapobjects_store/answers.hpp"

namespace godwit::mapobjects_store {

map_failure failure_of(map_errc code) {
  switch (code) {
  case map_errc::refused:
    return map_failure::refused;
  case map_errc::load_given_up:
    return map_failure::load_given_up;
  case map_errc::delivered:
    return map_failure::delivered;
  case map_errc::full:
  case map_errc::disk: // the writer itself tries again; this is a reader that could not be opened for now
    return map_failure::busy;
  case map_errc::closed:
  case map_errc::locked:
  case map_errc::missing:
  case map_errc::foreign:
  case map_errc::newer:
  case map_errc::corrupt:
  case map_errc::internal:
    break;
  }
  return map_failure::broken;
}

} // namespace godwit::mapobjects_store
