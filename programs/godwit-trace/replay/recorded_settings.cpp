#include "programs/godwit-trace/replay/recorded_settings.hpp"

#include <utility>

#include "programs/godwitd/configuration.hpp"

namespace godwit::trace_tool {

namespace {

using nlohmann::json;

// What the actors do does not depend on where the service is, but on that there is one.
json without_places(json document) {
  auto& service = document["service"];
  for (const auto& [name, value] : service.items())
    if (value.is_string())
      service[name] = name == "url" && !value.get<std::string>().empty() ? "https://left-out.invalid" : "";
  return document;
}

tl::expected<json, std::string> document_of(const std::map<std::string, std::string>& about, const std::string& file) {
  if (!file.empty())
    return daemon::effective_configuration({{"config", file}}, {});
  const auto found = about.find("settings");
  if (found == about.end())
    return tl::unexpected(std::string("the trace does not have the settings of the run, it is of an older godwitd; "
                                      "name its configuration with --settings"));
  auto document = json::parse(found->second, nullptr, false);
  if (!document.is_object())
    return tl::unexpected(std::string("the settings in the trace are damaged; name a configuration with --settings"));
  return document;
}

} // namespace

tl::expected<daemon::daemon_settings, std::string> recorded_settings(const std::map<std::string, std::string>& about,
                                                                     const std::string& file) {
  auto document = document_of(about, file);
  if (!document)
    return tl::unexpected(std::move(document.error()));
  try {
    auto settings = daemon::settings_from(without_places(*std::move(document)));
    if (settings)
      if (const auto mission = about.find("mission_id"); mission != about.end()) { // of a file that is not here
        settings->mission_id = mission->second;
        settings->flight.mission_id = mission->second;
      }
    return settings;
  } catch (const json::exception& why) { // of another version of godwitd
    return tl::unexpected("the settings of the run can not be read by this version: " + std::string(why.what()));
  }
}

} // namespace godwit::trace_tool
