// vehicle_link on real links: threads, sockets and pseudo-terminals, real time with wide margins.
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "actors/vehicle_link/actor.hpp"
#include "actors/vehicle_link/link_port.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/process.hpp"
#include "tests/io/link/far_ends.hpp"

namespace vehicle_link_link_port_test {

using namespace godwit;
using namespace godwit::vehicle_link;
using namespace std::chrono_literals;
namespace mavlink = io::mavlink;
using clock_type = std::chrono::steady_clock;

constexpr auto patience = 30s; // for a machine under load; what is measured is asserted on its own

// What the listener heard, seen by the test's thread.
class news {
public:
  void phase(connection_phase now) {
    const std::lock_guard guard(mutex_);
    phase_ = now;
    changed_.notify_all();
  }
  void attitude() {
    const std::lock_guard guard(mutex_);
    ++attitudes_;
    changed_.notify_all();
  }
  bool wait_for(connection_phase wanted) {
    std::unique_lock guard(mutex_);
    return changed_.wait_for(guard, patience, [&] { return phase_ == wanted; });
  }
  bool wait_for_attitudes(int count) {
    std::unique_lock guard(mutex_);
    return changed_.wait_for(guard, patience, [&] { return attitudes_ >= count; });
  }
  [[nodiscard]] int attitudes() const {
    const std::lock_guard guard(mutex_);
    return attitudes_;
  }

private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<connection_phase> phase_;
  int attitudes_ = 0;
};

using link_ear_handle = runtime::mailbox<runtime::tells<connection_changed>, runtime::tells<mavlink::attitude>>;

class link_ear final : public runtime::actor_base<link_ear_handle> {
public:
  link_ear(runtime::spawn_context context, news* what) : actor_base(std::move(context)), what_(what) {}

protected:
  behavior_type handlers() override {
    return {on<connection_changed>([this](const connection_changed& m) { what_->phase(m.phase); }),
            on<mavlink::attitude>([this](const mavlink::attitude&) { what_->attitude(); })};
  }

private:
  news* what_;
};

class real_process {
public:
  explicit real_process(const std::string& uri) {
    std::string pattern = (std::filesystem::temp_directory_path() / "godwit-link-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    runtime::process_options options;
    options.journal.path = (folder_ / "journal.db").string();
    host_ = *runtime::process::open(options);
    auto configured = settings{};
    configured.streams.clear();
    const auto ears = std::make_shared<listeners>();
    const auto link =
        host_->actors().add<actor>({.name = "vehicle_link"}, {}, configured, signing_settings{},
                                   std::static_pointer_cast<wire>(port), std::shared_ptr<const listeners>(ears));
    ears->add(host_->actors().add<link_ear>({.name = "ear"}, {}, &heard));
    host_->actors().start();
    const auto opened = port->open(*io::link::parse_uri(uri), {}, host_->actors().make_gateway("port"), link);
    EXPECT_TRUE(opened) << opened.error();
  }
  real_process(const real_process&) = delete;
  real_process& operator=(const real_process&) = delete;
  ~real_process() {
    port->close();
    EXPECT_EQ(host_->actors().restarts(), 0U) << "nothing may have crashed";
    (void)host_->finish(0);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::shared_ptr<link_port> port = std::make_shared<link_port>();
  news heard;

private:
  std::filesystem::path folder_;
  std::unique_ptr<runtime::process> host_;
};

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string beat() {
  return text_of(mavlink::encode(mavlink::heartbeat{.type = 2, .autopilot = 12}, mavlink::sender{1, 1}, 0).span());
}

std::string attitude() { return text_of(mavlink::encode(mavlink::attitude{}, mavlink::sender{1, 1}, 0).span()); }

// Beats on a line until the phase is there, as a vehicle does; faster, so that the time measured is the link's.
template <class Line>
bool beat_until_connected(const Line& say, news& heard) {
  const std::jthread beating([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      say(beat());
      std::this_thread::sleep_for(20ms);
    }
  });
  return heard.wait_for(connection_phase::connected);
}

TEST(vehicle_link_on_a_line, a_serial_line_that_is_gone_and_back_is_connected_again_within_two_seconds) {
  io::link::testing::serial_line line;
  line.plug_in();
  real_process p(line.uri());
  const auto say = [&](const std::string& text) { line.write(text); };
  ASSERT_TRUE(beat_until_connected(say, p.heard));
  for (int i = 0; i < 3; ++i) {
    line.unplug();
    ASSERT_TRUE(p.heard.wait_for(connection_phase::down));
    line.plug_in();
    const auto back = clock_type::now();
    ASSERT_TRUE(beat_until_connected(say, p.heard));
    EXPECT_LE(clock_type::now() - back, 2s);
  }
}

TEST(vehicle_link_on_a_line, a_udp_peer_that_is_gone_and_back_is_connected_again_within_five_seconds) {
  std::optional<io::link::testing::udp_end> vehicle(std::in_place);
  const auto port = vehicle->port();
  real_process p("udpout://127.0.0.1:" + std::to_string(port));
  ASSERT_TRUE(vehicle->receive()) << "our heartbeat comes first";
  const auto say = [&](const std::string& text) { vehicle->send(vehicle->last_sender(), text); };
  ASSERT_TRUE(beat_until_connected(say, p.heard));
  vehicle.reset();
  ASSERT_TRUE(p.heard.wait_for(connection_phase::down)) << "its port answers that nobody listens";
  vehicle.emplace(port);
  const auto back = clock_type::now();
  ASSERT_TRUE(vehicle->receive());
  ASSERT_TRUE(beat_until_connected(say, p.heard));
  EXPECT_LE(clock_type::now() - back, 5s);
}

// The address sanitizer holds freed memory back, up to 256 MiB, to find who still uses it.
#ifdef __SANITIZE_ADDRESS__
constexpr bool keeps_freed_memory = true;
#else
constexpr bool keeps_freed_memory = false;
#endif

// Resident memory of this process in KiB.
long resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0)
      return std::stol(line.substr(6));
  return 0;
}

TEST(vehicle_link_on_a_line, a_flood_of_garbage_lets_good_frames_through_and_memory_stays_flat) {
  real_process p("udpin://127.0.0.1:0");
  while (p.port->description() == "closed" || p.port->description().ends_with(":0"))
    std::this_thread::sleep_for(1ms);
  const auto address = p.port->description();
  const auto to = static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
  const io::link::testing::udp_end vehicle;
  const io::link::testing::udp_end attacker;
  ASSERT_TRUE(beat_until_connected([&](const std::string& text) { vehicle.send(to, text); }, p.heard));
  const std::string garbage = "\xFD\xFF" + std::string(100, '\xFD') + "half a frame";
  // 10,000 datagrams of garbage a second, paced: a good frame after each hundred.
  const auto send_for = [&](int hundreds) {
    for (int i = 0; i < hundreds; ++i) {
      for (int k = 0; k < 100; ++k)
        attacker.send(to, garbage);
      vehicle.send(to, attitude());
      std::this_thread::sleep_for(10ms);
    }
  };
  send_for(100);
  const auto settled_kib = resident_kib();
  send_for(300);
  vehicle.send(to, attitude());
  EXPECT_TRUE(p.heard.wait_for_attitudes(300)) << p.heard.attitudes() << " of 401; UDP may lose some";
  const auto grown_kib = resident_kib() - settled_kib;
  EXPECT_TRUE(keeps_freed_memory || grown_kib <= 8 * 1024) << grown_kib << " KiB";
}

} // namespace vehicle_link_link_port_test
