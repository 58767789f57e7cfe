// Any bytes as a file of a ground station, in each format: refused with a sentence, or a mission that keeps the rules,
// whose losses are refused when they are not allowed, and that every format can write.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "actors/domain/mission/convert/convert.hpp"
#include "actors/domain/mission/rules.hpp"

namespace {

using namespace godwit::mission;

[[noreturn]] void finding(const char* what) {
  std::fprintf(stderr, "finding: %s\n", what);
  std::abort();
}

constexpr mission_format formats[] = {mission_format::plan, mission_format::geojson, mission_format::waypoints,
                                      mission_format::json, mission_format::kml};

void check(std::string_view text, mission_format format) {
  const auto partial = import_mission(text, format, {true, {}});
  const auto whole = import_mission(text, format);
  if (!partial) {
    if (whole || partial.error().message().empty())
      finding("refused without a sentence, or taken only when nothing may be lost");
    return;
  }
  if (!broken_rules(partial->mission).empty())
    finding("what was taken breaks a rule");
  if (whole.has_value() != partial->losses.empty())
    finding("a loss that was allowed by default, or none that was refused");
  for (const auto to : formats) {
    if (!is_written(to))
      continue;
    const auto written = export_mission(partial->mission, to);
    // A file of lines without items, which is what surveys alone come to, is no mission.
    const bool is_whole = to != mission_format::waypoints && written.losses.empty();
    if (is_whole && !import_mission(written.text, to, {true, {}}))
      finding("what was written can not be read");
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const auto format : formats)
    check(text, format);
  return 0;
}
