// Arbitrary bytes as what a stranger sends to the HTTP server: the reader must end, within its bounds, and must not
// depend on how the bytes were cut on their way. Nothing of them may come back as a header of an answer.
//
// The first byte says the bounds and the size of the pieces; the rest is what comes over the line.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "io/http/server/request_reader.hpp"
#include "io/http/server/response_head.hpp"

namespace godwit::io::http {
namespace {

constexpr std::size_t small_body_bytes = 64;

void require(bool holds) {
  if (!holds)
    std::abort();
}

struct reading {
  std::vector<server_request> requests;
  std::vector<bool> kept;
  unsigned refused = 0; // status
};

server_settings bounds_of(std::uint8_t choice) {
  server_settings set;
  set.max_head_bytes = (choice & 1U) != 0 ? 256 : 16 * 1024;
  set.max_target_bytes = 128;
  set.max_body_bytes = 4096;
  return set;
}

void look_at(const server_request& asked, const server_settings& set) {
  require(asked.target.size() <= set.max_target_bytes && !asked.method.empty());
  require(asked.body.size() <= (asked.target == "/small" ? small_body_bytes : set.max_body_bytes));
  for (const auto& [name, value] : asked.headers)
    require(name.find_first_of("\r\n: ") == std::string::npos && value.find_first_of("\r\n") == std::string::npos);
}

reading read(std::span<const std::byte> bytes, std::uint8_t choice, std::size_t piece_bytes) {
  const auto set = bounds_of(choice);
  const body_limit limit = [](std::string_view, std::string_view target) {
    return target == "/small" ? small_body_bytes : std::string_view::npos;
  };
  request_reader reader(set, limit);
  reading seen;
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(piece_bytes, bytes.size()));
    bytes = bytes.subspan(piece.size());
    auto now = reader.feed(piece);
    while (now == progress::complete) {
      seen.kept.push_back(reader.can_be_kept());
      seen.requests.push_back(reader.take());
      look_at(seen.requests.back(), set);
      now = reader.next();
    }
    if (now == progress::refused) {
      seen.refused = reader.refusal().status;
      return seen;
    }
    require(reader.body_bytes() <= set.max_body_bytes);
  }
  return seen;
}

// What was refused must be refused however it comes; only for what else is wrong with it there may be two reasons.
void read_both_ways(std::span<const std::byte> bytes, std::uint8_t choice) {
  const auto whole = read(bytes, choice, request_reader::read_bytes);
  const auto cut = read(bytes, choice, 1U + (choice >> 4U));
  require(whole.requests.size() == cut.requests.size() && whole.kept == cut.kept);
  for (std::size_t i = 0; i < whole.requests.size(); ++i) {
    const auto& [a, b] = std::tie(whole.requests[i], cut.requests[i]);
    require(a.method == b.method && a.target == b.target && a.headers == b.headers && a.body == b.body);
  }
}

// Three lines, and the empty one: whatever the texts are.
void write_head(const std::string& text) {
  const auto head = response_head({.content_type = "", .headers = {{"X", text}, {text, "y"}}}, std::nullopt, false);
  require(std::ranges::count(head, '\n') == 4 && std::ranges::count(head, '\r') == 4);
}

} // namespace

static void run(std::span<const std::byte> input) {
  if (input.empty())
    return;
  const auto bytes = input.subspan(1);
  read_both_ways(bytes, std::to_integer<std::uint8_t>(input[0]));
  write_head({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

} // namespace godwit::io::http

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  godwit::io::http::run(std::as_bytes(std::span(data, size)));
  return 0;
}
