#include "programs/godwitd/sightings/sighting_feed.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "actors/domain/mission/utc_text.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::daemon {

using io::link::descriptor;

tl::expected<std::shared_ptr<sighting_feed>, std::string> sighting_feed::open(const std::string& file,
                                                                              const std::string& mission_id) {
  const bool is_input = file == "-";
  descriptor opened(is_input ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  const auto name = is_input ? "standard input" : file;
  if (!opened.is_open())
    return tl::make_unexpected("the sightings can not be read from " + name + ": " + std::strerror(errno));
  descriptor stop(::eventfd(0, EFD_CLOEXEC));
  if (!stop.is_open())
    return tl::make_unexpected(std::string("no descriptor is left for the sightings: ") + std::strerror(errno));
  return std::shared_ptr<sighting_feed>(new sighting_feed(name, mission_id, std::move(opened), std::move(stop)));
}

sighting_feed::sighting_feed(std::string name, std::string mission_id, descriptor file, descriptor stop)
    : name_(std::move(name)), mission_id_(std::move(mission_id)), file_(std::move(file)), stop_(std::move(stop)) {}

std::shared_ptr<sighting_feed> sighting_feed::without_file() {
  return std::shared_ptr<sighting_feed>(new sighting_feed("nowhere", {}, descriptor(), descriptor()));
}

sighting_feed::~sighting_feed() { stop(); }

void sighting_feed::start(waker wake, complainer complain) {
  wake_ = std::move(wake);
  complain_ = std::move(complain);
  thread_ = std::thread([this] { run(); });
}

void sighting_feed::stop() {
  {
    const std::lock_guard guard(mutex_);
    is_stopping_ = true;
  }
  room_.notify_all();
  const std::uint64_t one = 1;
  if (stop_.is_open())
    (void)!::write(stop_.number(), &one, sizeof one);
  if (thread_.joinable())
    thread_.join();
}

std::optional<sighting_feed::numbered> sighting_feed::take() {
  std::optional<numbered> result;
  {
    const std::lock_guard guard(mutex_);
    if (waiting_.empty()) {
      is_awake_ = false;
      return result;
    }
    result = std::move(waiting_.front());
    waiting_.pop_front();
    given_.emplace(result->number, result->seen);
  }
  room_.notify_all();
  return result;
}

void sighting_feed::resolve(std::uint64_t number, bool is_recorded) {
  const std::lock_guard guard(mutex_);
  if (given_.erase(number) != 0)
    ++(is_recorded ? counts_.recorded : counts_.refused);
}

void sighting_feed::take_back(std::uint64_t number) {
  const std::lock_guard guard(mutex_);
  if (auto found = given_.extract(number))
    waiting_.push_front({number, std::move(found.mapped())});
}

void sighting_feed::take_back_all() {
  const std::lock_guard guard(mutex_);
  while (!given_.empty()) {
    auto last = given_.extract(std::prev(given_.end()));
    waiting_.push_front({last.key(), std::move(last.mapped())});
  }
}

void sighting_feed::count_not_offered() {
  const std::lock_guard guard(mutex_);
  ++counts_.not_offered;
}

void sighting_feed::count_without_room() {
  const std::lock_guard guard(mutex_);
  ++counts_.refused;
}

bool sighting_feed::add(mapobjects_store::sighting seen) {
  const std::lock_guard guard(mutex_);
  if (waiting_.size() >= max_waiting)
    return false;
  waiting_.push_back({++last_number_, std::move(seen)});
  return true;
}

bool sighting_feed::is_over() const {
  const std::lock_guard guard(mutex_);
  return has_ended_ && waiting_.empty() && given_.empty();
}

sighting_counts sighting_feed::counts() const {
  const std::lock_guard guard(mutex_);
  return counts_;
}

void sighting_feed::run() {
  std::array<char, 16 * 1024> piece{};
  while (wait_readable()) {
    const auto count = ::read(file_.number(), piece.data(), piece.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN))
      continue;
    if (count < 0)
      pass_over("the sightings can not be read any further from " + name_ + ": " + std::strerror(errno));
    if (count <= 0)
      break;
    read_lines({piece.data(), static_cast<std::size_t>(count)});
  }
  if (!line_.empty())
    end_line();
  end();
}

// False: it is to end.
bool sighting_feed::wait_readable() const {
  for (;;) {
    std::array<pollfd, 2> watched{pollfd{file_.number(), POLLIN, 0}, pollfd{stop_.number(), POLLIN, 0}};
    const int ready = ::poll(watched.data(), watched.size(), -1);
    if (ready < 0 && errno == EINTR)
      continue;
    return ready > 0 && watched[1].revents == 0;
  }
}

void sighting_feed::read_lines(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto end = bytes.find('\n');
    line_.append(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    is_too_long_ = is_too_long_ || line_.size() > max_sighting_bytes;
    if (is_too_long_)
      line_.clear();
    if (end != std::string_view::npos)
      end_line();
  }
}

void sighting_feed::end_line() {
  const auto number = line_number_++;
  const auto line = std::exchange(line_, {});
  const bool was_too_long = std::exchange(is_too_long_, false);
  if (line.find_first_not_of(" \t\r") == std::string::npos && !was_too_long)
    return;
  const auto where = name_ + ", line " + std::to_string(number) + ": ";
  if (was_too_long) {
    pass_over(where + "is longer than " + std::to_string(max_sighting_bytes) + " bytes; it is passed over");
    return;
  }
  auto read = read_sighting(line, mission_id_);
  if (read)
    put(std::move(*read));
  else
    pass_over(where + read.error() + "; it is passed over");
}

void sighting_feed::pass_over(const std::string& why) {
  {
    const std::lock_guard guard(mutex_);
    ++counts_.unreadable;
  }
  complain_(why);
}

void sighting_feed::put(mapobjects_store::sighting seen) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return is_stopping_ || waiting_.size() < max_waiting; });
  if (is_stopping_)
    return;
  waiting_.push_back({++last_number_, std::move(seen)});
  if (std::exchange(is_awake_, true))
    return;
  lock.unlock();
  wake_();
}

void sighting_feed::end() {
  {
    const std::lock_guard guard(mutex_);
    if (is_stopping_)
      return;
    has_ended_ = true;
  }
  wake_();
}

namespace {

struct sighting_line {
  std::string id;
  std::string class_group;
  double latitude = 0;
  double longitude = 0;
  std::optional<double> altitude_m;
  double confidence = 0;
  std::string at;
  GODWIT_FIELDS(sighting_line, "godwitd.sighting_line", id, class_group, latitude, longitude, altitude_m, confidence,
                at);
};

constexpr std::array required{"id", "class_group", "latitude", "longitude", "confidence", "at"};

tl::expected<sighting_line, std::string> read_line(std::string_view line) {
  const auto document = nlohmann::json::parse(line, nullptr, false);
  if (!document.is_object())
    return tl::make_unexpected(std::string("is no JSON object"));
  for (const auto* each : required)
    if (!document.contains(each))
      return tl::make_unexpected("has no \"" + std::string(each) + "\"");
  sighting_line result;
  if (const auto read = io::read_json(document, result); !read)
    return tl::make_unexpected(read.error().message());
  return result;
}

// What the map would refuse, said before it is asked.
std::string objection_to(const sighting_line& line) {
  if (!ids::is_uuid(line.id))
    return "id: it is a UUID in small letters";
  if (!(std::abs(line.latitude) <= 90) || !(std::abs(line.longitude) <= 180))
    return "latitude and longitude: they are degrees, from -90 to 90 and from -180 to 180";
  if (!(line.confidence >= 0 && line.confidence <= 1))
    return "confidence: it is from 0 to 1";
  return {};
}

} // namespace

tl::expected<mapobjects_store::sighting, std::string> read_sighting(std::string_view line,
                                                                    const std::string& mission_id) {
  auto read = read_line(line);
  if (!read)
    return tl::make_unexpected(std::move(read.error()));
  if (auto objection = objection_to(*read); !objection.empty())
    return tl::make_unexpected(std::move(objection));
  const auto at_ns = mission::time_of_utc_text(read->at);
  if (!at_ns)
    return tl::make_unexpected(std::string("at: it is a time such as 2026-05-04T10:15:44Z"));
  return mapobjects_store::sighting{
      read->id, mission_id,      read->class_group, {read->latitude, read->longitude, read->altitude_m},
      *at_ns,   read->confidence};
}

} // namespace godwit::daemon
