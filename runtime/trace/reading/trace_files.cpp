#include "runtime/trace/reading/trace_files.hpp"

#include <algorithm>
#include <system_error>
#include <tuple>

#include "io/text.hpp"

namespace godwit::runtime {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".mcap";
constexpr std::string_view folder_of_traces = "trace";

// PREFIX-RUN-NUMBER.mcap, as io/mcap/segment_folder.hpp names them.
trace_file file_named(const fs::path& path) {
  trace_file result{path};
  const auto name = path.stem().string();
  const auto second = name.rfind('-');
  const auto first = second == std::string::npos || second == 0 ? std::string::npos : name.rfind('-', second - 1);
  std::uint64_t run = 0;
  std::uint64_t number = 0;
  if (first != std::string::npos &&
      io::read_number(std::string_view(name).substr(first + 1, second - first - 1), run) &&
      io::read_number(std::string_view(name).substr(second + 1), number)) {
    result.run = run;
    result.number = number;
  }
  return result;
}

tl::expected<void, std::string> add_folder(const fs::path& folder, std::vector<trace_file>& to) {
  std::error_code code;
  const auto before = to.size();
  for (fs::directory_iterator each(folder, code), end; !code && each != end; each.increment(code))
    if (each->path().extension() == extension)
      to.push_back(file_named(each->path()));
  if (code)
    return tl::unexpected(folder.string() + ": " + code.message());
  if (to.size() > before)
    return {};
  if (fs::is_directory(folder / folder_of_traces, code))
    return add_folder(folder / folder_of_traces, to);
  return tl::unexpected(folder.string() + ": there is no .mcap file in it, and none in a folder trace/ below it");
}

} // namespace

tl::expected<std::vector<trace_file>, std::string> find_trace_files(std::span<const std::string> paths) {
  std::vector<trace_file> result;
  for (const auto& each : paths) {
    std::error_code code;
    const auto status = fs::status(each, code);
    if (!fs::exists(status))
      return tl::unexpected(each + ": no such file or folder");
    if (code)
      return tl::unexpected(each + ": " + code.message());
    if (!fs::is_directory(status)) {
      if (!fs::is_regular_file(status))
        return tl::unexpected(each + ": it is neither a file on a disk nor a folder");
      result.push_back(file_named(each));
    } else if (auto added = add_folder(each, result); !added) {
      return tl::unexpected(added.error());
    }
  }
  std::ranges::stable_sort(
      result, [](const auto& a, const auto& b) { return std::tie(a.run, a.number) < std::tie(b.run, b.number); });
  return result;
}

} // namespace godwit::runtime
