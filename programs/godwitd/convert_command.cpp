#include "programs/godwitd/convert_command.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "actors/domain/mission/read.hpp"
#include "programs/godwitd/console.hpp"

namespace godwit::daemon {
namespace {

using runtime::exit_code;
using text_or_error = tl::expected<std::string, std::string>;

text_or_error read_file(const std::string& file) {
  std::error_code ignored;
  if (const auto there = std::filesystem::status(file, ignored);
      std::filesystem::is_fifo(there) || std::filesystem::is_socket(there) || std::filesystem::is_directory(there))
    return tl::make_unexpected(file + " can not be read: it is not a regular file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) {
    text.resize(mission::max_mission_bytes + 1); // one more than allowed: the reader sees what is too large
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  }
  if (stream.bad() || !stream.is_open())
    return tl::make_unexpected(file + " can not be read: " + std::strerror(errno));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

// Under another name first, so that nobody finds half a mission.
tl::expected<void, std::string> write_file(const std::string& file, const std::string& text) {
  const auto fresh = file + ".new";
  errno = 0;
  {
    std::ofstream stream(fresh, std::ios::binary | std::ios::trunc);
    stream << text;
    if (!stream.flush())
      return tl::make_unexpected(fresh + " can not be written: " + std::strerror(errno));
  }
  std::error_code failed;
  std::filesystem::rename(fresh, file, failed);
  if (failed)
    return tl::make_unexpected(file + " can not be written: " + failed.message());
  return {};
}

std::optional<mission::mission_format> format_of(const std::string& file) {
  auto format = mission::format_of_name(file);
  if (!format)
    say(file + ": this ending means no format; known are " + mission::known_endings);
  return format;
}

exit_code fail(const std::string& sentence) {
  say(sentence);
  return exit_code::failed;
}

// What a conversion refused, and how to have it all the same.
std::string explained(const std::string& file, const mission::conversion_error& error) {
  if (error.error.code != mission::document_errc::lossy)
    return file + ": " + error.message();
  return file + " can not be carried over as a whole:\n" + error.losses.message() +
         "\nWith --allow-partial it is taken without that.";
}

} // namespace

tl::expected<mission::imported, std::string> load_mission_file(const std::string& file, bool allow_partial,
                                                               const mission::allowed_commands& allowed) {
  const auto format = mission::format_of_name(file);
  if (!format)
    return tl::make_unexpected(file + " has the ending of no mission format");
  const auto text = read_file(file);
  if (!text)
    return tl::make_unexpected(text.error());
  mission::import_options options;
  options.allow_partial = allow_partial;
  options.allowed = allowed;
  auto mission = mission::import_mission(*text, *format, options);
  if (!mission)
    return tl::make_unexpected(explained(file, mission.error()));
  return *std::move(mission);
}

exit_code run_convert(const convert_arguments& given, bool allow_partial) {
  const auto from = format_of(given.in);
  const auto to = format_of(given.out);
  if (!from || !to)
    return exit_code::usage;
  const auto text = read_file(given.in);
  if (!text)
    return fail(text.error());
  mission::import_options options{allow_partial, {}};
  if (!given.vehicle.empty())
    options.vehicle = io::value_of<mission::vehicle_profile>(given.vehicle);
  options.altitude_m = given.altitude_m;
  const auto result = mission::convert(*text, *from, *to, options);
  if (!result)
    return fail(explained(given.in, result.error()));
  if (const auto written = write_file(given.out, result->text); !written)
    return fail(written.error());
  if (!result->losses.empty())
    say(given.out + " is without this:\n" + result->losses.message());
  return exit_code::ok;
}

} // namespace godwit::daemon
