// What every importer is told and gives back. Thread: plain values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/domain/mission/commands/command_table.hpp"
#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/error.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

struct import_options {
  bool allow_partial = false;               // take what can be taken; else a loss is an error
  std::optional<std::string> mission_id;    // UUID; absent: made from the text, so that a file always has the same
  std::optional<vehicle_profile> vehicle{}; // who is to fly it; absent: as far as the file says it
  bool fence_alone = false;           // what holds a fence and no items is taken: to be written again, nobody flies it
  allowed_commands allowed{};         // flight.allowed_commands
  std::optional<double> altitude_m{}; // above home, where a file has places without heights (KML)
  bool keeps_unknown = false;         // properties that the importer does not know are no losses
};

struct imported {
  document mission;
  loss_list losses; // empty unless allow_partial
};

struct exported {
  std::string text;
  loss_list losses;
};

struct conversion_error {
  document_error error;
  loss_list losses; // when the code is `lossy`, and what was noticed before another error

  [[nodiscard]] std::string message() const;
};

using import_result = tl::expected<imported, conversion_error>;

// Where the parts of a mission stand in the file that they were read from.
struct source_place {
  std::string place; // "line 7", or a JSON pointer
  std::string name;  // what it is called there: "item 3, NAV_WAYPOINT"; may be empty
};

struct source_map {
  std::vector<source_place> items; // of the mission, in its order; what is not there has no other place
  std::vector<source_place> geofences;
  std::string list;         // of the items: "/mission/items"
  bool holds_items = false; // the file has some, whatever became of them
};

// ERROR with its places in the mission as places in the file.
[[nodiscard]] document_error in_source(document_error error, const document& mission, const source_map& source);

// What a document without items holds instead.
[[nodiscard]] std::string why_no_mission(const document& without_items);

// The last step of every importer: MISSION if it keeps all rules and nothing was lost, or what stands in the way.
[[nodiscard]] import_result finished(const document& mission, loss_list losses, const import_options& options,
                                     std::string_view source, const source_map& places = {});

// A UUID of version 8 (RFC 9562) that is always the same for the same text.
[[nodiscard]] std::string uuid_of_text(std::string_view text);

[[nodiscard]] conversion_error lossy(loss_list losses, std::string_view source);

} // namespace godwit::mission
