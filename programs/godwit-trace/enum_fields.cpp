#include "programs/godwit-trace/enum_fields.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"

namespace godwit::trace_tool {

namespace {

using namespace io::mavlink;

void append_in_capitals(std::string& out, std::string_view name) {
  for (const char each : name)
    out += each >= 'a' && each <= 'z' ? static_cast<char>(each - 'a' + 'A') : each;
}

template <class E>
void append_value(std::string& out, std::uint64_t value) {
  if (value <= std::numeric_limits<std::underlying_type_t<E>>::max())
    append_in_capitals(out, io::name_of(static_cast<E>(value)));
}

template <class E>
void append_bits(std::string& out, std::uint64_t value) {
  bool first = true;
  for (const auto& [bit, name] : enum_names(E{})) {
    if ((value & number(bit)) == 0)
      continue;
    out += std::exchange(first, false) ? "" : "|";
    append_in_capitals(out, name);
  }
}

template <message M>
constexpr enum_field row(std::string_view field, void (*append_name)(std::string&, std::uint64_t)) {
  return {M::message_id, field, append_name};
}

constexpr enum_field rows[] = {
    row<heartbeat>("type", append_value<mav_type>),
    row<heartbeat>("autopilot", append_value<mav_autopilot>),
    row<heartbeat>("base_mode", append_bits<mav_mode_flag>),
    row<heartbeat>("system_status", append_value<mav_state>),
    row<set_mode>("base_mode", append_bits<mav_mode_flag>),
    row<gps_raw_int>("fix_type", append_value<gps_fix_type>),
    row<mission_item>("frame", append_value<mav_frame>),
    row<mission_item>("command", append_value<mav_cmd>),
    row<mission_item>("mission_type", append_value<mav_mission_type>),
    row<mission_request>("mission_type", append_value<mav_mission_type>),
    row<mission_current>("mission_state", append_value<mission_state>),
    row<mission_current>("mission_mode", append_value<mission_mode>),
    row<mission_request_list>("mission_type", append_value<mav_mission_type>),
    row<mission_count>("mission_type", append_value<mav_mission_type>),
    row<mission_clear_all>("mission_type", append_value<mav_mission_type>),
    row<mission_ack>("type", append_value<mav_mission_result>),
    row<mission_ack>("mission_type", append_value<mav_mission_type>),
    row<mission_request_int>("mission_type", append_value<mav_mission_type>),
    row<mission_item_int>("frame", append_value<mav_frame>),
    row<mission_item_int>("command", append_value<mav_cmd>),
    row<mission_item_int>("mission_type", append_value<mav_mission_type>),
    row<command_int>("frame", append_value<mav_frame>),
    row<command_int>("command", append_value<mav_cmd>),
    row<command_long>("command", append_value<mav_cmd>),
    row<command_ack>("command", append_value<mav_cmd>),
    row<command_ack>("result", append_value<mav_result>),
    row<command_cancel>("command", append_value<mav_cmd>),
    row<extended_sys_state>("landed_state", append_value<mav_landed_state>),
    row<statustext>("severity", append_value<mav_severity>),
};
static_assert(std::ranges::is_sorted(rows, {}, &enum_field::message_id));

} // namespace

std::span<const enum_field> enum_fields() { return rows; }

std::span<const enum_field> enum_fields_of(std::uint32_t message_id) {
  const auto* const begin = std::ranges::lower_bound(rows, message_id, {}, &enum_field::message_id);
  const auto* const end = std::ranges::upper_bound(rows, message_id, {}, &enum_field::message_id);
  return {begin, end};
}

} // namespace godwit::trace_tool
