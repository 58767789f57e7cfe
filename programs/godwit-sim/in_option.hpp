// What is wrong with an option, as a sentence that begins with its name. Thread: any.
#pragma once

#include <string>

#include <tl/expected.hpp>

namespace godwit::sim {

[[nodiscard]] inline tl::unexpected<std::string> in_option(const char* option, const std::string& sentence) {
  return tl::unexpected(std::string(option) + ": " + sentence);
}

} // namespace godwit::sim
