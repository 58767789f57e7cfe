#include "actors/mapobjects_store/map_health.hpp"

#include "actors/mapobjects_store/answers.hpp"

namespace godwit::mapobjects_store {

namespace {

std::string owed_text(const map_status& known) {
  std::string text;
  if (known.pending + known.taken > 0)
    text = "; " + std::to_string(known.pending + known.taken) + " rows to deliver";
  if (known.orphaned > 0)
    text += "; " + std::to_string(known.orphaned) + " rows of missions that are gone";
  return text;
}

} // namespace

runtime::condition health_of(const map_result<map_writer_status>& writer, const std::optional<map_status>& known) {
  if (!writer)
    return {failure_of(writer.error().code) == map_failure::busy ? runtime::health_colour::yellow
                                                                 : runtime::health_colour::red,
            writer.error().message()};
  if (writer->failing)
    return {runtime::health_colour::red, writer->reason};
  if (!known)
    return {};
  if (known->failure != map_failure::none)
    return {runtime::health_colour::red, known->error};
  const bool old_map = known->sync == sync_state::degraded || known->sync == sync_state::failed ||
                       known->sync == sync_state::cached_fallback;
  return {old_map || known->orphaned > 0 ? runtime::health_colour::yellow : runtime::health_colour::green,
          "map: " + std::string(io::name_of(known->sync)) + owed_text(*known)};
}

} // namespace godwit::mapobjects_store
