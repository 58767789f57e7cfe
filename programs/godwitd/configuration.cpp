#include "programs/godwitd/configuration.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#include "io/json_schema/compiled_schema.hpp"
#include "io/json_schema/sentence_parts.hpp"
#include "runtime/assert.hpp"
#include "runtime/config/config.hpp"
#include "runtime/config/schema.hpp"

namespace godwit::daemon {

namespace {

constexpr std::string_view variable_prefix = "GODWIT_";

tl::expected<void, std::string> check_known(const given_texts& environment) {
  std::vector<std::string> known;
  for (const auto& row : option_rows)
    known.push_back(variable_of(row));
  for (const auto& [name, text] : environment) {
    if (std::find(known.begin(), known.end(), name) != known.end())
      continue;
    const auto near = io::schemas::nearest_word(name, known);
    return tl::make_unexpected("the variable " + name + " of the environment means nothing to godwitd" +
                               (near ? "; did you mean " + *near + "?" : ": take it out"));
  }
  return {};
}

nlohmann::json value_of_text(const option_row& row, const std::string& text) {
  if (row.kind == option_kind::flag && (text == "true" || text == "1"))
    return true;
  if (row.kind == option_kind::flag && (text == "false" || text == "0"))
    return false;
  return text;
}

// NAME is what people typed. A value that the schema does not allow is the only thing that can be wrong with DOCUMENT.
tl::expected<void, std::string> put(nlohmann::json& document, const io::schemas::compiled_schema& schema,
                                    const option_row& row, const std::string& name, const std::string& text) {
  document[nlohmann::json::json_pointer(std::string(row.place))] = value_of_text(row, text);
  const auto problems = runtime::violations(document, schema);
  if (problems.empty())
    return {};
  return tl::make_unexpected(name + " " + problems.front().what + "; allowed: " + problems.front().allowed);
}

// Where the first text with a control character stands. A file name would end at a zero.
std::optional<std::string> control_character_in(const nlohmann::json& document, const std::string& place) {
  if (document.is_string()) {
    const auto is_control = [](char each) { return static_cast<unsigned char>(each) < 0x20 || each == 0x7F; };
    return std::ranges::any_of(document.get_ref<const std::string&>(), is_control) ? std::optional(place)
                                                                                   : std::nullopt;
  }
  if (document.is_structured())
    for (const auto& [key, value] : document.items())
      if (auto found = control_character_in(value, place.empty() ? key : place + "." + key))
        return found;
  return std::nullopt;
}

// The text given for OPTION, the stronger place first.
const std::string* config_file(const given_texts& command_line, const given_texts& environment) {
  const auto given = command_line.find(config_option);
  if (given != command_line.end())
    return &given->second;
  const auto named = environment.find(variable_of(*find_option(config_option)));
  return named == environment.end() ? nullptr : &named->second;
}

} // namespace

tl::expected<nlohmann::json, std::string> effective_configuration(const given_texts& command_line,
                                                                  const given_texts& environment) {
  if (auto known = check_known(environment); !known)
    return tl::make_unexpected(std::move(known.error()));
  const auto* const file = config_file(command_line, environment);
  auto document = file == nullptr ? runtime::load_config("{}", "defaults", runtime::godwit_schema())
                                  : runtime::load_config_file(*file, runtime::godwit_schema());
  if (!document)
    return tl::make_unexpected(document.error().message());
  const io::schemas::compiled_schema schema(nlohmann::json::parse(runtime::godwit_schema()));
  for (const auto& row : option_rows) {
    if (row.place.empty())
      continue;
    tl::expected<void, std::string> taken;
    if (const auto given = command_line.find(row.name); given != command_line.end())
      taken = put(*document, schema, row, "--" + given->first, given->second);
    else if (const auto named = environment.find(variable_of(row)); named != environment.end())
      taken = put(*document, schema, row, named->first, named->second);
    if (!taken)
      return tl::make_unexpected(std::move(taken.error()));
  }
  if (const auto place = control_character_in(*document, ""))
    return tl::make_unexpected(*place + " holds a control character: no file and no address has one");
  return *std::move(document);
}

given_texts godwit_variables() {
  given_texts result;
  for (char** each = environ; *each != nullptr; ++each) {
    const std::string_view entry = *each;
    const auto end = entry.find('=');
    if (entry.starts_with(variable_prefix) && end != std::string_view::npos)
      result.emplace(entry.substr(0, end), entry.substr(end + 1));
  }
  return result;
}

const option_row* find_option(std::string_view name) {
  const auto* const found = std::ranges::find(option_rows, name, &option_row::name);
  return found == option_rows.end() ? nullptr : found;
}

std::string variable_of(const option_row& row) {
  std::string result = "GODWIT_";
  for (const char each : row.name)
    result += each == '-' ? '_' : static_cast<char>(each - 'a' + 'A');
  return result;
}

std::string all_names_of(std::string_view option) {
  const auto* const row = find_option(option);
  GODWIT_ASSERT(row != nullptr, "only options of the table are named");
  std::string result = "--" + std::string(option) + " (" + variable_of(*row);
  if (!row->place.empty()) {
    std::string place(row->place.substr(1));
    std::ranges::replace(place, '/', '.');
    result += ", " + place;
  }
  return result + ")";
}

} // namespace godwit::daemon
