// The addresses of this computer, as they are now. Those of one line alone (fe80::) are left out, since nobody names
// them without the line. Errors: none are known, and the list is empty. Thread: any. Source: getifaddrs(3).
#pragma once

#include <string>
#include <vector>

namespace godwit::operator_port {

[[nodiscard]] std::vector<std::string> own_addresses();

} // namespace godwit::operator_port
