#include "programs/godwitd/checks/restart_status.hpp"

namespace godwit::daemon {

std::string why_not_restart_now(const nlohmann::json& status) {
  const auto flight = status.value("flight", nlohmann::json::object());
  const auto sentence = flight.value("sentence", std::string("its status has no flight"));
  if (!status.value("ok", false) || !flight.contains("in_flight"))
    return "whether a flight is under way is not known: " + status.value("error", sentence);
  if (flight.value("in_flight", true))
    return "a flight is under way: " + sentence;
  if (flight.value("is_armed", true) || flight.value("phase", std::string()) == "starting")
    return "the vehicle is armed: " + sentence;
  return {};
}

} // namespace godwit::daemon
