// Names of the forms that a struct with a field table has (JSON, its schema, the binary form of the trace), without the
// code that makes them: for headers of types that say themselves how they are written. Thread: none.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

namespace godwit::io {

class byte_sink;    // binary.hpp
class byte_source;  // binary.hpp
class json_reading; // json_value.hpp

template <class V>
[[nodiscard]] nlohmann::json json_schema(); // json_schema.hpp

template <class V>
void append_decoded_json(std::string& out, byte_source& source); // binary.hpp

// "items[3].altitude_m: expected a number, found \"high\""
struct json_mismatch {
  std::string path;
  std::string what;
  [[nodiscard]] std::string message() const { return (path.empty() ? std::string("document") : path) + ": " + what; }
};

using json_read_result = tl::expected<void, json_mismatch>;

} // namespace godwit::io
