#include "programs/godwit-trace/message_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "io/fields/hex_text.hpp"
#include "io/fields/json_text.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-trace/enum_fields.hpp"
#include "programs/godwit-trace/message_name.hpp"
#include "programs/godwit-trace/withheld.hpp"

namespace godwit::trace_tool {

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

} // namespace godwit::trace_tool
