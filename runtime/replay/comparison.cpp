#include "runtime/replay/comparison.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/utc_seconds.hpp"

namespace godwit::runtime {

namespace {

using nlohmann::json;

// Nanoseconds of one unit; 0: the name is no time's.
double unit_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 4> units{
      {{"_ns", 1}, {"_us", 1e3}, {"_ms", 1e6}, {"_s", 1e9}}};
  for (const auto& [ending, ns] : units)
    if (name.ends_with(ending))
      return ns;
  return 0;
}

// Nanoseconds since 1970 of "2026-05-04T10:15:30.25Z".
std::optional<double> utc_ns(const json& text) {
  if (!text.is_string())
    return std::nullopt;
  const std::string_view rest = text.get_ref<const std::string&>();
  const auto seconds =
      rest.ends_with('Z') ? io::parse_utc_seconds(rest.substr(0, io::utc_seconds_bytes)) : std::nullopt;
  if (!seconds)
    return std::nullopt;
  double fraction = 0;
  if (const auto point = rest.find('.'); point != rest.npos)
    (void)std::from_chars(rest.data() + point, rest.data() + rest.size(), fraction);
  return static_cast<double>(seconds->time_since_epoch().count()) * 1e9 + fraction * 1e9;
}

bool is_same_time(const json& a, const json& b, std::string_view name, std::int64_t tolerance_ns) {
  if (tolerance_ns == 0)
    return false;
  if (const auto one = utc_ns(a), other = utc_ns(b); one && other)
    return std::abs(*one - *other) <= static_cast<double>(tolerance_ns);
  const auto unit = unit_of(name);
  if (unit == 0 || !a.is_number() || !b.is_number())
    return false;
  const double rounding = a.is_number_integer() ? 1 : 0;
  const double apart = a.is_number_integer() && b.is_number_integer()
                           ? static_cast<double>(a.get<std::int64_t>() - b.get<std::int64_t>())
                           : a.get<double>() - b.get<double>();
  return std::abs(apart) <= static_cast<double>(tolerance_ns) / unit + rounding;
}

class comparer {
public:
  explicit comparer(std::int64_t tolerance_ns) : tolerance_ns_(tolerance_ns) {}

  void compare(const json& a, const json& b, const std::string& place, std::string_view name) {
    if (a == b || found_.size() >= max_field_differences || is_same_time(a, b, name, tolerance_ns_))
      return;
    if (a.is_object() && b.is_object())
      return compare_objects(a, b, place);
    if (a.is_array() && b.is_array() && a.size() == b.size()) {
      for (std::size_t i = 0; i < a.size(); ++i)
        compare(a[i], b[i], place + '[' + std::to_string(i) + ']', name);
      return;
    }
    found_.push_back({place, a.dump(), b.dump()});
  }
  [[nodiscard]] std::vector<field_difference> take() { return std::move(found_); }

private:
  void compare_objects(const json& a, const json& b, const std::string& place) {
    const auto prefix = place.empty() ? std::string() : place + '.';
    for (const auto& [name, value] : a.items()) {
      if (b.contains(name))
        compare(value, b[name], prefix + name, name);
      else
        found_.push_back({prefix + name, value.dump(), {}});
    }
    for (const auto& [name, value] : b.items())
      if (!a.contains(name))
        found_.push_back({prefix + name, {}, value.dump()});
  }

  const std::int64_t tolerance_ns_;
  std::vector<field_difference> found_;
};

} // namespace

std::vector<field_difference> differences(std::string_view expected, std::string_view produced,
                                          std::int64_t tolerance_ns) {
  if (expected == produced)
    return {};
  const auto a = json::parse(expected, nullptr, false);
  const auto b = json::parse(produced, nullptr, false);
  if (a.is_discarded() || b.is_discarded())
    return {{{}, std::string(expected), std::string(produced)}};
  comparer all(tolerance_ns);
  all.compare(a, b, {}, {});
  return all.take();
}

} // namespace godwit::runtime
