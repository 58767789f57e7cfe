#include "io/json_schema/quoted.hpp"

#include "io/fields/json_text.hpp"

namespace godwit::io::schemas {

std::string in_quotes(std::string_view text) {
  std::string result;
  append_json_string(result, text.substr(0, longest_quote));
  if (text.size() > longest_quote)
    result.insert(result.size() - 1, "...");
  return result;
}

} // namespace godwit::io::schemas
