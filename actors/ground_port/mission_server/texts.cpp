#include "actors/ground_port/mission_server/texts.hpp"

#include <algorithm>
#include <array>

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_mission_type;
using mavlink::mav_severity;
using mavlink::sender;

constexpr auto any = std::nullopt;

constexpr std::array plain_rows{
    text_row{occasion::plan_received, any, mav_severity::info, "{plan}: {count} items taken from {who}"},
    text_row{occasion::cleared, any, mav_severity::info, "{plan}: cleared by {who}"},
    text_row{occasion::cleared_by_count, any, mav_severity::info, "{plan}: cleared by {who}"},
    text_row{occasion::clear_refused, any, mav_severity::warning, "{plan}: not cleared, it is being flown"},
    text_row{occasion::no_space, any, mav_severity::warning, "{plan}: {count} items, room for {room} only"},
    text_row{occasion::item_refused, any, mav_severity::warning, "{plan}: item {item}: {reason}"},
    text_row{occasion::fence_refused, any, mav_severity::warning, "{plan}: item {item}: no polygon and no circle"},
    text_row{occasion::upload_cancelled, any, mav_severity::info, "{plan}: upload cancelled by {who}"},
    text_row{occasion::upload_timed_out, any, mav_severity::warning, "{plan}: no item {item} from {who}, given up"},
    text_row{occasion::count_while_written, any, mav_severity::notice, "{who} is refused: {whom} is uploading"},
    text_row{occasion::list_while_busy, any, mav_severity::notice, "{who} is refused: {whom} has a transfer"},
    text_row{occasion::clear_while_busy, any, mav_severity::notice, "{who} is refused: {whom} has a transfer"},
    text_row{occasion::count_while_read, any, mav_severity::notice, "{who} is refused: {whom} is downloading"},
};

constexpr std::array px4_rows{
    text_row{occasion::item_refused, any, mav_severity::critical, "IGN MISSION_ITEM: Invalid item\t"},
    text_row{occasion::upload_timed_out, any, mav_severity::critical, "Operation timeout\t"},
    text_row{occasion::download_timed_out, any, mav_severity::critical, "Operation timeout\t"},
    text_row{occasion::list_while_busy, any, mav_severity::info, "Mission download request ignored, already active\t"},
    text_row{occasion::clear_while_busy, any, mav_severity::critical, "WPM: IGN CLEAR CMD: Busy\t"},
    text_row{occasion::count_while_read, any, mav_severity::critical, "WPM: IGN MISSION_COUNT: Busy\t"},
    text_row{occasion::item_while_read, any, mav_severity::critical, "IGN MISSION_ITEM: Busy\t"},
    text_row{occasion::count_again, any, mav_severity::critical, "WPM: REJ. CMD: Busy\t"},
    text_row{occasion::foreign_item, any, mav_severity::critical, "REJ. MIS ITEM: partner id mismatch\t"},
    text_row{occasion::item_without_upload, any, mav_severity::critical, "IGN MISSION_ITEM: No transfer\t"},
};

constexpr std::array ardupilot_rows{
    text_row{occasion::plan_received, mav_mission_type::mission, mav_severity::info, "Flight plan received"},
    text_row{occasion::cleared_by_count, mav_mission_type::mission, mav_severity::info, "Flight plan received"},
    text_row{occasion::plan_received, mav_mission_type::fence, mav_severity::debug, "Fence Indexed OK"},
    text_row{occasion::cleared, mav_mission_type::fence, mav_severity::debug, "Fence Indexed OK"},
    text_row{occasion::no_space, any, mav_severity::warning, "Only {room} items are supported"},
    text_row{occasion::partial_list_refused, any, mav_severity::warning, "Flight plan update rejected"},
    text_row{occasion::upload_timed_out, any, mav_severity::warning, "Mission upload timeout"},
    text_row{occasion::float_item, any, mav_severity::warning, "got MISSION_ITEM; GCS should send MISSION_ITEM_INT",
             true},
    text_row{occasion::float_request, any, mav_severity::warning, "got MISSION_REQUEST; use MISSION_REQUEST_INT!",
             true},
};

std::string name_of(sender station) { return std::to_string(station.system) + "/" + std::to_string(station.component); }

std::string name_of_plan(std::uint8_t type) {
  switch (static_cast<mav_mission_type>(type)) {
  case mav_mission_type::mission:
    return "Mission";
  case mav_mission_type::fence:
    return "Fence";
  case mav_mission_type::rally:
    return "Rally";
  case mav_mission_type::all:
    return "All plans";
  }
  return "Plan of type " + std::to_string(type);
}

std::string in_words(mavlink::mav_mission_result reason) {
  std::string result(io::name_of(reason));
  std::replace(result.begin(), result.end(), '_', ' ');
  return result;
}

std::string value_of(std::string_view name, const text_facts& facts) {
  if (name == "plan")
    return name_of_plan(facts.type);
  if (name == "who")
    return name_of(facts.who);
  if (name == "whom")
    return name_of(facts.whom);
  if (name == "reason")
    return in_words(facts.reason);
  return std::to_string(name == "count" ? facts.count : name == "item" ? facts.item : facts.room);
}

} // namespace

std::span<const text_row> plain_texts() { return plain_rows; }
std::span<const text_row> px4_texts() { return px4_rows; }
std::span<const text_row> ardupilot_texts() { return ardupilot_rows; }

std::string filled(std::string_view text, const text_facts& facts) {
  std::string result;
  while (!text.empty()) {
    const auto opening = text.find('{');
    result += text.substr(0, opening);
    if (opening == std::string_view::npos)
      break;
    const auto closing = text.find('}', opening);
    result += value_of(text.substr(opening + 1, closing - opening - 1), facts);
    text.remove_prefix(closing + 1);
  }
  return result;
}

} // namespace godwit::ground_port::mission_server
