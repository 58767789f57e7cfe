#include "runtime/variant_json.hpp"

#include <nlohmann/json.hpp>

namespace godwit::runtime {

void read_stored_json(const std::string& actor, const message_type& type, std::string_view body, void* value) {
  const auto document = nlohmann::json::parse(body, nullptr, false);
  if (document.is_discarded())
    throw state_unreadable(actor, "the body of a " + std::string(type.name) + " is not JSON");
  if (const auto wrong = type.read_json(document, value); !wrong.empty())
    throw state_unreadable(actor, std::string(type.name) + ": " + wrong);
}

} // namespace godwit::runtime
