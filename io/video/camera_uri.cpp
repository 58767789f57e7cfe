#include "io/video/camera_uri.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

namespace godwit::io::video {
namespace {

using parsed = tl::expected<camera_uri, std::string>;

constexpr std::size_t max_uri_bytes = 512;
constexpr std::array<std::string_view, 5> patterns{"ball", "black", "smpte", "snow", "white"};

tl::unexpected<std::string> wrong(std::string what) { return tl::make_unexpected(std::move(what)); }

struct number_row {
  std::string_view name;
  std::int64_t least;
  std::int64_t most;
  bool is_for_test;
  void (*put)(camera_uri& to, std::int64_t value);
};

constexpr std::array number_rows{
    number_row{"width", 64, 8192, false, [](camera_uri& to, std::int64_t v) { to.width_px = static_cast<int>(v); }},
    number_row{"height", 64, 8192, false, [](camera_uri& to, std::int64_t v) { to.height_px = static_cast<int>(v); }},
    number_row{"fps", 1, 240, false, [](camera_uri& to, std::int64_t v) { to.frames_per_s = static_cast<int>(v); }},
    number_row{"stop_after", 1, 1'000'000, true, [](camera_uri& to, std::int64_t v) { to.stop_after = v; }},
    number_row{"hang_after", 1, 1'000'000, true, [](camera_uri& to, std::int64_t v) { to.hang_after = v; }},
    number_row{"resize_after", 1, 1'000'000, true, [](camera_uri& to, std::int64_t v) { to.resize_after = v; }}};

// Each "name=number" of QUERY.
tl::expected<void, std::string> read_numbers(std::string_view query, camera_uri& to) {
  while (!query.empty()) {
    const auto each = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), each.size() + 1));
    const auto name = each.substr(0, each.find('='));
    const auto* const row = std::ranges::find(number_rows, name, &number_row::name);
    if (row == number_rows.end() || (row->is_for_test && to.kind != camera_kind::test))
      return tl::make_unexpected("\"" + std::string(name) + "\" means nothing there");
    const auto text = each.substr(std::min(each.size(), name.size() + 1));
    std::int64_t value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || value < row->least || value > row->most)
      return tl::make_unexpected(std::string(name) + " is a number from " + std::to_string(row->least) + " to " +
                                 std::to_string(row->most));
    row->put(to, value);
  }
  if ((to.width_px == 0) != (to.height_px == 0))
    return tl::make_unexpected(std::string("width and height go together"));
  return {};
}

parsed with_query(camera_uri result, std::string_view rest) {
  const auto question = rest.find('?');
  result.where = std::string(rest.substr(0, question));
  if (question != std::string_view::npos)
    if (auto read = read_numbers(rest.substr(question + 1), result); !read)
      return wrong(std::move(read.error()));
  return result;
}

parsed of_device(std::string_view rest) {
  auto result = with_query({camera_kind::device, {}}, rest);
  if (result && !result->where.starts_with('/'))
    return wrong("a camera of this computer is a device file, such as v4l2:///dev/video0");
  return result;
}

parsed of_test(std::string_view rest) {
  camera_uri defaults{camera_kind::test, {}, 640, 360, 30};
  auto result = with_query(defaults, rest);
  if (result && std::ranges::find(patterns, result->where) == patterns.end())
    return wrong("test:// knows the patterns ball, black, smpte, snow and white");
  return result;
}

} // namespace

parsed parse_camera_uri(std::string_view text) {
  if (text.size() > max_uri_bytes)
    return wrong("it is longer than " + std::to_string(max_uri_bytes) + " characters");
  if (std::ranges::any_of(text, [](char each) { return static_cast<unsigned char>(each) <= ' ' || each == 0x7F; }))
    return wrong("it holds a space or a control character");
  const auto end = text.find("://");
  const auto scheme = text.substr(0, end);
  const auto rest = end == std::string_view::npos ? std::string_view() : text.substr(end + 3);
  if (!rest.empty()) {
    if (scheme == "v4l2")
      return of_device(rest);
    if (scheme == "test")
      return of_test(rest);
    if (scheme == "rtsp" || scheme == "rtsps")
      return camera_uri{camera_kind::network, std::string(text)};
    if (scheme == "file" && rest.starts_with('/'))
      return camera_uri{camera_kind::file, std::string(text)};
  }
  return wrong("it is none of v4l2:///dev/video0, rtsp://host:port/path, file:///path/to/recording and test://ball");
}

camera_uri recording_at(std::string_view path) {
  constexpr std::string_view as_they_are = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/-._~";
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char each : path) {
    if (as_they_are.find(each) != std::string_view::npos) {
      uri += each;
      continue;
    }
    const auto byte = static_cast<unsigned char>(each);
    uri += '%';
    uri += digits[byte / 16U];
    uri += digits[byte % 16U];
  }
  return {camera_kind::file, std::move(uri)};
}

std::string path_of(const camera_uri& file) {
  constexpr std::string_view scheme = "file://";
  const auto text = std::string_view(file.where).substr(scheme.size());
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    unsigned byte = 0;
    if (text[at] == '%' && at + 2 < text.size() &&
        std::from_chars(text.data() + at + 1, text.data() + at + 3, byte, 16).ptr == text.data() + at + 3) {
      result += static_cast<char>(byte);
      at += 2;
    } else {
      result += text[at];
    }
  }
  return result;
}

std::string without_password(std::string_view text) {
  const auto begin = text.find("://");
  const auto at = text.find('@', begin == std::string_view::npos ? 0 : begin);
  if (begin == std::string_view::npos || at == std::string_view::npos || text.find('/', begin + 3) < at)
    return std::string(text);
  const auto colon = text.find(':', begin + 3);
  if (colon == std::string_view::npos || colon > at)
    return std::string(text);
  return std::string(text.substr(0, colon + 1)) + "***" + std::string(text.substr(at));
}

} // namespace godwit::io::video
