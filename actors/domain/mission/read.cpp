#include "actors/domain/mission/read.hpp"

#include <string>
#include <utility>

#include "actors/domain/mission/json_document.hpp"
#include "actors/domain/mission/judge.hpp"
#include "actors/domain/mission/rules.hpp"
#include "actors/domain/mission/schema_store.hpp"
#include "io/fields/json_value.hpp"
#include "io/json_schema/compiled_schema.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

tl::unexpected<document_error> failed(document_errc code, document_problems problems, std::string_view text) {
  return tl::unexpected(bounded({code, std::move(problems)}, text));
}

// A document of another major version may have any form; that its form is wrong would be a misleading answer.
document_problems foreign_version(const json& value) {
  if (!value.is_object() || !value.contains("schema_version") || !value["schema_version"].is_string())
    return {};
  static const io::schemas::compiled_schema form(schema_named("mission")["properties"]["schema_version"]);
  const auto& version = value["schema_version"].get_ref<const std::string&>();
  if (is_known_version(version) || !form.holds(version))
    return {};
  return {{"/schema_version", "is " + in_quotes(version), std::string(known_versions)}};
}

// "items[3].altitude_m" to "/items/3/altitude_m"
std::string pointer_of(const std::string& path) {
  std::string result = path.empty() ? "" : "/";
  for (const auto each : path)
    if (each == '.' || each == '[')
      result += '/';
    else if (each != ']')
      result += each;
  return result;
}

template <class T>
void drop_unknown(json& value) {
  for (auto each = value.begin(); each != value.end();) {
    bool is_known = false;
    io::for_each_field<T>([&](const auto& entry) { is_known = is_known || entry.name == each.key(); });
    each = is_known ? std::next(each) : value.erase(each);
  }
}

} // namespace

template <class T>
read_result<T> read(std::string_view text) {
  constexpr auto form = form_of<T>;
  auto value = parse_document(text, form.max_bytes);
  if (!value)
    return tl::unexpected(std::move(value.error()));
  if (auto problems = foreign_version(*value); !problems.empty())
    return failed(document_errc::other_version, std::move(problems), text);
  if (auto problems = violations(*value, form.schema, form.by); !problems.empty())
    return failed(document_errc::wrong_form, std::move(problems), text);
  if constexpr (form.is_open)
    drop_unknown<T>(*value);
  T result;
  if (const auto fields = io::read_json(*value, result); !fields)
    return failed(document_errc::wrong_form, {{pointer_of(fields.error().path), fields.error().what, {}}}, text);
  if (auto problems = broken_rules(result); !problems.empty())
    return failed(document_errc::broken_rule, std::move(problems), text);
  return result;
}

template read_result<document> read(std::string_view text);
template read_result<assignment> read(std::string_view text);
template read_result<assignment_list> read(std::string_view text);
template read_result<assignment_response> read(std::string_view text);
template read_result<waypoint_insert> read(std::string_view text);
template read_result<tail> read(std::string_view text);
template read_result<progress_report> read(std::string_view text);
template read_result<progress_batch> read(std::string_view text);
template read_result<map_object_page> read(std::string_view text);
template read_result<ignored_item_page> read(std::string_view text);
template read_result<observation_batch> read(std::string_view text);
template read_result<ignored_item_batch> read(std::string_view text);
template read_result<observation_picture> read(std::string_view text);
template read_result<map_object_bundle> read(std::string_view text);
template read_result<receipt> read(std::string_view text);
template read_result<progress_status> read(std::string_view text);
template read_result<next_mission> read(std::string_view text);
template read_result<problem> read(std::string_view text);

} // namespace godwit::mission
