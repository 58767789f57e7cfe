// The page of operators as it is built (programs/godwitd/page/built), inside of the program: GET / and what it needs.
//
// Each file is sent compressed to who takes gzip, and not again to who has it (ETag). The page runs scripts and styles
// of its own and nothing else, and asks no other host (Content-Security-Policy). Thread: that of the port.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "programs/godwitd/operator_port/route.hpp"

namespace godwit::operator_port {

struct page_file {
  std::string_view path; // "/page.js"
  std::string_view content_type;
  std::string_view bytes;
};

// That are built into the program.
[[nodiscard]] std::vector<page_file> page_files();

[[nodiscard]] route_list page_routes(const std::vector<page_file>& files = page_files());

} // namespace godwit::operator_port
