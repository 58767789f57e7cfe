#include "actors/executor/flight/authority_text.hpp"

namespace godwit::executor {
namespace {

std::string_view text_of(flight::holder who) {
  switch (who) {
  case flight::holder::godwit:
    return "godwit";
  case flight::holder::person:
    return "person";
  case flight::holder::autopilot_end:
    return "autopilot_end";
  case flight::holder::autopilot_failsafe:
    break;
  }
  return "autopilot_failsafe";
}

} // namespace

// What the record says comes before what is watched: after a landing nobody is watched, and it still is a person's.
std::string_view authority_text(const flight_context& flight) {
  if (flight.failsafe_status && flight.failsafe_status->reacts)
    return "failsafe";
  switch (flight.s.status.cause) {
  case pause_cause::taken_over:
    return "person";
  case pause_cause::failsafe:
    return "failsafe";
  case pause_cause::autopilot_failsafe:
    return "autopilot_failsafe";
  default:
    break;
  }
  if (flight.pending.is_pending())
    return "pending";
  const bool is_over = !flight.is_in_flight() && !flight.is_starting(); // a start that failed
  if (flight.authority.is_watching() && is_over)
    return flight.view.is_armed() ? "unclear" : "nobody";
  if (!flight.authority.is_watching())
    return flight.is_in_flight() ? "unclear" : "nobody";
  return flight.authority.is_unclear() || flight.authority.is_uncertain() ? "unclear" : text_of(flight.authority.who());
}

} // namespace godwit::executor
