#include "io/link/lifecycle.hpp"

namespace godwit::io::link {

lifecycle::lifecycle(boost::asio::io_context& io, back_off pause, counter_set& counters,
                     std::function<void(const link_status&)> changed, std::function<void()> open)
    : timer_(io), pause_(pause), counters_(counters), changed_(std::move(changed)), open_(std::move(open)) {}

void lifecycle::begin(std::string tried) {
  tell(link_phase::connecting, std::move(tried));
  try_now();
}

void lifecycle::try_now() {
  try_began_ = clock::now();
  open_();
}

void lifecycle::opened(std::string where) {
  is_open_ = true;
  opened_at_ = clock::now();
  come_up(std::move(where));
}

void lifecycle::failed(std::string why) {
  const auto now = clock::now();
  // A try that took long has done its waiting already; a loss is answered from now on.
  auto waits_since = try_began_;
  if (is_open_) {
    waits_since = now;
    counters_.losses.add(status_.phase == link_phase::up ? 1 : 0);
    if (now - opened_at_ >= stable_after)
      pause_.reset();
  } else {
    counters_.open_failures.add();
  }
  is_open_ = false;
  timer_.expires_at(std::max(now, waits_since + pause_.next()));
  timer_.async_wait(alive_.guard([this](const boost::system::error_code& cancelled) {
    if (!cancelled)
      try_now();
  }));
  tell(link_phase::down, std::move(why));
}

void lifecycle::unanswered(std::string why) {
  counters_.losses.add(status_.phase == link_phase::up ? 1 : 0);
  tell(link_phase::down, std::move(why));
}

void lifecycle::answered(std::string where) { come_up(std::move(where)); }

void lifecycle::come_up(std::string where) {
  status_.reconnects += was_up_ ? 1 : 0;
  was_up_ = true;
  tell(link_phase::up, std::move(where));
}

void lifecycle::tell(link_phase phase, std::string reason) {
  const bool first = status_.reason.empty();
  if (!first && status_.phase == phase && status_.reason == reason)
    return;
  status_.phase = phase;
  status_.reason = std::move(reason);
  if (changed_)
    changed_(status_);
}

} // namespace godwit::io::link
