#include "programs/godwitd/sightings/point_pictures.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>
#include <system_error>

#include "io/text.hpp"

namespace godwit::daemon {
namespace {

constexpr std::string_view ending = ".jpg";
constexpr std::string_view new_mark = ".new";

// The part before the next '_', which goes from TEXT.
std::string_view take_part(std::string_view& text) {
  const auto part = text.substr(0, text.find('_'));
  text.remove_prefix(std::min(text.size(), part.size() + 1));
  return part;
}

} // namespace

std::string point_pictures::stored::file() const {
  return std::to_string(captured_ns) + '_' + std::to_string(point) + '_' + mission_id + '_' + sighting_id +
         std::string(ending);
}

std::optional<point_pictures::stored> point_pictures::read_name(const std::string& name) {
  std::string_view rest = name;
  if (!rest.ends_with(ending))
    return std::nullopt;
  rest.remove_suffix(ending.size());
  stored result;
  const bool has_numbers =
      io::read_number(take_part(rest), result.captured_ns) && io::read_number(take_part(rest), result.point);
  result.mission_id = take_part(rest);
  result.sighting_id = rest;
  return has_numbers && !result.sighting_id.empty() ? std::optional(result) : std::nullopt;
}

point_pictures::point_pictures(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  for (const auto& each : std::filesystem::directory_iterator(folder_, failed)) {
    auto known = read_name(each.path().filename().string());
    if (!known)
      continue;
    known->is_new = std::filesystem::exists(each.path().string() + std::string(new_mark), failed);
    files_.push_back(*std::move(known));
  }
  std::ranges::sort(files_, {}, &stored::captured_ns);
}

void point_pictures::add(const std::string& sighting_id, io::eyes::cutout picture) {
  const std::lock_guard guard(mutex_);
  waiting_.emplace_back(sighting_id, std::move(picture));
  if (waiting_.size() > max_waiting)
    waiting_.pop_front();
}

void point_pictures::belongs(const std::string& sighting_id, const sighted_point& point) {
  const std::lock_guard guard(mutex_);
  const auto found = std::ranges::find(waiting_, sighting_id, &std::pair<std::string, io::eyes::cutout>::first);
  if (found == waiting_.end())
    return;
  const auto picture = std::move(found->second);
  waiting_.erase(found);
  const stored what{point.at_ns, point.number, point.mission_id, sighting_id};
  const auto before = std::ranges::find_if(files_, [&](const stored& each) {
    return each.point == what.point && each.is_new && each.mission_id == what.mission_id;
  });
  if (before != files_.end() && before->captured_ns > what.captured_ns)
    return;
  if (!write(what, picture.jpeg)) {
    ++lost_;
    return;
  }
  if (before != files_.end())
    remove(static_cast<std::size_t>(before - files_.begin()));
  files_.insert(std::ranges::upper_bound(files_, what.captured_ns, {}, &stored::captured_ns), what);
  if (files_.size() > max_files) {
    lost_ += files_.front().is_new ? 1U : 0U;
    remove(0);
  }
}

// The picture comes after its mark: one without a mark was noted.
bool point_pictures::write(const stored& what, const std::vector<std::byte>& jpeg) const {
  std::error_code failed;
  if (std::filesystem::create_directories(folder_, failed)) // people may be seen on them
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all, failed);
  const auto path = folder_ / what.file();
  const auto part = path.string() + ".part";
  const bool is_marked = std::ofstream(path.string() + std::string(new_mark)).good();
  std::ofstream file(part, std::ios::binary);
  file.write(reinterpret_cast<const char*>(jpeg.data()),
             static_cast<std::streamsize>(jpeg.size())); // bytes as characters
  file.close();
  const bool is_written = is_marked && file.good();
  using std::filesystem::perms;
  std::filesystem::permissions(part, perms::owner_read | perms::owner_write, failed);
  if (is_written)
    std::filesystem::rename(part, path, failed);
  if (is_written && !failed)
    return true;
  std::filesystem::remove(part, failed);
  std::filesystem::remove(path.string() + std::string(new_mark), failed);
  return false;
}

void point_pictures::remove(std::size_t index) {
  const auto path = folder_ / files_[index].file();
  std::error_code failed; // what stays is found by the next process
  std::filesystem::remove(path, failed);
  std::filesystem::remove(path.string() + std::string(new_mark), failed);
  files_.erase(files_.begin() + static_cast<std::ptrdiff_t>(index));
}

std::optional<point_picture> point_pictures::of(std::uint64_t point) const {
  const std::lock_guard guard(mutex_);
  const auto newest = std::ranges::find(files_.rbegin(), files_.rend(), point, &stored::point);
  if (newest == files_.rend())
    return std::nullopt;
  std::ifstream file(folder_ / newest->file(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto* const first = reinterpret_cast<const std::byte*>(bytes.data()); // characters as bytes
  return bytes.empty() ? std::nullopt
                       : std::optional(point_picture{newest->captured_ns, {first, first + bytes.size()}});
}

std::vector<std::uint64_t> point_pictures::points() const {
  const std::lock_guard guard(mutex_);
  std::set<std::uint64_t> result;
  for (const auto& each : files_)
    result.insert(each.point);
  return {result.begin(), result.end()};
}

std::optional<mission_client::deliver_picture> point_pictures::next() const {
  const std::lock_guard guard(mutex_);
  const auto found = std::ranges::find(files_, true, &stored::is_new);
  if (found == files_.end())
    return std::nullopt;
  return mission_client::deliver_picture{found->mission_id, found->sighting_id, found->file(), found->captured_ns};
}

void point_pictures::noted(const std::string& file) {
  const std::lock_guard guard(mutex_);
  for (auto& each : files_)
    if (each.is_new && each.file() == file) {
      each.is_new = false;
      std::error_code failed; // it is noted once more by the next process, which changes nothing
      std::filesystem::remove(folder_ / (file + std::string(new_mark)), failed);
    }
}

std::uint64_t point_pictures::lost() const {
  const std::lock_guard guard(mutex_);
  return lost_;
}

} // namespace godwit::daemon
