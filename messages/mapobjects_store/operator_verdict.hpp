// What became of something that was shown to the operator. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

enum class verdict {
  confirmed,
  declined, // of no interest: the ignore list learns it
  timed_out // nobody looked: says nothing about the thing
};

constexpr auto enum_names(verdict) {
  return io::names<verdict>(
      {{verdict::confirmed, "confirmed"}, {verdict::declined, "declined"}, {verdict::timed_out, "timed_out"}});
}

// Answered with verdict_answer. Said again with the same id, it counts once.
struct operator_verdict {
  std::string id; // UUID; becomes the id of the ignored item
  std::string mission_id;
  std::string class_group;
  geo_position position; // of what was shown
  verdict said = verdict::timed_out;
  std::int64_t at_ns = 0;
  static constexpr auto fields = io::table(
      "mapobjects_store.operator_verdict", io::field("id", &operator_verdict::id),
      io::field("mission_id", &operator_verdict::mission_id), io::field("class_group", &operator_verdict::class_group),
      io::field("position", &operator_verdict::position), io::field("said", &operator_verdict::said),
      io::field("at_ns", &operator_verdict::at_ns));
};

struct verdict_answer {
  std::optional<ignored_item> ignored; // what a decline has put on the ignore list
  map_failure failure = map_failure::none;
  std::string error;
  static constexpr auto fields =
      io::table("mapobjects_store.verdict_answer", io::field("ignored", &verdict_answer::ignored),
                io::field("failure", &verdict_answer::failure), io::field("error", &verdict_answer::error));
};

} // namespace godwit::mapobjects_store
