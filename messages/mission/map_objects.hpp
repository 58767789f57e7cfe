// What the service and the vehicle tell each other of the map: pages that are pulled before the flight, batches that
// are pushed after it. Degrees (WGS 84), metres above mean sea level, times as text (UTC, RFC 3339). Schemas:
// map_object*, observation*, ignored_item* in config/schemas. Thread: plain values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::mission {

struct map_object {
  std::string object_id; // UUID
  std::string class_group;
  double latitude = 0;
  double longitude = 0;
  std::optional<double> altitude_m;
  double confidence = 0; // 0 to 1
  std::string first_seen;
  std::string last_seen;

  static constexpr auto fields =
      io::table("mission.map_object", io::field("object_id", &map_object::object_id),
                io::field("class_group", &map_object::class_group), io::field("latitude", &map_object::latitude),
                io::field("longitude", &map_object::longitude), io::field("altitude_m", &map_object::altitude_m),
                io::field("confidence", &map_object::confidence), io::field("first_seen", &map_object::first_seen),
                io::field("last_seen", &map_object::last_seen));
  friend bool operator==(const map_object&, const map_object&) = default;
};

// Nothing of this class is to be reported from this cell again.
struct ignored_item {
  std::string ignored_id; // UUID
  std::string mgrs_cell;
  std::string class_group;
  std::string at; // when it was declined

  static constexpr auto fields =
      io::table("mission.ignored_item", io::field("ignored_id", &ignored_item::ignored_id),
                io::field("mgrs_cell", &ignored_item::mgrs_cell), io::field("class_group", &ignored_item::class_group),
                io::field("at", &ignored_item::at));
  friend bool operator==(const ignored_item&, const ignored_item&) = default;
};

enum class observation_kind { fresh, moved, existing, ignored, removed_candidate };

constexpr auto enum_names(observation_kind) {
  return io::names<observation_kind>({{observation_kind::fresh, "new"},
                                      {observation_kind::moved, "moved"},
                                      {observation_kind::existing, "existing"},
                                      {observation_kind::ignored, "ignored"},
                                      {observation_kind::removed_candidate, "removed_candidate"}});
}

struct observation {
  std::string observation_id;           // UUID; a repetition changes nothing
  std::optional<std::string> object_id; // absent for a new one
  observation_kind kind = observation_kind::fresh;
  std::string class_group;
  double latitude = 0;
  double longitude = 0;
  std::optional<double> altitude_m;
  double confidence = 0;
  std::string at;

  static constexpr auto fields =
      io::table("mission.observation", io::field("observation_id", &observation::observation_id),
                io::field("object_id", &observation::object_id), io::field("kind", &observation::kind),
                io::field("class_group", &observation::class_group), io::field("latitude", &observation::latitude),
                io::field("longitude", &observation::longitude), io::field("altitude_m", &observation::altitude_m),
                io::field("confidence", &observation::confidence), io::field("at", &observation::at));
  friend bool operator==(const observation&, const observation&) = default;
};

struct map_object_page {
  std::string schema_version;
  std::vector<map_object> map_objects;
  std::optional<std::string> next; // absent on the last page

  static constexpr auto fields =
      io::table("mission.map_object_page", io::field("schema_version", &map_object_page::schema_version),
                io::field("map_objects", &map_object_page::map_objects), io::field("next", &map_object_page::next));
  friend bool operator==(const map_object_page&, const map_object_page&) = default;
};

struct ignored_item_page {
  std::string schema_version;
  std::vector<ignored_item> ignored_items;
  std::optional<std::string> next;

  static constexpr auto fields = io::table(
      "mission.ignored_item_page", io::field("schema_version", &ignored_item_page::schema_version),
      io::field("ignored_items", &ignored_item_page::ignored_items), io::field("next", &ignored_item_page::next));
  friend bool operator==(const ignored_item_page&, const ignored_item_page&) = default;
};

struct observation_batch {
  std::string idempotency_key; // UUID
  std::vector<observation> observations;

  static constexpr auto fields =
      io::table("mission.observation_batch", io::field("idempotency_key", &observation_batch::idempotency_key),
                io::field("observations", &observation_batch::observations));
  friend bool operator==(const observation_batch&, const observation_batch&) = default;
};

struct ignored_item_batch {
  std::string idempotency_key;
  std::vector<ignored_item> ignored_items;

  static constexpr auto fields =
      io::table("mission.ignored_item_batch", io::field("idempotency_key", &ignored_item_batch::idempotency_key),
                io::field("ignored_items", &ignored_item_batch::ignored_items));
  friend bool operator==(const ignored_item_batch&, const ignored_item_batch&) = default;
};

// All that is known of the map, as it is kept in a file.
struct map_object_bundle {
  std::string schema_version;
  std::string fetched_at;
  bool fallback_used = false; // the service could not be asked
  std::vector<map_object> map_objects;
  std::vector<ignored_item> ignored_items;

  static constexpr auto fields =
      io::table("mission.map_object_bundle", io::field("schema_version", &map_object_bundle::schema_version),
                io::field("fetched_at", &map_object_bundle::fetched_at),
                io::field("fallback_used", &map_object_bundle::fallback_used),
                io::field("map_objects", &map_object_bundle::map_objects),
                io::field("ignored_items", &map_object_bundle::ignored_items));
  friend bool operator==(const map_object_bundle&, const map_object_bundle&) = default;
};

} // namespace godwit::mission
