#include "programs/godwit-trace/message_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/fields/hex_text.hpp"
#include "io/fields/json_text.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/ids.hpp"
#include "io/mavlink/messages.hpp"

namespace godwit::trace_tool {

namespace {

using io::mavlink::message_info;

// Levenshtein's: letters to insert, delete or change.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

} // namespace

void append_message_name(std::string& out, std::uint32_t id) {
  if (const auto* const info = io::mavlink::find_message(id))
    out += info->name;
  else
    out.append(unknown_prefix).append(std::to_string(id));
}

std::string message_name(std::uint32_t id) {
  std::string name;
  append_message_name(name, id);
  return name;
}

std::string_view nearest_message_name(std::string_view text) {
  const auto rank = [&](const message_info& info) {
    const bool contains = !text.empty() && info.name.find(text) != std::string_view::npos;
    return std::pair(!contains, edit_distance(text, info.name));
  };
  return std::ranges::min_element(io::mavlink::known_ids(), {}, rank)->name;
}

namespace {

constexpr std::size_t name_width = 20;        // of the longest that are decoded; others push their line to the right
constexpr std::size_t max_shown_payload = 16; // bytes
constexpr double max_plain = 1e9;             // whole numbers below are written with all their digits

template <class N>
requires std::is_arithmetic_v<N>
void append_number(std::string& out, N value) {
  if constexpr (std::is_floating_point_v<N>) {
    if (!std::isfinite(value)) {
      out += std::isnan(value) ? "NaN" : value < 0 ? "-inf" : "inf";
      return;
    }
    // An interval of 200000 us is easier to read than one of 2e+05.
    if (std::abs(value) < max_plain && value == std::trunc(value)) {
      io::append_json_number(out, static_cast<std::int64_t>(value));
      return;
    }
  }
  io::append_json_number(out, value);
}

template <class T, std::size_t N>
void append_array(std::string& out, const std::array<T, N>& values) {
  if constexpr (std::is_same_v<T, std::uint8_t>) {
    io::append_hex(out, std::as_bytes(std::span(values)));
  } else {
    out += '[';
    for (std::size_t i = 0; i < N; ++i) {
      out += i == 0 ? "" : ",";
      append_number(out, values[i]);
    }
    out += ']';
  }
}

// TEXT in quotes. What JSON lets pass and a terminal obeys is taken out: DEL, and the commands of ISO 6429 that are one
// character, U+0080 to U+009F.
void append_quoted(std::string& out, std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto at = [&](std::size_t place) {
      return place < text.size() ? static_cast<unsigned char>(text[place]) : 0U;
    };
    const bool is_command = at(i) == 0xC2U && at(i + 1) >= 0x80U && at(i + 1) <= 0x9FU;
    plain += is_command || at(i) == 0x7FU ? '?' : text[i];
    i += is_command ? 1 : 0;
  }
  io::append_json_string(out, plain);
}

template <class V>
void append_value(std::string& out, const V& value) {
  if constexpr (io::is_char_array<V>::value)
    append_quoted(out, io::text_in(value));
  else if constexpr (io::is_std_array<V>::value)
    append_array(out, value);
  else
    append_number(out, value);
}

void append_enum_name(std::string& out, std::span<const enum_field> named, std::string_view field,
                      std::uint64_t value) {
  const auto found = std::ranges::find(named, field, &enum_field::field);
  if (found == named.end())
    return;
  const auto before = out.size();
  out += '(';
  found->append_name(out, value);
  if (out.size() == before + 1)
    out.resize(before);
  else
    out += ')';
}

template <io::mavlink::message M>
void append_fields(std::string& out, const M& message) {
  const auto named = enum_fields_of(M::message_id);
  io::for_each_field<M>([&](const auto& entry) {
    out += ' ';
    out += entry.name;
    out += '=';
    if (entry.is_secret) {
      out += "(withheld)";
      return;
    }
    const auto& value = message.*entry.member;
    append_value(out, value);
    if constexpr (std::is_unsigned_v<std::remove_cvref_t<decltype(value)>>)
      append_enum_name(out, named, entry.name, value);
  });
}

void append_payload(std::string& out, const io::mavlink::frame_view& frame) {
  const auto payload = frame.payload();
  out += ' ' + std::to_string(payload.size()) + (payload.size() == 1 ? " byte" : " bytes");
  if (is_withheld(frame.id())) {
    out += " (withheld)";
    return;
  }
  out += ": ";
  io::append_hex(out, payload.first(std::min(payload.size(), max_shown_payload)));
  out += payload.size() > max_shown_payload ? "..." : "";
}

} // namespace

void append_message_text(std::string& out, const io::mavlink::frame_view& frame) {
  const auto begin = out.size();
  append_message_name(out, frame.id());
  const auto width = out.size() - begin;
  out.append(name_width - std::min(width, name_width), ' ');
  const bool is_ours = io::mavlink::visit(frame, [&](const auto& message) { append_fields(out, message); });
  if (!is_ours)
    append_payload(out, frame);
}

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

void append_message_json(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame) {
  out += "{\"time_us\":";
  io::append_json_number(out, time_us);
  out += ",\"system\":";
  io::append_json_number(out, frame.system());
  out += ",\"component\":";
  io::append_json_number(out, frame.component());
  out += ",\"sequence\":";
  io::append_json_number(out, frame.sequence());
  out += ",\"id\":";
  io::append_json_number(out, frame.id());
  out += ",\"name\":\"";
  append_message_name(out, frame.id());
  out += "\",\"signed\":";
  io::append_json_value(out, frame.is_signed());
  const bool is_ours = io::mavlink::visit(frame, [&](const auto& message) {
    out += ",\"fields\":";
    io::append_json(out, message);
  });
  if (!is_ours && !is_withheld(frame.id())) {
    out += ",\"payload\":\"";
    io::append_hex(out, frame.payload());
    out += '"';
  }
  out += '}';
}

} // namespace godwit::trace_tool
