// Where the operator's API lies on the port. Thread: that of the port.
#pragma once

#include <memory>

#include "programs/godwitd/operator_port/operator_api.hpp"
#include "programs/godwitd/operator_port/route.hpp"

namespace godwit::operator_port {

[[nodiscard]] route_list routes_of(const std::shared_ptr<operator_api>& api);

} // namespace godwit::operator_port
