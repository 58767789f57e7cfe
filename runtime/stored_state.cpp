#include "runtime/stored_state.hpp"

#include <nlohmann/json.hpp>

namespace godwit::runtime {

void read_snapshot(const std::string& actor, const snapshot_record& snapshot, int version, state_migration migrate,
                   const message_type& type, void* state) {
  if (snapshot.version > version)
    throw state_unreadable(actor, "the snapshot has version " + std::to_string(snapshot.version) +
                                      ", this program knows up to " + std::to_string(version));
  auto document = nlohmann::json::parse(snapshot.body, nullptr, false);
  if (document.is_discarded())
    throw state_unreadable(actor, "the snapshot is not JSON");
  if (snapshot.version < version && migrate != nullptr) {
    auto migrated = migrate(std::move(document), snapshot.version);
    if (!migrated)
      throw state_unreadable(actor, migrated.error());
    document = std::move(*migrated);
  }
  if (const auto wrong = type.read_json(document, state); !wrong.empty())
    throw state_unreadable(actor, wrong);
}

std::string restored_json(const recovered& from, const snapshot_record& state) {
  std::string out = R"({"version":)" + std::to_string(state.version) + R"(,"last_event":)" +
                    std::to_string(state.number) + R"(,"at_ns":)" + std::to_string(state.at_ns) +
                    R"(,"durable_upto":)" + std::to_string(from.durable_upto) + R"(,"effects":[)";
  for (const auto& each : from.effects) {
    out += (&each == from.effects.data() ? R"({"event":)" : R"(,{"event":)") + std::to_string(each.id.event) +
           R"(,"n":)" + std::to_string(each.id.n) + R"(,"answer_to":)" + std::to_string(each.answer_to) +
           R"(,"type":")" + each.type + R"(","body":)" + each.body + '}';
  }
  return out + R"(],"state":)" + state.body + '}';
}

std::optional<recovered> read_restored(const nlohmann::json& document) {
  try {
    recovered result;
    result.last_event = document.at("last_event").get<std::int64_t>();
    result.durable_upto = document.at("durable_upto").get<std::int64_t>();
    result.snapshot = {result.last_event, document.at("at_ns").get<std::int64_t>(), document.at("version").get<int>(),
                       document.at("state").dump()};
    for (const auto& each : document.at("effects"))
      result.effects.push_back({{each.at("event").get<std::int64_t>(), each.at("n").get<std::uint32_t>()},
                                each.at("type").get<std::string>(),
                                each.at("body").dump(),
                                each.at("answer_to").get<std::uint64_t>()});
    return result;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void read_stored_json(const std::string& actor, const message_type& type, std::string_view body, void* value) {
  const auto document = nlohmann::json::parse(body, nullptr, false);
  if (document.is_discarded())
    throw state_unreadable(actor, "the body of a " + std::string(type.name) + " is not JSON");
  if (const auto wrong = type.read_json(document, value); !wrong.empty())
    throw state_unreadable(actor, std::string(type.name) + ": " + wrong);
}

} // namespace godwit::runtime
