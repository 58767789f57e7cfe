#include "io/fields/json_value.hpp"

namespace godwit::io {

tl::unexpected<json_mismatch> mismatch(const std::string& path, const std::string& expected,
                                       const nlohmann::json& found) {
  constexpr std::size_t longest_sample = 80; // characters of the offending value that help a reader
  auto sample = found.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (sample.size() > longest_sample)
    sample = sample.substr(0, longest_sample) + "...";
  return tl::unexpected(json_mismatch{path, "expected " + expected + ", found " + sample});
}

} // namespace godwit::io
