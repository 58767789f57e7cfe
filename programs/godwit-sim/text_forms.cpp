#include "programs/godwit-sim/text_forms.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

namespace godwit::sim {

namespace {

constexpr std::size_t max_quoted_length = 80;
constexpr double longest_s = 365.0 * 24 * 3'600;

struct unit {
  std::string_view name;
  double seconds;
};
constexpr unit units[] = {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}, {"min", 60}}; // a name comes before those that end it

template <class T>
std::optional<T> read_all(std::string_view text) {
  T value{};
  const auto* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || error != std::errc{} || stopped != end)
    return std::nullopt;
  return value;
}

} // namespace

std::optional<double> read_number(std::string_view text) {
  const auto value = read_all<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> read_whole_number(std::string_view text) { return read_all<std::uint64_t>(text); }

std::optional<std::chrono::nanoseconds> read_duration(std::string_view text) {
  for (const auto& each : units) {
    if (!text.ends_with(each.name))
      continue;
    const auto number = read_number(text.substr(0, text.size() - each.name.size()));
    if (!number)
      continue;
    const double seconds = *number * each.seconds;
    if (seconds < 0 || seconds > longest_s)
      return std::nullopt;
    return std::chrono::nanoseconds(std::llround(seconds * 1e9));
  }
  return std::nullopt;
}

std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} ? std::string(text.data(), end) : std::string();
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> result;
  for (;;) {
    const auto at = text.find(separator);
    result.push_back(trimmed(text.substr(0, at)));
    if (at == std::string_view::npos)
      return result;
    text.remove_prefix(at + 1);
  }
}

std::string in_quotes(std::string_view text) {
  std::string shown = "\"";
  for (const char each : text.substr(0, max_quoted_length))
    shown += each >= ' ' && each <= '~' ? each : '?';
  return shown + (text.size() > max_quoted_length ? "...\"" : "\"");
}

} // namespace godwit::sim

namespace godwit::sim::missions {

tl::expected<std::string, std::string> read_text_file(const std::string& name, std::size_t max_bytes) {
  errno = 0;
  std::ifstream file(name, std::ios::binary);
  if (!file)
    return tl::unexpected(name + " can not be read: " + std::generic_category().message(errno));
  std::string text(max_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad())
    return tl::unexpected(name + " can not be read: " + std::generic_category().message(errno));
  if (text.size() > max_bytes)
    return tl::unexpected(name + " has more than " + std::to_string(max_bytes) + " bytes");
  return text;
}

} // namespace godwit::sim::missions
