// fleet_link with a process of actors and Debian's mosquitto: real time, with wide margins.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "actors/fleet_link/actor.hpp"
#include "actors/fleet_link/mqtt_port.hpp"
#include "io/fields/json_text.hpp"
#include "programs/godwitd/view_actors.hpp"
#include "runtime/process.hpp"
#include "tests/support/mosquitto.hpp"
#include "tests/support/mqtt_peer.hpp"
#include "tests/support/tls_identity.hpp"

namespace godwit::fleet_link {
namespace broker_test {

using namespace std::chrono_literals;
using tests::heard_message;
using heard = std::vector<heard_message>;
using json = nlohmann::json;

constexpr const char* event_topic = "gw/v1/rover-7/event";
constexpr const char* status_topic = "gw/v1/rover-7/status";

std::vector<json> events_of(const heard& all) {
  std::vector<json> result;
  std::set<std::string> known;
  for (const auto& each : all)
    if (each.topic == event_topic)
      if (auto event = json::parse(each.text); known.insert(event.at("id").get<std::string>()).second)
        result.push_back(std::move(event));
  return result;
}

std::string newest_status(const heard& all) {
  std::string result;
  for (const auto& each : all)
    if (each.topic == status_topic)
      result = json::parse(each.text).at("state");
  return result;
}

// A godwitd in small: the actor, its journal, its port; others are told by hand.
class vehicle {
public:
  vehicle(std::string journal, const settings& configured, std::uint64_t seed)
      : port_(std::make_shared<mqtt_port>(configured)) {
    runtime::process_options options;
    options.journal.path = std::move(journal);
    host_ = std::move(*runtime::process::open(options));
    auto others = std::make_shared<peers>();
    others->say = [this](const std::string& sentence, bool) {
      const std::lock_guard guard(mutex_);
      said_.push_back(sentence);
    };
    others->open_live = [hub = stream_] { return daemon::hub_reader::open(hub); };
    fleet_ = host_->actors().add<actor>({.name = "fleet_link"}, {}, configured, std::shared_ptr<const peers>(others),
                                        port_, seed);
    port_->attach(host_->actors().make_gateway("broker_port"), fleet_);
    host_->actors().start();
  }
  vehicle(const vehicle&) = delete;
  vehicle& operator=(const vehicle&) = delete;
  ~vehicle() {
    port_->detach();
    static_cast<void>(host_->finish(0));
  }

  void progress(std::uint32_t items_done) {
    executor::flight_status now;
    now.phase = "flying";
    now.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
    now.items = 10'000;
    now.items_done = items_done;
    host_->actors().make_gateway("test").tell(fleet_, now);
  }
  void position(double latitude_deg) {
    telemetry_stream::position_update at;
    at.latitude_deg = latitude_deg;
    (void)stream_->publish(telemetry_stream::topic::position, io::to_json(at), 0, host_->time().monotonic_ns());
  }
  bool was_told(const std::string& words, std::chrono::seconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      {
        const std::lock_guard guard(mutex_);
        for (const auto& each : said_)
          if (each.find(words) != std::string::npos)
            return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    return false;
  }
  std::string all_told() {
    const std::lock_guard guard(mutex_);
    std::string result;
    for (const auto& each : said_)
      result += each + "\n";
    return result;
  }

private:
  std::mutex mutex_;
  std::vector<std::string> said_;
  std::shared_ptr<mqtt_port> port_;
  std::shared_ptr<telemetry_stream::hub> stream_ = std::make_shared<telemetry_stream::hub>();
  std::unique_ptr<runtime::process> host_;
  own_handle fleet_;
};

class fleet_link_broker : public ::testing::Test {
protected:
  void SetUp() override {
    if (!tests::broker::is_installed())
      GTEST_SKIP() << "mosquitto is not installed";
    std::string name = (std::filesystem::temp_directory_path() / "godwit_fleet_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    std::filesystem::permissions(path(name), std::filesystem::perms(0600));
  }
  [[nodiscard]] std::string journal() const { return (folder_ / "godwit.db").string(); }
  static settings settings_for(const tests::broker& to) {
    settings result;
    result.broker = io::mqtt::parse_broker_uri("mqtt://127.0.0.1:" + std::to_string(to.port())).value();
    result.vehicle = "rover-7";
    result.interval_ms = 100;
    return result;
  }
  std::filesystem::path folder_;
};

TEST_F(fleet_link_broker, who_watches_hears_that_the_vehicle_is_there_where_it_is_and_what_happens) {
  tests::broker broker;
  tests::watcher watcher(broker.port());
  {
    vehicle rover(journal(), settings_for(broker), 1);
    EXPECT_TRUE(watcher.wait_for([](const heard& all) { return newest_status(all) == "online"; }));
    rover.position(47.5);
    rover.progress(1);
    EXPECT_TRUE(watcher.wait_for([](const heard& all) {
      return std::ranges::any_of(all, [](const auto& each) {
        return each.topic == "gw/v1/rover-7/telemetry/position" && !each.is_retained &&
               json::parse(each.text).at("data").at("latitude_deg") == 47.5;
      });
    }));
    EXPECT_TRUE(watcher.wait_for([](const heard& all) {
      return std::ranges::any_of(events_of(all), [](const json& each) {
        return each.at("kind") == "progress" && each.at("data").at("items_done") == 1;
      });
    }));
  }
  EXPECT_TRUE(watcher.wait_for([](const heard& all) { return newest_status(all) == "offline"; }))
      << "said by the broker, when the vehicle went";
  tests::watcher late(broker.port(), "late");
  EXPECT_TRUE(late.wait_for([](const heard& all) { return newest_status(all) == "offline"; }))
      << "and to who comes later";
}

TEST_F(fleet_link_broker, a_broker_that_goes_away_again_and_again_gets_all_events_in_order_and_no_id_means_two_things) {
  tests::broker broker;
  tests::watcher watcher(broker.port());
  std::uint32_t items = 0;
  {
    vehicle rover(journal(), settings_for(broker), 1);
    for (int round = 0; round < 4; ++round) {
      for (int i = 0; i < 500; ++i)
        rover.progress(++items);
      const auto known = events_of(watcher.heard()).size();
      EXPECT_TRUE(watcher.wait_for([&](const heard& all) { return events_of(all).size() > known; })) << round;
      broker.stop(); // among its acknowledgements
      for (int i = 0; i < 50; ++i)
        rover.progress(++items);
      broker.start();
    }
  }
  vehicle again(journal(), settings_for(broker), 2); // what the first process could not deliver
  again.progress(++items);
  EXPECT_TRUE(watcher.wait_for([&](const heard& all) {
    const auto events = events_of(all);
    return !events.empty() && events.back().at("data").value("items_done", 0U) == items;
  })) << again.all_told();
  std::map<std::uint64_t, std::string> by_number;
  for (const auto& each : watcher.heard())
    if (each.topic == event_topic) {
      const auto number = json::parse(each.text).at("number").get<std::uint64_t>();
      EXPECT_EQ(by_number.emplace(number, each.text).first->second, each.text) << "the same text whenever it comes";
    }
  const auto events = events_of(watcher.heard());
  std::uint64_t number = 0;
  std::uint32_t done = 0;
  for (const auto& each : events) {
    EXPECT_EQ(each.at("number").get<std::uint64_t>(), ++number);
    done = each.at("kind") == "progress" ? each.at("data").at("items_done").get<std::uint32_t>() : done;
  }
  EXPECT_EQ(done, items);
}

TEST_F(fleet_link_broker, a_broker_that_knows_nobody_by_this_name_is_named_with_what_to_do) {
  tests::broker broker("allow_anonymous false");
  vehicle rover(journal(), settings_for(broker), 1);
  EXPECT_TRUE(rover.was_told("telemetry.username", 30s)) << rover.all_told();
}

TEST_F(fleet_link_broker, a_broker_that_does_not_take_the_topics_is_named_and_no_event_counts_as_delivered) {
  tests::broker broker;
  const auto rights = broker.folder() / "acl";
  std::ofstream(rights) << "topic read gw/#\n";
  broker.stop();
  tests::broker strict("allow_anonymous true\nacl_file " + rights.string());
  vehicle rover(journal(), settings_for(strict), 1);
  rover.progress(1);
  EXPECT_TRUE(rover.was_told("does not take a message", 30s)) << rover.all_told();
}

TEST_F(fleet_link_broker, the_limits_of_a_broker_are_kept_to_and_events_reach_it_all_the_same) {
  tests::broker broker("allow_anonymous true\nmax_keepalive 10\nretain_available false\nmax_packet_size 2000\n"
                       "max_inflight_messages 3");
  tests::watcher watcher(broker.port());
  vehicle rover(journal(), settings_for(broker), 1);
  EXPECT_TRUE(rover.was_told("let the broker retain messages", 30s)) << rover.all_told();
  for (std::uint32_t items = 1; items <= 200; ++items)
    rover.progress(items);
  EXPECT_TRUE(watcher.wait_for([](const heard& all) {
    const auto events = events_of(all);
    return !events.empty() && events.back().at("data").value("items_done", 0U) == 200;
  })) << rover.all_told();
  EXPECT_TRUE(watcher.wait_for([](const heard& all) { return newest_status(all) == "online"; }));
}

TEST_F(fleet_link_broker, a_broker_that_acknowledges_nothing_is_named) {
  tests::broker broker("allow_anonymous true\nmax_qos 0");
  vehicle rover(journal(), settings_for(broker), 1);
  EXPECT_TRUE(rover.was_told("QoS not supported", 30s)) << rover.all_told();
}

TEST_F(fleet_link_broker, the_packet_that_ended_godwitd_is_named_and_the_vehicle_goes_on_to_the_next_broker) {
  tests::mqtt::peer broker([](tests::mqtt::peer_end& end, int connection) {
    (void)end.read();
    end.write(connection == 1 ? std::string("\x20\x05\x00\x00\x01\x7a\x00", 7) : tests::mqtt::connack());
    (void)end.last();
  });
  settings configured;
  configured.broker = io::mqtt::parse_broker_uri("mqtt://127.0.0.1:" + std::to_string(broker.port())).value();
  configured.vehicle = "rover-7";
  vehicle rover(journal(), configured, 1);
  EXPECT_TRUE(rover.was_told("the broker sends CONNACK with", 30s)) << rover.all_told();
  EXPECT_TRUE(rover.was_told("connected to", 30s)) << "at the next try";
}

TEST_F(fleet_link_broker, nobody_there_and_a_name_that_is_nobodys_are_told_apart) {
  tests::broker broker;
  auto configured = settings_for(broker);
  broker.stop();
  {
    vehicle rover(journal(), configured, 1);
    EXPECT_TRUE(rover.was_told("check that the broker runs", 30s)) << rover.all_told();
  }
  configured.broker = io::mqtt::parse_broker_uri("mqtts://no-such-host.invalid:8883").value();
  vehicle rover(journal(), configured, 2);
  EXPECT_TRUE(rover.was_told("name servers", 40s)) << rover.all_told();
}

TEST_F(fleet_link_broker, over_tls_the_broker_must_be_who_its_issuer_says_and_have_the_name_it_is_called_by) {
  const auto issuer = test::make_tls_identity({.common_name = "godwit issuer", .is_issuer = true});
  const auto identity = test::make_tls_identity({.hosts = {"DNS:localhost"}}, &issuer);
  write("ca.pem", issuer.certificate);
  write("broker.pem", identity.certificate);
  write("broker.key", identity.key);
  tests::broker broker("allow_anonymous true\ncertfile " + path("broker.pem") + "\nkeyfile " + path("broker.key"));
  const auto port = std::to_string(broker.port());
  auto configured = settings_for(broker);
  configured.broker = io::mqtt::parse_broker_uri("mqtts://localhost:" + port).value();
  {
    vehicle rover(journal(), configured, 1);
    EXPECT_TRUE(rover.was_told("name the issuer", 30s)) << rover.all_told();
  }
  configured.ca_file = path("ca.pem");
  {
    vehicle rover(journal(), configured, 2);
    EXPECT_TRUE(rover.was_told("connected to mqtts://localhost", 30s)) << rover.all_told();
  }
  configured.broker = io::mqtt::parse_broker_uri("mqtts://127.0.0.1:" + port).value();
  vehicle rover(journal(), configured, 3);
  EXPECT_TRUE(rover.was_told("by a name in its certificate", 30s)) << rover.all_told();
}

TEST_F(fleet_link_broker, a_password_comes_from_a_file_that_nobody_else_can_read) {
  const auto accounts = path("accounts");
  ASSERT_EQ(std::system(("mosquitto_passwd -b -c " + accounts + " rover-7 right").c_str()), 0);
  tests::broker broker("allow_anonymous false\npassword_file " + accounts);
  auto configured = settings_for(broker);
  configured.username = "rover-7";
  configured.password_file = path("password");
  write("password", "right\n");
  {
    std::filesystem::permissions(path("password"), std::filesystem::perms(0644));
    vehicle rover(journal(), configured, 1);
    EXPECT_TRUE(rover.was_told("0644", 30s)) << rover.all_told();
  }
  std::filesystem::permissions(path("password"), std::filesystem::perms(0600));
  {
    vehicle rover(journal(), configured, 2);
    EXPECT_TRUE(rover.was_told("connected to", 30s)) << rover.all_told();
  }
  write("password", "wrong\n");
  vehicle rover(journal(), configured, 3);
  EXPECT_TRUE(rover.was_told("telemetry.password_file", 30s)) << rover.all_told();
}

} // namespace broker_test
} // namespace godwit::fleet_link
