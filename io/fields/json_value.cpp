#include "io/fields/json_value.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace godwit::io {

using nlohmann::json;

const json* json_reading::enter(const json& object, std::string_view name) {
  const auto found = object.find(name);
  if (found == object.end())
    return nullptr;
  place_.push_back({name});
  return &*found;
}

const json& json_reading::enter(const json& list, std::size_t index) {
  place_.push_back({{}, index});
  return list[index];
}

std::string json_reading::path() const {
  auto result = root_;
  for (const auto& each : place_) {
    if (each.name.empty())
      result += '[' + std::to_string(each.index) + ']';
    else
      result.append(result.empty() ? "" : ".").append(each.name);
  }
  return result;
}

bool json_reading::fail(const std::string& expected, const json& found) {
  constexpr std::size_t longest_sample = 80; // characters of the offending value that help a reader
  auto sample = found.dump(-1, ' ', false, json::error_handler_t::replace);
  if (sample.size() > longest_sample)
    sample = sample.substr(0, longest_sample) + "...";
  wrong_ = {path(), "expected " + expected + ", found " + sample};
  return false;
}

bool json_reading::fail_at(std::string_view name, const std::string& expected, const json& found) {
  place_.push_back({name});
  (void)fail(expected, found);
  place_.pop_back();
  return false;
}

bool json_reading::refuse_unknown(const json& object, std::span<const std::string_view> names) {
  for (auto each = object.begin(); each != object.end(); ++each) {
    if (std::ranges::find(names, std::string_view(each.key())) != names.end())
      continue;
    place_.push_back({each.key()});
    wrong_ = {path(), "unknown property"};
    place_.pop_back();
    return false;
  }
  return true;
}

bool json_reading::expect_object(const json& found) { return found.is_object() || fail("an object", found); }

bool json_reading::expect_list(const json& found, std::optional<std::size_t>& size) {
  if (!found.is_array())
    return fail("a list", found);
  if (size && *size != found.size())
    return fail("a list of " + std::to_string(*size), found);
  size = found.size();
  return true;
}

bool json_reading::read(const json& found, bool& out) {
  if (!found.is_boolean())
    return fail("true or false", found);
  out = found.get<bool>();
  return true;
}

// Null is what json_text writes for a number that JSON does not know.
bool json_reading::read(const json& found, double& out) {
  if (!found.is_number() && !found.is_null())
    return fail("a number", found);
  out = found.is_null() ? std::numeric_limits<double>::quiet_NaN() : found.get<double>();
  return true;
}

bool json_reading::read(const json& found, std::string& out) {
  if (!found.is_string())
    return fail("a text", found);
  out = found.get_ref<const std::string&>();
  return true;
}

bool json_reading::read(const json& found, std::span<char> out) {
  if (!found.is_string() || found.get_ref<const std::string&>().size() > out.size())
    return fail("a text of at most " + std::to_string(out.size()) + " bytes", found);
  std::ranges::fill(out, '\0');
  std::ranges::copy(found.get_ref<const std::string&>(), out.begin());
  return true;
}

bool json_reading::read(const json& found, std::int64_t least, std::uint64_t greatest, std::uint64_t& bits) {
  if (!found.is_number_integer())
    return fail("a whole number", found);
  const auto value = found.get<std::int64_t>();
  bits = found.is_number_unsigned() ? found.get<std::uint64_t>() : static_cast<std::uint64_t>(value);
  const bool is_negative = !found.is_number_unsigned() && value < 0;
  if (is_negative ? value < least : bits > greatest)
    return fail("a number from " + std::to_string(least) + " to " + std::to_string(greatest), found);
  return true;
}

bool json_reading::read(const json& found, std::span<const std::string_view> texts, std::size_t& index) {
  const auto match =
      found.is_string() ? std::ranges::find(texts, std::string_view(found.get_ref<const std::string&>())) : texts.end();
  index = static_cast<std::size_t>(match - texts.begin());
  if (match != texts.end())
    return true;
  std::string allowed;
  for (const auto& each : texts)
    allowed.append(allowed.empty() ? "one of \"" : ", \"").append(each).append("\"");
  return fail(allowed, found);
}

bool json_reading::is_null(const json& found) { return found.is_null(); }

json_read_result json_reading::result() const {
  if (wrong_)
    return tl::unexpected(*wrong_);
  return {};
}

std::string json_reading::message() const { return wrong_ ? wrong_->message() : std::string(); }

} // namespace godwit::io
