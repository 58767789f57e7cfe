#include "actors/ground_port/station_rules.hpp"

namespace godwit::ground_port {

std::optional<station_rules::objection> station_rules::look() const {
  using mavlink::mav_result;
  if (!role_)
    return std::nullopt;
  if (*role_ < operators::role::operator_)
    return objection{mav_result::denied, "stations only look here", "wrong_role"};
  if (!holder_)
    return objection{mav_result::temporarily_rejected, "who has control is not known yet", "no_control"};
  if (!holder_->empty())
    return objection{mav_result::temporarily_rejected, *holder_ + " has control", "no_control"};
  return std::nullopt;
}

} // namespace godwit::ground_port
