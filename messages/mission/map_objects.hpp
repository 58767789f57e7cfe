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

  GODWIT_FIELDS(map_object, "mission.map_object", object_id, class_group, latitude, longitude, altitude_m, confidence,
                first_seen, last_seen);
  friend bool operator==(const map_object&, const map_object&) = default;
};

// Nothing of this class is to be reported from this cell again.
struct ignored_item {
  std::string ignored_id; // UUID
  std::string mgrs_cell;
  std::string class_group;
  std::string at; // when it was declined

  GODWIT_FIELDS(ignored_item, "mission.ignored_item", ignored_id, mgrs_cell, class_group, at);
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

  GODWIT_FIELDS(observation, "mission.observation", observation_id, object_id, kind, class_group, latitude, longitude,
                altitude_m, confidence, at);
  friend bool operator==(const observation&, const observation&) = default;
};

struct map_object_page {
  std::string schema_version;
  std::vector<map_object> map_objects;
  std::optional<std::string> next;       // absent on the last page
  std::optional<std::string> since = {}; // as it was asked for: only what has changed since that mark; absent: all
  std::optional<std::vector<std::string>> removed{}; // since then; ids of objects
  std::optional<std::string> mark = {};              // what all pages show, to pull later what changes after it

  GODWIT_FIELDS(map_object_page, "mission.map_object_page", schema_version, map_objects, next, since, removed, mark);
  friend bool operator==(const map_object_page&, const map_object_page&) = default;
};

struct ignored_item_page {
  std::string schema_version;
  std::vector<ignored_item> ignored_items;
  std::optional<std::string> next;

  GODWIT_FIELDS(ignored_item_page, "mission.ignored_item_page", schema_version, ignored_items, next);
  friend bool operator==(const ignored_item_page&, const ignored_item_page&) = default;
};

struct observation_batch {
  std::string idempotency_key; // UUID
  std::vector<observation> observations;

  GODWIT_FIELDS(observation_batch, "mission.observation_batch", idempotency_key, observations);
  friend bool operator==(const observation_batch&, const observation_batch&) = default;
};

struct ignored_item_batch {
  std::string idempotency_key;
  std::vector<ignored_item> ignored_items;

  GODWIT_FIELDS(ignored_item_batch, "mission.ignored_item_batch", idempotency_key, ignored_items);
  friend bool operator==(const ignored_item_batch&, const ignored_item_batch&) = default;
};

// What the camera has shown of what an observation is about. It may come before its observation.
struct observation_picture {
  std::string idempotency_key; // UUID
  std::string observation_id;  // UUID; a repetition changes nothing
  std::string captured_at;
  std::string jpeg; // base64 (RFC 4648, 4)

  GODWIT_FIELDS(observation_picture, "mission.observation_picture", idempotency_key, observation_id, captured_at, jpeg);
  friend bool operator==(const observation_picture&, const observation_picture&) = default;
};

// All that is known of the map, as it is kept in a file.
struct map_object_bundle {
  std::string schema_version;
  std::string fetched_at;
  bool fallback_used = false; // the service could not be asked
  std::vector<map_object> map_objects;
  std::vector<ignored_item> ignored_items;

  GODWIT_FIELDS(map_object_bundle, "mission.map_object_bundle", schema_version, fetched_at, fallback_used, map_objects,
                ignored_items);
  friend bool operator==(const map_object_bundle&, const map_object_bundle&) = default;
};

} // namespace godwit::mission
