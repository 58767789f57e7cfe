#include "tests/io/link/watcher.hpp"

#include <stdexcept>
#include <thread>

namespace godwit::io::link::testing {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

link_callbacks watcher::callbacks() {
  const auto note = [this](const auto& change) {
    {
      const std::lock_guard lock(mutex_);
      change();
    }
    changed_.notify_all();
  };
  return {[this, note](peer_id from, std::span<const std::byte> bytes, bool is_datagram) {
            const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            note([&] { chunks.push_back({from, text, is_datagram}); });
          },
          [this, note](const link_status& status) { note([&] { statuses.push_back(status); }); },
          [this, note](peer_id who) { note([&] { left.push_back(who); }); }};
}

bool watcher::wait_for(const std::function<bool(const watcher&)>& what) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [&] { return what(*this); });
}

bool watcher::wait_for_phase(link_phase phase) {
  return wait_for([phase](const watcher& w) { return !w.statuses.empty() && w.statuses.back().phase == phase; });
}

bool watcher::wait_for_reason(std::string_view part) {
  return wait_for([part](const watcher& w) {
    return !w.statuses.empty() && w.statuses.back().reason.find(part) != std::string::npos;
  });
}

bool watcher::wait_for_bytes(std::string_view all) {
  return wait_for([all](const watcher& w) {
    std::string together;
    for (const auto& each : w.chunks)
      together += each.bytes;
    return together == all;
  });
}

bool watcher::wait_for_chunks(std::size_t number) {
  return wait_for([number](const watcher& w) { return w.chunks.size() >= number; });
}

link_status watcher::last_status() {
  const std::lock_guard lock(mutex_);
  return statuses.empty() ? link_status{} : statuses.back();
}

watcher::chunk watcher::last_chunk() {
  const std::lock_guard lock(mutex_);
  return chunks.empty() ? chunk{} : chunks.back();
}

std::vector<link_status> watcher::all_statuses() {
  const std::lock_guard lock(mutex_);
  return statuses;
}

bool eventually(const std::function<bool()>& what) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!what()) {
    if (std::chrono::steady_clock::now() > end)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

std::unique_ptr<link> open(std::string_view text, watcher& heard, const link_options& options) {
  const auto where = parse_uri(text);
  if (!where)
    throw std::invalid_argument(where.error());
  auto opened = open_link(*where, heard.callbacks(), options);
  if (!opened)
    throw std::invalid_argument(opened.error());
  return std::move(*opened);
}

std::uint16_t port_of(const link& listener) { return parse_uri(listener.description())->port; }

} // namespace godwit::io::link::testing
