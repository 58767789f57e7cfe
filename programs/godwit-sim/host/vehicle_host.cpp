#include "programs/godwit-sim/host/vehicle_host.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "programs/godwit-sim/host/control_answers.hpp"

namespace godwit::sim {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

} // namespace

tl::expected<std::unique_ptr<vehicle_host>, std::string> vehicle_host::open(host_settings settings, teller tell) {
  std::unique_ptr<vehicle_host> host(new vehicle_host(std::move(settings), std::move(tell)));
  if (auto started = host->start(); !started)
    return tl::make_unexpected(std::move(started.error()));
  return host;
}

vehicle_host::vehicle_host(host_settings settings, teller tell)
    : settings_(std::move(settings)), teller_(std::move(tell)), began_ns_(clock_.now_ns()),
      thread_(io::link::start_io_thread()), due_(settings_.vehicles.size()), timer_(thread_->context()),
      signals_(thread_->context()) {
  around_.now_ns = [this] { return clock_.now_ns(); };
  around_.moved = [this](const hosted_vehicle& who) {
    due_.set(who.number(), who.next_deadline_ns());
    arm();
  };
  around_.changed = [this](const hosted_vehicle& who, const io::link::uri& where, const io::link::link_status& status) {
    link_changed(who, where, status);
  };
  if (!settings_.is_quiet)
    around_.tell = [this](const hosted_vehicle& who, const std::string& sentence) { this->tell(who, sentence); };
  if (!settings_.tlog.empty())
    around_.record = [this](const io::mavlink::frame_view& frame) { record(frame); };
  std::sort(settings_.faults.begin(), settings_.faults.end(),
            [](const timed_fault& a, const timed_fault& b) { return a.after < b.after; });
  for (std::size_t number = 0; number < settings_.vehicles.size(); ++number)
    vehicles_.push_back(std::make_unique<hosted_vehicle>(number, settings_.vehicles[number], around_));
}

vehicle_host::~vehicle_host() {
  std::vector<std::unique_ptr<io::link::link>> links;
  inside([&] {
    is_over_ = true;
    for (auto& each : vehicles_)
      for (auto& link : each->take_links())
        links.push_back(std::move(link));
  });
  links.clear(); // here and not inside: each waits for the thread
  control_.reset();
  thread_->stop();
}

tl::expected<void, std::string> vehicle_host::start() {
  if (!settings_.tlog.empty())
    if (auto recording = open_record(); !recording)
      return recording;
  auto answer = listening_.get_future();
  inside([this] { open_links(); });
  if (auto failure = answer.get(); !failure.empty())
    return tl::make_unexpected(std::move(failure));
  return {};
}

void vehicle_host::open_links() {
  if (settings_.ends_on_signals) {
    signals_.add(SIGINT);
    signals_.add(SIGTERM);
    signals_.async_wait([this](const boost::system::error_code& cancelled, int) {
      if (!cancelled)
        end();
    });
  }
  for (const auto& each : settings_.vehicles) {
    listeners_ += each.where.listens() ? 1 : 0;
    listeners_ += static_cast<std::size_t>(std::ranges::count_if(each.more_lines, &io::link::uri::listens));
  }
  listeners_ += settings_.control ? 1 : 0;
  for (auto& each : vehicles_) {
    if (auto opened = each->open({.thread = thread_}); !opened)
      return answered(opened.error());
    due_.set(each->number(), each->next_deadline_ns());
  }
  if (settings_.control) {
    control_ = std::make_unique<control_port>(
        [this](const nlohmann::json& request) { return answer_control(*this, request); },
        [this](const io::link::link_status& status) {
          if (status.phase != io::link::link_phase::connecting)
            answered(status.phase == io::link::link_phase::down ? "the control port: " + status.reason : "");
        });
    if (auto opened = control_->open(*settings_.control, thread_); !opened)
      return answered(opened.error());
  }
  if (listeners_ == 0 && !std::exchange(has_answered_, true))
    listening_.set_value({});
  arm();
}

// One of those that have to listen does, or can not: FAILURE. Only the first answer of each is counted: from then on a
// link cares for itself.
void vehicle_host::answered(const std::string& failure) {
  if (has_answered_)
    return;
  listeners_ -= failure.empty() ? 1 : 0;
  if (!failure.empty() || listeners_ == 0) {
    has_answered_ = true;
    listening_.set_value(failure);
  }
}

void vehicle_host::link_changed(const hosted_vehicle& who, const io::link::uri& where,
                                const io::link::link_status& status) {
  if (status.phase == io::link::link_phase::connecting)
    return;
  const bool is_down = status.phase == io::link::link_phase::down;
  const bool has_begun = has_answered_;
  if (where.listens())
    answered(is_down ? status.reason : "");
  if (around_.tell && has_begun)
    tell(who, "the link is " + std::string(io::name_of(status.phase)) + ": " + status.reason);
}

void vehicle_host::tell(const hosted_vehicle& who, const std::string& sentence) {
  teller_("vehicle " + std::to_string(who.number() + 1) + ": " + sentence);
}

// The file itself is made when there is something to write; a mistake in its name is told now.
tl::expected<void, std::string> vehicle_host::open_record() {
  const auto folder = std::filesystem::absolute(settings_.tlog).parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return tl::make_unexpected(settings_.tlog + " can not be recorded: " + folder.string() + ": " +
                               std::generic_category().message(errno));
  const auto opened = tlog_.open({.file = settings_.tlog, .file_bytes = tlog_bytes, .older_files = tlog_older_files});
  if (!opened)
    return tl::make_unexpected(settings_.tlog + ": " + opened.error().message());
  return {};
}

void vehicle_host::record(const io::mavlink::frame_view& frame) {
  const auto written = tlog_.write(static_cast<std::uint64_t>(clock_.now_ns() / 1'000), frame);
  if (!written && !std::exchange(tlog_failed_, true))
    teller_("the recording has lost frames: " + written.error().message());
}

void vehicle_host::end() {
  if (std::exchange(is_over_, true))
    return;
  timer_.cancel();
  ended_.set_value();
}

void vehicle_host::apply(const fault::any& what, std::optional<std::size_t> number) {
  const auto now_ns = clock_.now_ns();
  for (const auto& each : vehicles_)
    if (!number || *number == each->number())
      each->apply(what, now_ns);
  if (!settings_.is_quiet)
    teller_((number ? "vehicle " + std::to_string(*number + 1) + ": " : "fault: ") + sentence_of(what));
}

std::int64_t vehicle_host::next_ns() const {
  auto next = due_.first_deadline();
  if (next_fault_ < settings_.faults.size())
    next = std::min(next, began_ns_ + settings_.faults[next_fault_].after.count());
  if (around_.record)
    next = std::min(next, next_flush_ns_);
  return next;
}

void vehicle_host::arm() {
  const auto next = std::max(next_ns(), last_turn_ns_ + turn_ns);
  if (is_over_ || next >= armed_ns_)
    return;
  armed_ns_ = next;
  timer_.expires_at(clock_.at(next));
  timer_.async_wait([this](const boost::system::error_code& cancelled) {
    if (!cancelled && !is_over_)
      turn();
  });
}

void vehicle_host::turn() {
  const auto now_ns = clock_.now_ns();
  if (now_ns < armed_ns_)
    return; // a wait that was over just before it was replaced
  armed_ns_ = deadline_heap::never;
  last_turn_ns_ = now_ns;
  run_due_faults(now_ns);
  while (due_.first_deadline() <= now_ns) {
    auto& each = *vehicles_[due_.first()];
    each.on_time(now_ns);
    due_.set(each.number(), std::max(each.next_deadline_ns(), now_ns + 1));
  }
  flush_record(now_ns);
  arm();
}

void vehicle_host::run_due_faults(std::int64_t now_ns) {
  for (; next_fault_ < settings_.faults.size(); ++next_fault_) {
    const auto& next = settings_.faults[next_fault_];
    if (began_ns_ + next.after.count() > now_ns)
      return;
    apply(next.what, std::nullopt);
  }
}

void vehicle_host::flush_record(std::int64_t now_ns) {
  if (!around_.record || now_ns < next_flush_ns_)
    return;
  next_flush_ns_ = now_ns + second_ns;
  const auto flushed = tlog_.flush();
  if (!flushed && !std::exchange(tlog_failed_, true))
    teller_("the recording has lost frames: " + flushed.error().message());
}

std::vector<std::string> vehicle_host::links() {
  std::vector<std::string> result;
  inside([&] {
    for (const auto& each : vehicles_)
      result.push_back(each->link_description());
  });
  return result;
}

std::vector<std::string> vehicle_host::more_links(std::size_t number) {
  std::vector<std::string> result;
  inside([&] { result = vehicles_[number]->more_link_descriptions(); });
  return result;
}

std::string vehicle_host::control() {
  std::string result;
  inside([&] { result = control_ ? control_->description() : std::string(); });
  return result;
}

} // namespace godwit::sim
