#include "programs/godwit-sim/vehicle/autopilot/file_server.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

namespace godwit::sim {

namespace {

enum opcode : std::uint8_t {
  none = 0,
  terminate_session = 1,
  reset_sessions = 2,
  open_file_ro = 4,
  read_file = 5,
  burst_read_file = 15,
  ack = 128,
  nak = 129
};

enum error : std::uint8_t { invalid_session = 4, end_of_file = 6, unknown_command = 7, file_not_found = 10 };

// In the payload of the message: network, target system, target component, and the protocol's own header after.
constexpr std::size_t target_at = 1;
constexpr std::size_t sequence_at = 3;
constexpr std::size_t session_at = 5;
constexpr std::size_t opcode_at = 6;
constexpr std::size_t size_at = 7;
constexpr std::size_t asked_opcode_at = 8;
constexpr std::size_t offset_at = 11;
constexpr std::size_t data_at = 15;
constexpr std::size_t full_length = 254;
constexpr std::size_t most_data = full_length - data_at;
constexpr std::size_t most_of_a_burst = 500;

std::uint8_t byte_in(mavlink::byte_view bytes, std::size_t at) { // what was cut off is 0
  return at < bytes.size() ? std::to_integer<std::uint8_t>(bytes[at]) : std::uint8_t{0};
}

template <class V>
void append(std::vector<std::byte>& to, V value) {
  const auto bytes = std::bit_cast<std::array<std::byte, sizeof value>>(value);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

} // namespace

struct file_server::request {
  std::uint16_t sequence = 0;
  std::uint8_t session = 0;
  std::uint8_t opcode = 0;
  std::uint32_t offset = 0;
  std::uint8_t size = 0;
  std::string path;
};

struct file_server::reply {
  std::uint8_t opcode = ack;
  std::uint32_t offset = 0;
  std::vector<std::byte> data = {};

  static reply refusal(std::uint8_t why, std::uint32_t offset = 0) { return {nak, offset, {std::byte{why}}}; }
};

std::vector<file_server::payload> file_server::on(mavlink::sender from, mavlink::byte_view asked,
                                                  const std::vector<file>& files) {
  request what;
  what.sequence = static_cast<std::uint16_t>(byte_in(asked, sequence_at) | byte_in(asked, sequence_at + 1) << 8U);
  what.session = byte_in(asked, session_at);
  what.opcode = byte_in(asked, opcode_at);
  what.size = byte_in(asked, size_at);
  for (std::size_t i = 0; i < sizeof what.offset; ++i)
    what.offset |= static_cast<std::uint32_t>(byte_in(asked, offset_at + i)) << 8U * i;
  for (std::size_t i = 0; i < what.size && i < most_data; ++i)
    if (const auto each = byte_in(asked, data_at + i); each != 0)
      what.path += static_cast<char>(each);

  std::vector<payload> result;
  auto sequence = what.sequence;
  const auto answer = [&](const reply& each) {
    payload next(full_length);
    next[target_at] = std::byte{from.system};
    next[target_at + 1] = std::byte{from.component};
    ++sequence;
    next[sequence_at] = static_cast<std::byte>(sequence & 0xFFU);
    next[sequence_at + 1] = static_cast<std::byte>(sequence >> 8U);
    next[session_at] = std::byte{what.session};
    next[opcode_at] = std::byte{each.opcode};
    next[size_at] = static_cast<std::byte>(each.data.size());
    next[asked_opcode_at] = std::byte{what.opcode};
    for (std::size_t i = 0; i < sizeof each.offset; ++i)
      next[offset_at + i] = static_cast<std::byte>(each.offset >> 8U * i & 0xFFU);
    std::ranges::copy(each.data, next.begin() + data_at);
    result.push_back(std::move(next));
  };

  switch (what.opcode) {
  case none:
    answer({});
    break;
  case terminate_session:
  case reset_sessions:
    is_open_ = false;
    answer({});
    break;
  case open_file_ro:
    answer(open(what, files));
    break;
  case read_file:
    answer(read(what, what.offset));
    break;
  case burst_read_file: {
    auto at = std::size_t{what.offset};
    for (std::size_t i = 0; i < most_of_a_burst; ++i) {
      const auto next = read(what, at);
      answer(next);
      at += next.data.size();
      if (next.opcode == nak)
        break;
    }
    break;
  }
  default:
    answer(reply::refusal(unknown_command));
  }
  return result;
}

file_server::reply file_server::open(const request& asked, const std::vector<file>& files) {
  const auto found = std::ranges::find(files, asked.path, &file::path);
  if (found == files.end())
    return reply::refusal(file_not_found);
  is_open_ = true;
  session_ = asked.session;
  content_ = found->content;
  reply result;
  append(result.data, found->size_told);
  return result;
}

file_server::reply file_server::read(const request& asked, std::size_t offset) const {
  const auto told = static_cast<std::uint32_t>(offset);
  if (!is_open_ || asked.session != session_)
    return reply::refusal(invalid_session, told);
  if (offset >= content_.size())
    return reply::refusal(end_of_file, told);
  const auto wanted = asked.size == 0 ? most_data : std::min<std::size_t>(asked.size, most_data);
  const auto from = content_.begin() + static_cast<std::ptrdiff_t>(offset);
  const auto count = static_cast<std::ptrdiff_t>(std::min(wanted, content_.size() - offset));
  return {ack, told, std::vector<std::byte>(from, from + count)};
}

// After a header, for each parameter: type and flags, how much of the name is that of the one before and how long the
// rest is, the rest, the value.
file_server::file param_file(const std::vector<role::param>& params) {
  constexpr std::uint16_t magic = 0x671B;
  constexpr std::uint32_t size_told = 1024U * 1024U; // not counted for each station that opens it
  file_server::file result{"@PARAM/param.pck", {}, size_told};
  append(result.content, magic);
  append(result.content, static_cast<std::uint16_t>(params.size()));
  append(result.content, static_cast<std::uint16_t>(params.size()));
  std::string before;
  for (const auto& each : params) {
    constexpr std::ptrdiff_t most_in_common = 15;
    const auto differs = std::ranges::mismatch(before, each.name).in2;
    const auto in_common = std::min(differs - each.name.begin(), most_in_common);
    const auto rest = each.name.substr(static_cast<std::size_t>(in_common));
    const auto kind = each.type == 2 ? 1 : each.type == 4 ? 2 : each.type == role::param_type_int32 ? 3 : 4;
    result.content.push_back(static_cast<std::byte>(kind));
    result.content.push_back(static_cast<std::byte>(in_common | static_cast<std::ptrdiff_t>(rest.size() - 1) << 4U));
    std::ranges::transform(rest, std::back_inserter(result.content),
                           [](char letter) { return static_cast<std::byte>(letter); });
    if (kind == 1)
      append(result.content, static_cast<std::int8_t>(each.value));
    else if (kind == 2)
      append(result.content, static_cast<std::int16_t>(each.value));
    else if (kind == 3)
      append(result.content, static_cast<std::int32_t>(each.value));
    else
      append(result.content, each.value);
    before = each.name;
  }
  return result;
}

} // namespace godwit::sim
