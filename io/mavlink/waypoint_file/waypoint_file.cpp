#include "io/mavlink/waypoint_file/waypoint_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "io/mavlink/waypoint_file/fence_rally_reader.hpp"
#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"
#include "io/mavlink/waypoint_file/waypoint_writer.hpp"

namespace godwit::io::mavlink {

namespace {

namespace fs = std::filesystem;

struct closer {
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};
using file_handle = std::unique_ptr<std::FILE, closer>;

tl::unexpected<waypoint_error> refused(const fs::path& path, std::string what) {
  return tl::make_unexpected(waypoint_error{waypoint_errc::io, path.string(), 0, {}, std::move(what)});
}

std::string words_of(int number) { return std::generic_category().message(number); }

waypoint_result<std::string> read_text(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return refused(path, "it is a folder, not a file");
  const file_handle file(std::fopen(path.c_str(), "rb"));
  if (!file)
    return refused(path, words_of(errno));
  std::string text;
  char piece[16 * 1024];
  while (const auto got = std::fread(piece, 1, sizeof piece, file.get())) {
    text.append(piece, got);
    if (text.size() > max_waypoint_file_bytes)
      return tl::make_unexpected(
          waypoint_error{waypoint_errc::too_large, path.string(), 0, {}, "it is too large for a plan"});
  }
  if (std::ferror(file.get()) != 0)
    return refused(path, words_of(errno));
  return text;
}

waypoint_result<void> write_text(const fs::path& path, const std::string& text) {
  file_handle file(std::fopen(path.c_str(), "wb"));
  if (!file)
    return refused(path, words_of(errno));
  if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() || std::fclose(file.release()) != 0)
    return refused(path, words_of(errno));
  return {};
}

template <class T>
waypoint_result<T> in_file(waypoint_result<T> result, const fs::path& path) {
  if (!result)
    result.error().file = path.string();
  return result;
}

} // namespace

waypoint_result<std::vector<mission_item_int>> load_waypoint_file(const fs::path& path, mav_mission_type type) {
  const auto text = read_text(path);
  if (!text)
    return tl::make_unexpected(text.error());
  const auto only_items = [](plan_lines plan) { return std::move(plan.items); };
  const auto holds = fence_or_rally(*text);
  if (!holds)
    return in_file(read_waypoints(*text, type), path);
  if (*holds != type)
    return refused(path, *holds == mav_mission_type::fence ? "it holds a fence" : "it holds rally points");
  return in_file(
      (*holds == mav_mission_type::fence ? read_fence_lines(*text) : read_rally_lines(*text)).map(only_items), path);
}

waypoint_result<void> save_waypoint_file(const fs::path& path, std::span<const mission_item_int> items) {
  const auto text = in_file(write_waypoints(items), path);
  if (!text)
    return tl::make_unexpected(text.error());
  // A device or a pipe is written to; it can not be replaced.
  std::error_code code;
  const auto kind = fs::status(path, code).type();
  if (kind != fs::file_type::regular && kind != fs::file_type::not_found && kind != fs::file_type::directory)
    return write_text(path, *text);
  const fs::path beside = path.string() + ".new";
  auto written = write_text(beside, *text);
  code.clear();
  if (written)
    fs::rename(beside, path, code);
  if (written && !code)
    return {};
  std::error_code ignored;
  fs::remove(beside, ignored);
  return refused(path, written ? code.message() : written.error().what);
}

} // namespace godwit::io::mavlink
