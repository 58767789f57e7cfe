#include "programs/godwitd/sightings/sighting_line.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "actors/domain/mission/utc_text.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::daemon {
namespace {

struct sighting_line {
  std::string id;
  std::string class_group;
  double latitude = 0;
  double longitude = 0;
  std::optional<double> altitude_m;
  double confidence = 0;
  std::string at;
  GODWIT_FIELDS(sighting_line, "godwitd.sighting_line", id, class_group, latitude, longitude, altitude_m, confidence,
                at);
};

constexpr std::array required{"id", "class_group", "latitude", "longitude", "confidence", "at"};

tl::expected<sighting_line, std::string> read_line(std::string_view line) {
  const auto document = nlohmann::json::parse(line, nullptr, false);
  if (!document.is_object())
    return tl::make_unexpected(std::string("is no JSON object"));
  for (const auto* each : required)
    if (!document.contains(each))
      return tl::make_unexpected("has no \"" + std::string(each) + "\"");
  sighting_line result;
  if (const auto read = io::read_json(document, result); !read)
    return tl::make_unexpected(read.error().message());
  return result;
}

// What the map would refuse, said before it is asked.
std::string objection_to(const sighting_line& line) {
  if (!ids::is_uuid(line.id))
    return "id: it is a UUID in small letters";
  if (!(std::abs(line.latitude) <= 90) || !(std::abs(line.longitude) <= 180))
    return "latitude and longitude: they are degrees, from -90 to 90 and from -180 to 180";
  if (!(line.confidence >= 0 && line.confidence <= 1))
    return "confidence: it is from 0 to 1";
  return {};
}

} // namespace

tl::expected<mapobjects_store::sighting, std::string> read_sighting(std::string_view line,
                                                                    const std::string& mission_id) {
  auto read = read_line(line);
  if (!read)
    return tl::make_unexpected(std::move(read.error()));
  if (auto objection = objection_to(*read); !objection.empty())
    return tl::make_unexpected(std::move(objection));
  const auto at_ns = mission::time_of_utc_text(read->at);
  if (!at_ns)
    return tl::make_unexpected(std::string("at: it is a time such as 2026-05-04T10:15:44Z"));
  return mapobjects_store::sighting{
      read->id, mission_id,      read->class_group, {read->latitude, read->longitude, read->altitude_m},
      *at_ns,   read->confidence};
}

} // namespace godwit::daemon
