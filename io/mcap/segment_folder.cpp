#include "io/mcap/segment_folder.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <optional>
#include <tuple>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

namespace godwit::io::mcap {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t run_digits = 10;
constexpr std::size_t number_digits = 6;

bool is_prefix_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string segment_name(const segment_folder_options& options, std::uint64_t run, std::uint64_t number) {
  std::array<char, 48> digits;
  const int length = std::snprintf(digits.data(), digits.size(), "-%010llu-%06llu",
                                   static_cast<unsigned long long>(run), static_cast<unsigned long long>(number));
  return options.prefix + std::string(digits.data(), static_cast<std::size_t>(length)) + options.extension;
}

std::uint64_t number_in(std::string_view digits) {
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

// Run and number of a name of ours. Whether a name is ours is decided by making it again.
std::optional<segment> parse_name(const segment_folder_options& options, const std::string& name) {
  const auto run_at = options.prefix.size() + 1;
  if (name.size() != run_at + run_digits + 1 + number_digits + options.extension.size()) {
    return std::nullopt;
  }
  segment found;
  found.run = number_in(std::string_view{name}.substr(run_at, run_digits));
  found.number = number_in(std::string_view{name}.substr(run_at + run_digits + 1, number_digits));
  return segment_name(options, found.run, found.number) == name ? std::optional{found} : std::nullopt;
}

tl::unexpected<error> failed(const fs::path& path, std::string_view operation, const std::error_code& code) {
  return tl::make_unexpected(system_error(path.string(), operation, code.value()));
}

} // namespace

result<void> segment_folder::open(segment_folder_options options) {
  options_ = std::move(options);
  segments_.clear();
  if (auto checked = check_options(); !checked) {
    return checked;
  }
  return provide().and_then([this] { return list(); });
}

// Whoever owns the folder can put another file in the place of one of ours at any time.
result<void> segment_folder::provide() const {
  std::error_code code;
  if (fs::create_directories(options_.folder, code))
    fs::permissions(options_.folder, fs::perms::owner_all, code); // for this user alone
  if (code) {
    return failed(options_.folder, "create folder", code);
  }
  struct stat found {};
  if (::stat(options_.folder.c_str(), &found) != 0) {
    return tl::make_unexpected(system_error(options_.folder.string(), "stat folder", errno));
  }
  if (found.st_uid != ::geteuid()) {
    return tl::make_unexpected(error{errc::invalid_argument, options_.folder.string(),
                                     "it belongs to user " + std::to_string(found.st_uid) + ", and this is user " +
                                         std::to_string(::geteuid()) + ": name a folder of its own, or chown this one",
                                     0});
  }
  return {};
}

result<void> segment_folder::renew() {
  if (auto provided = provide(); !provided) {
    return provided;
  }
  std::erase_if(segments_, [](const segment& each) {
    std::error_code ignored;
    return !fs::exists(each.path, ignored);
  });
  return {};
}

result<void> segment_folder::check_options() const {
  const auto refuse = [&](std::string what) -> result<void> {
    return tl::make_unexpected(error{errc::invalid_argument, options_.folder.string(), std::move(what), 0});
  };
  if (options_.prefix.empty() || options_.prefix.size() > 64 ||
      !std::ranges::all_of(options_.prefix, is_prefix_character)) {
    return refuse("the prefix must be 1 to 64 letters, digits or '_'");
  }
  if (options_.segment_bytes < min_segment_bytes || options_.segment_bytes > max_segment_bytes) {
    return refuse("segment_bytes must be from " + std::to_string(min_segment_bytes) + " to " +
                  std::to_string(max_segment_bytes));
  }
  if (options_.total_bytes < 2 * options_.segment_bytes) {
    return refuse("total_bytes must be at least twice segment_bytes");
  }
  return {};
}

result<void> segment_folder::list() {
  std::error_code code;
  fs::directory_iterator entry{options_.folder, code};
  for (; !code && entry != fs::directory_iterator{}; entry.increment(code)) {
    std::optional<segment> found = parse_name(options_, entry->path().filename().string());
    if (!found || !entry->is_regular_file(code)) {
      continue;
    }
    found->path = entry->path();
    found->size_bytes = entry->file_size(code);
    segments_.push_back(*found);
  }
  if (code) {
    return failed(options_.folder, "list folder", code);
  }
  std::ranges::sort(segments_, {}, [](const segment& s) { return std::tuple{s.run, s.number}; });
  return {};
}

std::vector<segment_completion> segment_folder::complete_all() {
  std::vector<segment_completion> report;
  for (segment& s : segments_) {
    report.push_back({s.path, complete(s.path)});
    std::error_code code;
    const std::uintmax_t size_bytes = fs::file_size(s.path, code);
    s.size_bytes = code ? s.size_bytes : size_bytes;
  }
  return report;
}

result<fs::path> segment_folder::add(std::uint64_t run) {
  std::uint64_t number = run == last_run_ ? last_number_ + 1 : 1;
  for (const segment& s : segments_) {
    number = s.run == run ? std::max(number, s.number + 1) : number;
  }
  if (run > max_run || number > max_number) {
    return tl::make_unexpected(error{errc::too_many, options_.folder.string(), "no name left for a segment", 0});
  }
  if (auto room = make_room(); !room) {
    return tl::make_unexpected(room.error());
  }
  last_run_ = run;
  last_number_ = number;
  segment next{options_.folder / segment_name(options_, run, number), run, number, options_.segment_bytes};
  // It goes to the end even if its run sorts before others (a clock that was set back): the end is what is written now.
  segments_.push_back(next);
  return next.path;
}

result<void> segment_folder::make_room() {
  while (!segments_.empty() && total_bytes() + options_.segment_bytes > options_.total_bytes) {
    if (auto removed = remove(segments_.begin()); !removed) {
      return removed;
    }
    ++segments_deleted_;
  }
  return {};
}

result<void> segment_folder::remove(std::vector<segment>::iterator which) {
  std::error_code code;
  fs::remove(which->path, code); // that it is gone already is no error
  if (code) {
    return failed(which->path, "delete", code);
  }
  segments_.erase(which);
  return {};
}

void segment_folder::note_size(std::uint64_t size_bytes) {
  if (!segments_.empty()) {
    segments_.back().size_bytes = size_bytes;
  }
}

result<void> segment_folder::remove_newest() {
  return segments_.empty() ? result<void>{} : remove(segments_.end() - 1);
}

std::uint64_t segment_folder::total_bytes() const {
  std::uint64_t sum = 0;
  for (const segment& s : segments_) {
    sum += s.size_bytes;
  }
  return sum;
}

} // namespace godwit::io::mcap
