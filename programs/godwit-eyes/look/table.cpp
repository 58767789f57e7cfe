#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "programs/godwit-eyes/look/look.hpp"

namespace godwit::eyes {

namespace {

constexpr std::size_t most_rows = 30; // of tracks: those that were said longest

template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 300> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return std::string(text.data()) + "\n";
}

double quantile(std::vector<double> values, double share) {
  if (values.empty())
    return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string reason_lines(const look_summary& seen) {
  std::string result;
  for (int n = 1; n < unusable_count; ++n)
    if (const auto count = seen.reasons[static_cast<std::size_t>(n)]; count > 0) {
      const auto why = static_cast<unusable>(n);
      result += line("  %8llu  %s: %s", static_cast<unsigned long long>(count), std::string(name_of(why)).c_str(),
                     std::string(sentence_of(why)).c_str());
    }
  return result;
}

std::string track_lines(const look_summary& seen) {
  std::vector<std::pair<std::uint32_t, track_summary>> rows(seen.tracks.begin(), seen.tracks.end());
  std::ranges::stable_sort(rows, [](const auto& a, const auto& b) { return a.second.pictures > b.second.pictures; });
  std::string result = line("tracks     %zu", rows.size());
  if (rows.empty())
    return result;
  result += line("  %8s %9s %9s %9s %9s %9s %10s  %s", "track", "from s", "to s", "pictures", "size px", "px/s",
                 "confidence", "class");
  for (std::size_t n = 0; n < std::min(rows.size(), most_rows); ++n) {
    const auto& [number, its] = rows[n];
    const std::string what(its.looks_like == object_class::unknown ? "-" : io::name_of(its.looks_like));
    result += line("  %8u %9.2f %9.2f %9d %9.0f %9.0f %10.2f  %s", number, its.first_s, its.last_s, its.pictures,
                   its.size_px, its.speed_px_s, its.confidence, what.c_str());
  }
  if (rows.size() > most_rows)
    result += line("  and %zu that were reported for a shorter time", rows.size() - most_rows);
  return result;
}

} // namespace

std::string table_of(const look_summary& seen) {
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  const double seconds = seen.end_s - seen.begin_s;
  std::string result = line("pictures   %llu of %d x %d in %.2f s (%.1f a second)", count(seen.pictures), seen.width,
                            seen.height, seconds, seconds > 0 ? static_cast<double>(seen.pictures - 1) / seconds : 0);
  result += line("of use     %llu", count(seen.usable()));
  result += reason_lines(seen);
  result +=
      line("ground     residual p50 / p99 %.2f / %.2f px; corners moved by %.1f / %.1f px from picture to picture",
           quantile(seen.residuals_px, 0.5), quantile(seen.residuals_px, 0.99), quantile(seen.corner_shifts_px, 0.5),
           quantile(seen.corner_shifts_px, 0.99));
  result += line("time       p50 / p99 %.1f / %.1f ms of processor time a picture", quantile(seen.milliseconds, 0.5),
                 quantile(seen.milliseconds, 0.99));
  result += track_lines(seen);
  if (!seen.ended_early.empty())
    result += line("ended early: %s", seen.ended_early.c_str());
  return result;
}

} // namespace godwit::eyes
