#include "runtime/config/document_path.hpp"

#include <algorithm>

#include "io/json_schema/quoted.hpp"

namespace godwit::runtime {

namespace {

bool is_plain(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') || character == '_' || character == '-' || character == '$';
}

} // namespace

std::string readable_key(std::string_view key) {
  if (!key.empty() && key.size() <= io::schemas::longest_quote && std::all_of(key.begin(), key.end(), is_plain))
    return std::string(key);
  return io::schemas::in_quotes(key);
}

std::string path_to_key(std::string_view parent, std::string_view key) {
  return parent.empty() ? readable_key(key) : std::string(parent) + "." + readable_key(key);
}

std::string path_to_item(std::string_view parent, std::size_t index) {
  return std::string(parent) + "[" + std::to_string(index) + "]";
}

} // namespace godwit::runtime
