// What a vehicle tells people about transfers, by STATUSTEXT: a table for each autopilot.
//
// A sentence may have {who} (the station), {whom} (the one that has the transfer), {plan}, {count}, {item}, {room} and
// {reason} in it. With names as long as they get it still fits into one STATUSTEXT. What autopilots say is quoted, the
// tab at the end of PX4's sentences included. Thread: values, pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"

namespace godwit::ground_port::mission_server {

namespace mavlink = io::mavlink;

enum class occasion : std::uint8_t {
  plan_received,
  cleared,
  cleared_by_count, // MISSION_COUNT with 0
  clear_refused,    // it is being flown
  no_space,
  partial_list_refused, // items that are not there
  item_refused,
  fence_refused, // its polygons or circles
  upload_cancelled,
  upload_timed_out,
  download_timed_out,
  count_while_written, // while there is an upload: a MISSION_COUNT or a partial list,
  list_while_busy,     // and while there is any transfer
  clear_while_busy,
  count_while_read,
  item_while_read,
  count_again, // of the same upload, too late
  foreign_item,
  item_without_upload,
  float_item,
  float_request,
};

struct text_row {
  occasion when{};
  std::optional<mavlink::mav_mission_type> type; // none: every type
  mavlink::mav_severity severity{};
  std::string_view text;
  bool once = false; // until the vehicle starts again
};

[[nodiscard]] std::span<const text_row> plain_texts();
[[nodiscard]] std::span<const text_row> px4_texts();
[[nodiscard]] std::span<const text_row> ardupilot_texts();

// What the sentences are filled with.
struct text_facts {
  std::uint8_t type = 0; // mav_mission_type
  mavlink::sender who{};
  mavlink::sender whom{};
  int count = 0;
  int item = 0;
  int room = 0;
  mavlink::mav_mission_result reason{};
};

[[nodiscard]] std::string filled(std::string_view text, const text_facts& facts);

} // namespace godwit::ground_port::mission_server
