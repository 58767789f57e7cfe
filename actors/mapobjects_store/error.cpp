#include "actors/mapobjects_store/error.hpp"

namespace godwit::mapobjects_store {

bool is_refusal(map_errc code) {
  return code == map_errc::refused || code == map_errc::load_given_up || code == map_errc::delivered ||
         code == map_errc::full;
}

std::string map_error::message() const { return "map: " + what + "." + (remedy.empty() ? "" : " " + remedy + "."); }

} // namespace godwit::mapobjects_store
