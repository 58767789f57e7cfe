#include "programs/godwit-sim/missions/mission_service_host.hpp"

#include <chrono>
#include <fstream>
#include <future>
#include <list>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "io/http/client.hpp"
#include "programs/godwit-sim/host/control_port.hpp"
#include "tests/programs/godwit-sim/host/control_client.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"
#include "tests/support/tls_identity.hpp"

namespace godwit::sim::missions {
namespace mission_service_host_test {

namespace asio = boost::asio;
using asio::ip::tcp;
using io::http::errc;
using io::http::method;
using got = io::http::result<io::http::response>;

constexpr std::chrono::seconds wide{60};

const test::tls_identity& issuer() {
  static const auto made = test::make_tls_identity({.common_name = "godwit test issuer", .is_issuer = true});
  return made;
}

identity identity_for(const std::string& host) {
  const auto made = test::make_tls_identity({.hosts = {host}}, &issuer());
  return {made.certificate, made.key};
}

// A service and a client of it, both with TLS unless it is said.
class running_world {
public:
  explicit running_world(bool has_tls = true, const std::function<void(service_settings&)>& change = {}) {
    service_settings settings;
    settings.token = token;
    settings.database = folder.file("missions.db");
    settings.missions = {small_mission()};
    if (has_tls) {
      settings.tls = identity_for("IP:127.0.0.1");
      settings.wrong_host_tls = identity_for("DNS:somebody.example");
      write("ca.pem", issuer().certificate);
    }
    write("token", token);
    if (change)
      change(settings);
    host = mission_service_host::open(std::move(settings)).value();
    connect(has_tls);
  }

  void connect(bool has_tls = true) {
    io::http::settings wanted;
    wanted.base_url = host->url();
    wanted.token_file = folder.file("token");
    if (has_tls)
      wanted.ca_file = folder.file("ca.pem");
    wanted.total_timeout = wide;
    wanted.read_timeout = wide;
    client = io::http::client::open(wanted).value();
  }

  std::future<got> send(method how, const std::string& rest, std::string body = {}) {
    io::http::request asked;
    asked.method = how;
    asked.target = target(rest);
    asked.body = std::move(body);
    asked.max_body_bytes = std::size_t{16} * 1024 * 1024;
    auto promise = std::make_shared<std::promise<got>>();
    const auto sent = client->send(std::move(asked), [promise](got end) { promise->set_value(std::move(end)); });
    EXPECT_TRUE(sent);
    return promise->get_future();
  }
  got ask(method how, const std::string& rest = {}, std::string body = {}) {
    return send(how, rest, std::move(body)).get();
  }
  unsigned status(method how, const std::string& rest = {}, std::string body = {}) {
    const auto given = ask(how, rest, std::move(body));
    return given ? given->status : 0;
  }
  std::optional<errc> failure(method how, const std::string& rest = {}, std::string body = {}) {
    const auto given = ask(how, rest, std::move(body));
    return given ? std::nullopt : std::optional(given.error().code);
  }

  void write(const std::string& name, const std::string& text) const {
    const auto file = folder.file(name);
    std::ofstream(file) << text;
    ::chmod(file.c_str(), 0600);
  }

  scratch folder;
  std::unique_ptr<mission_service_host> host;
  std::unique_ptr<io::http::client> client;
};

void wait_until_held(mission_service_host& host) {
  const auto until = std::chrono::steady_clock::now() + wide;
  while (host.figures().connections.polls == 0)
    ASSERT_LT(std::chrono::steady_clock::now(), until) << "the poll never came";
}

std::string two_reports() { return mission::to_text(reports(1, 1, 2)); }

TEST(mission_service_host, a_page_comes_compressed_to_who_accepts_that_and_is_the_same_page) {
  running_world world(true, [](service_settings& settings) { settings.map.count = 500; });
  const auto plain = world.ask(method::get, "/mapobjects?limit=500");
  io::http::request asked;
  asked.target = target("/mapobjects?limit=500");
  asked.accepts_compressed = true;
  std::promise<got> end;
  ASSERT_TRUE(world.client->send(asked, [&end](got given) { end.set_value(std::move(given)); }));
  const auto small = end.get_future().get();
  ASSERT_TRUE(plain && small) << small.error().message();
  EXPECT_EQ(plain->find("Content-Encoding"), "");
  EXPECT_EQ(small->find("Content-Encoding"), "zstd");
  EXPECT_EQ(small->body, plain->body);
  EXPECT_EQ(small->find("Next-Page"), "") << "the last one";
  const auto first = world.ask(method::get, "/mapobjects?limit=10");
  EXPECT_EQ(first->find("Next-Page"), mission::read<mission::map_object_page>(first->body)->next);
  EXPECT_GT(small->body.size(), 50'000U);
}

TEST(mission_service_host, the_contract_is_served_over_tls_and_without) {
  for (const bool has_tls : {true, false}) {
    running_world world(has_tls);
    EXPECT_EQ(world.host->url().substr(0, 5), has_tls ? "https" : "http:");
    const auto given = world.ask(method::get);
    ASSERT_TRUE(given) << given.error().message();
    EXPECT_EQ(mission::read<mission::document>(given->body).value(), small_mission());
    EXPECT_EQ(world.status(method::post, "/progress", two_reports()), 200U);
    EXPECT_EQ(world.status(method::get, "/nothing"), 404U);
    EXPECT_EQ(world.status(method::remove), 204U);
    EXPECT_EQ(world.status(method::get), 410U);
    const auto figures = world.host->figures();
    EXPECT_EQ(figures.connections.accepted, 1U); // it was kept
    EXPECT_EQ(figures.answers.at(endpoint::post_progress).at(200), 1U);
    EXPECT_EQ(figures.rows.at(row_kind::progress).stored, 2U);
  }
}

TEST(mission_service_host, a_poll_is_answered_at_once_when_there_is_an_assignment) {
  running_world world;
  auto poll = world.send(method::get, "/assignments?after=2&wait_s=60");
  wait_until_held(*world.host);
  const auto made = world.host->assign(mission_id, {{mission::return_home{"h"}}, "w1", {}, {}, {}});
  ASSERT_TRUE(made) << made.error();
  ASSERT_EQ(poll.wait_for(wide / 2), std::future_status::ready); // long before its own 60 s
  const auto list = mission::read<mission::assignment_list>(poll.get()->body).value();
  EXPECT_EQ(list.assignments, std::vector{*made});
}

TEST(mission_service_host, a_poll_ends_with_an_empty_list_or_with_the_mission) {
  running_world world;
  EXPECT_EQ(world.ask(method::get, "/assignments?after=2&wait_s=1")->body, R"({"assignments":[]})");
  auto poll = world.send(method::get, "/assignments?after=2&wait_s=60");
  wait_until_held(*world.host);
  ASSERT_TRUE(world.host->delete_mission(mission_id));
  ASSERT_EQ(poll.wait_for(wide / 2), std::future_status::ready);
  EXPECT_EQ(poll.get()->status, 410U);
}

TEST(mission_service_host, an_answer_that_was_lost_is_given_to_the_repetition_and_stored_once) {
  running_world world;
  ASSERT_TRUE(world.host->set_fault("lose on post-progress times 1"));
  EXPECT_EQ(world.failure(method::post, "/progress", two_reports()), errc::connection_lost);
  EXPECT_EQ(world.host->rows(mission_id, row_kind::progress).size(), 2U);
  const auto again = world.ask(method::post, "/progress", two_reports());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->body, R"({"stored":2,"repeated":0})");
  const auto figures = world.host->figures();
  EXPECT_EQ(figures.lost, 1U);
  EXPECT_EQ(figures.replayed, 1U);
  EXPECT_EQ(figures.rows.at(row_kind::progress).repeated, 0U);
}

TEST(mission_service_host, each_fault_is_met_by_the_client_as_what_it_is) {
  running_world world;
  const std::pair<const char*, errc> faults[] = {
      {"drop times 1", errc::connection_lost},
      {"reset times 1", errc::truncated},
      {"huge times 1", errc::body_too_large},
  };
  for (const auto& [spec, code] : faults) {
    ASSERT_TRUE(world.host->set_fault(spec));
    EXPECT_EQ(world.failure(method::post, "/progress", two_reports()), code) << spec;
  }
  const std::pair<const char*, unsigned> statuses[] = {{"status 500 times 1", 500}, {"status 429 times 1", 429}};
  for (const auto& [spec, status] : statuses) {
    ASSERT_TRUE(world.host->set_fault(spec));
    EXPECT_EQ(world.status(method::get), status) << spec;
  }
  ASSERT_TRUE(world.host->set_fault("slow 20000 times 1"));
  ASSERT_TRUE(world.host->set_fault("delay 10ms times 1"));
  EXPECT_EQ(mission::read<mission::document>(world.ask(method::get)->body).value(), small_mission());
  EXPECT_EQ(world.status(method::get), 200U);
}

TEST(mission_service_host, a_certificate_of_another_host_is_shown_while_the_fault_is_on) {
  running_world world;
  EXPECT_EQ(world.status(method::get), 200U);
  ASSERT_TRUE(world.host->set_fault("wrong-host"));
  EXPECT_EQ(world.failure(method::get), errc::wrong_host);
  world.host->clear_faults();
  EXPECT_EQ(world.status(method::get), 200U);
}

TEST(mission_service_host, who_refuses_does_not_listen_and_ends_what_there_is) {
  running_world world;
  EXPECT_EQ(world.status(method::get), 200U);
  const auto port = world.host->port();
  ASSERT_TRUE(world.host->set_fault("refuse"));
  EXPECT_EQ(world.failure(method::get), errc::refused);
  world.host->clear_faults();
  EXPECT_EQ(world.host->port(), port);
  EXPECT_EQ(world.status(method::get), 200U);
  ASSERT_TRUE(world.host->set_fault("refuse for 50ms"));
  const auto until = std::chrono::steady_clock::now() + wide;
  while (world.status(method::get) != 200U)
    ASSERT_LT(std::chrono::steady_clock::now(), until);
}

TEST(mission_service_host, a_service_that_begins_again_on_its_file_has_everything) {
  running_world world(false);
  EXPECT_EQ(world.status(method::post, "/progress", two_reports()), 200U);
  EXPECT_EQ(world.status(method::post, "/waypoints", mission::to_text(insert(2, 2, "n1"))), 200U);
  world.host.reset();
  service_settings settings;
  settings.token = token;
  settings.database = world.folder.file("missions.db");
  settings.missions = {small_mission()}; // is there already, at a newer revision
  world.host = mission_service_host::open(settings).value();
  world.connect(false);
  EXPECT_EQ(world.host->current_mission(mission_id)->revision, 3);
  EXPECT_EQ(world.status(method::post, "/progress", two_reports()), 200U);
  EXPECT_EQ(world.host->figures().replayed, 1U);
}

TEST(mission_service_host, a_body_that_is_too_large_gets_its_answer_while_it_is_still_being_sent) {
  for (const bool has_tls : {true, false}) {
    running_world world(has_tls);
    const auto given = world.ask(method::post, "/progress", std::string(2 * mission::max_batch_bytes, ' '));
    ASSERT_TRUE(given) << given.error().message();
    EXPECT_EQ(given->status, 413U);
  }
}

TEST(mission_service_host, what_can_not_work_is_refused_with_a_sentence) {
  running_world world(false);
  service_settings settings;
  settings.database = world.folder.file("other.db");
  settings.port = world.host->port();
  auto taken = mission_service_host::open(settings);
  ASSERT_FALSE(taken);
  EXPECT_NE(taken.error().find("another program listens"), std::string::npos) << taken.error();
  settings.port = 0;
  settings.faults = {"explode"};
  EXPECT_FALSE(mission_service_host::open(settings));
  settings.faults = {"wrong-host"};
  EXPECT_FALSE(mission_service_host::open(settings));
  settings.faults.clear();
  settings.database = "/no/such/folder/missions.db";
  EXPECT_FALSE(mission_service_host::open(settings));
  world.write("text.db", std::string(5000, 'x'));
  settings.database = world.folder.file("text.db");
  EXPECT_FALSE(mission_service_host::open(settings));
}

TEST(mission_service_host, the_control_port_assigns_deletes_and_tells) {
  running_world world(
      true, [](service_settings& settings) { settings.control = parse_control_place("127.0.0.1:0").value(); });
  const auto where = world.host->control();
  control_client client(static_cast<std::uint16_t>(std::stoi(where.substr(where.rfind(':') + 1))));
  const auto ask = [&](const std::string& what) { return client.ask({{"do", what}}); };
  const nlohmann::json assignment = {{"items", {{{"id", "h"}, {"kind", "return"}}}}, {"replace_after_item_id", "w1"}};
  const auto made = client.ask({{"do", "assign"}, {"assignment", assignment}});
  EXPECT_TRUE(made["ok"].get<bool>()) << made;
  EXPECT_EQ(made["revision"], 3);
  world.write("next.json", R"({"items":[{"id":"h2","kind":"return"}]})");
  EXPECT_EQ(ask("assign " + world.folder.file("next.json"))["revision"], 4);
  EXPECT_TRUE(ask("fault status 503 times 1")["ok"].get<bool>());
  EXPECT_EQ(world.status(method::get), 503U);
  EXPECT_EQ(world.status(method::post, "/progress", two_reports()), 200U);
  const auto stats = ask("stats");
  EXPECT_EQ(stats["requests"]["get-mission"]["503"], 1) << stats;
  EXPECT_EQ(stats["rows"]["progress"]["stored"], 2) << stats;
  EXPECT_EQ(stats["faults"][0]["hit"], 1) << stats;
  EXPECT_TRUE(ask("faults off")["ok"].get<bool>());
  EXPECT_TRUE(ask("stats")["faults"].empty());
  EXPECT_TRUE(ask("delete " + mission_id)["ok"].get<bool>());
  EXPECT_EQ(world.status(method::get), 410U);
  for (const auto* wrong : {"", "fly", "fault explode", "faults", "assign", "assign /no/such.json", "delete nobody"})
    EXPECT_FALSE(ask(wrong)["ok"].get<bool>()) << wrong;
  EXPECT_FALSE(client.ask({{"do", "stats"}, {"verbose", true}})["ok"].get<bool>());
  EXPECT_TRUE(ask("quit")["ok"].get<bool>());
  world.host->wait();
}

// A connection without a client that knows HTTP.
class raw_connection {
public:
  explicit raw_connection(const std::unique_ptr<mission_service_host>& to) : socket_(io_) {
    socket_.connect({asio::ip::address_v4::loopback(), to->port()});
  }
  void write(const std::string& text) { asio::write(socket_, asio::buffer(text)); }
  std::string read_to_end() {
    std::string all;
    boost::system::error_code ended;
    asio::read(socket_, asio::dynamic_buffer(all), ended);
    EXPECT_EQ(ended, asio::error::eof);
    return all;
  }

private:
  asio::io_context io_;
  tcp::socket socket_;
};

TEST(mission_service_host, what_is_no_http_is_answered_and_closed) {
  running_world world(false);
  raw_connection connection(world.host);
  connection.write("HELO\r\n\r\n");
  EXPECT_TRUE(connection.read_to_end().starts_with("HTTP/1.1 400 "));
}

TEST(mission_service_host, who_goes_away_is_not_held_for) {
  running_world world(false);
  {
    raw_connection connection(world.host);
    connection.write("GET " + target("/assignments?after=2&wait_s=60") + " HTTP/1.1\r\nAuthorization: Bearer " + token +
                     "\r\n\r\n");
    wait_until_held(*world.host);
  }
  const auto until = std::chrono::steady_clock::now() + wide / 2; // long before its own 60 s
  while (world.host->figures().connections.polls != 0)
    ASSERT_LT(std::chrono::steady_clock::now(), until);
  EXPECT_EQ(world.host->figures().connections.open, 0U);
}

TEST(mission_service_host, there_are_only_so_many_connections) {
  running_world world(false);
  std::list<raw_connection> all;
  for (std::size_t i = 0; i < 256; ++i)
    all.emplace_back(world.host);
  EXPECT_EQ(all.emplace_back(world.host).read_to_end(), "");
  EXPECT_EQ(world.host->figures().connections.turned_away, 1U);
  all.clear();
  const auto until = std::chrono::steady_clock::now() + wide;
  while (world.host->figures().connections.open != 0)
    ASSERT_LT(std::chrono::steady_clock::now(), until);
  EXPECT_EQ(world.status(method::get), 200U);
}

} // namespace mission_service_host_test
} // namespace godwit::sim::missions
