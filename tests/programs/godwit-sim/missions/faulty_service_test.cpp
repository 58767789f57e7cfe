#include <string>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "io/http/server/server.hpp"
#include "io/link/io_thread.hpp"
#include "messages/mission/answer.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/faulty_service.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {

namespace faulty_service_test {

struct faulty_world {
  explicit faulty_world(std::string_view fault) { EXPECT_TRUE(book.add(fault)) << fault; }

  delivery ask(const request& what) {
    return std::get<delivery>(faulty.answer_to(faulty.take(what), 0, patience::none));
  }
  std::size_t reports_there() { return rows_of(base.file(), mission_id, row_kind::progress).size(); }

  judged_service base;
  service served{base.file(), {token, {}}};
  fault_book book;
  faulty_service faulty{served, book};
};

request two_reports() { return post("/progress", mission::to_text(reports(1, 1, 2))); }

TEST(missions_faulty_service, without_a_fault_an_answer_goes_as_it_is) {
  faulty_world world("lose on get-mission");
  const auto given = world.ask(two_reports());
  EXPECT_EQ(given.what.body, R"({"stored":2,"repeated":0})");
  EXPECT_FALSE(given.is_lost || given.cut_after || given.padding != 0 || given.bytes_per_s != 0);
}

TEST(missions_faulty_service, a_lost_answer_has_its_effect_and_is_there_for_the_repetition) {
  faulty_world world("lose times 1");
  EXPECT_TRUE(world.ask(two_reports()).is_lost);
  EXPECT_EQ(world.reports_there(), 2U);
  const auto again = world.ask(two_reports());
  EXPECT_FALSE(again.is_lost);
  EXPECT_EQ(again.what.body, R"({"stored":2,"repeated":0})");
  service_figures figures;
  world.faulty.count_into(figures);
  EXPECT_EQ(figures.lost, 1U);
  EXPECT_EQ(figures.requests(endpoint::post_progress), 1U);
}

TEST(missions_faulty_service, a_dropped_request_has_no_effect) {
  faulty_world world("drop times 1");
  EXPECT_TRUE(world.ask(two_reports()).is_lost);
  EXPECT_EQ(world.reports_there(), 0U);
}

TEST(missions_faulty_service, a_status_has_no_effect_unless_it_was_committed_and_is_never_kept) {
  for (const bool is_committed : {false, true}) {
    faulty_world world(std::string("status 503 retry-after 2 ") + (is_committed ? "committed " : "") + "times 1");
    const auto given = world.ask(two_reports());
    EXPECT_EQ(given.what.status, 503U);
    EXPECT_TRUE(mission::read<mission::problem>(given.what.body));
    ASSERT_EQ(given.what.headers.size(), 1U);
    EXPECT_EQ(given.what.headers[0], (io::http::header{"Retry-After", "2"}));
    EXPECT_EQ(world.reports_there(), is_committed ? 2U : 0U);
    EXPECT_EQ(world.ask(two_reports()).what.body, R"({"stored":2,"repeated":0})");
  }
}

TEST(missions_faulty_service, a_schema_violation_is_json_that_no_vehicle_takes) {
  for (const auto& asked : {get(), get("/mapobjects"), get("/assignments?after=2"), two_reports()}) {
    faulty_world world("schema");
    const auto body = world.ask(asked).what.body;
    const auto document = mission::read<mission::document>(body);
    ASSERT_FALSE(document);
    EXPECT_EQ(document.error().code, mission::document_errc::wrong_form);
    EXPECT_NE(body.find("what_nobody_knows"), std::string::npos);
  }
}

TEST(missions_faulty_service, another_major_version_is_recognised_as_such) {
  for (const auto& asked : {get(), get("/mapobjects"), get("/mapobjects/ignored"), two_reports()}) {
    faulty_world world("version");
    const auto document = mission::read<mission::document>(world.ask(asked).what.body);
    ASSERT_FALSE(document);
    EXPECT_EQ(document.error().code, mission::document_errc::other_version);
  }
}

TEST(missions_faulty_service, a_truncated_body_is_no_json) {
  faulty_world world("truncate");
  const auto document = mission::read<mission::document>(world.ask(get()).what.body);
  ASSERT_FALSE(document);
  EXPECT_EQ(document.error().code, mission::document_errc::syntax);
}

TEST(missions_faulty_service, faults_of_the_way_leave_the_answer_alone) {
  const auto plain = faulty_world("lose on none").ask(get());
  EXPECT_EQ(*faulty_world("reset").ask(get()).cut_after, plain.what.body.size() / 2);
  EXPECT_EQ(faulty_world("slow 100").ask(get()).bytes_per_s, 100U);
  EXPECT_EQ(faulty_world("delay 2s").ask(get()).delay, std::chrono::seconds(2));
  EXPECT_EQ(faulty_world("content-type text/html").ask(get()).what.content_type, "text/html");
  const auto huge = faulty_world("huge").ask(get());
  EXPECT_EQ(huge.what.body, plain.what.body);
  EXPECT_EQ(huge.what.body.size() + huge.padding, huge_body_bytes);
}

TEST(missions_faulty_service, several_faults_hit_one_answer) {
  faulty_world world("delay 1s");
  ASSERT_TRUE(world.book.add("status 500"));
  const auto given = world.ask(get());
  EXPECT_EQ(given.what.status, 500U);
  EXPECT_EQ(given.delay, std::chrono::seconds(1));
}

} // namespace faulty_service_test

// Each fault of the way, as it arrives at a client that knows nothing of HTTP.

namespace faulty_delivery_test {

namespace asio = boost::asio;
using asio::ip::tcp;

struct arrived {
  std::string head;
  std::string body;
  boost::system::error_code end; // eof, or the connection was reset
};

// What a client gets for one request, which is answered with WHAT.
arrived arrival_of(const delivery& what) {
  io::link::io_thread thread;
  io::http::server server(thread.context(), {}, {.handle = [&](io::http::server_request, io::http::responder to) {
                            deliver(thread.context(), std::move(to), what);
                          }});
  EXPECT_TRUE(server.listen());
  thread.start();
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), server.port()});
  asio::write(socket, asio::buffer(std::string("GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")));
  arrived got;
  std::string all;
  asio::read(socket, asio::dynamic_buffer(all), got.end);
  thread.stop();
  const auto end_of_head = all.find("\r\n\r\n");
  if (end_of_head != std::string::npos) {
    got.head = all.substr(0, end_of_head + 2);
    got.body = all.substr(end_of_head + 4);
  }
  return got;
}

delivery of_body(const std::string& body) { return {.what = {.body = body, .headers = {}}, .cut_after = {}}; }

TEST(missions_faulty_delivery, without_a_fault_the_answer_arrives_as_it_is) {
  const auto got = arrival_of(of_body("hello"));
  EXPECT_EQ(got.body, "hello");
  EXPECT_NE(got.head.find("\r\nContent-Length: 5\r\n"), std::string::npos);
  EXPECT_EQ(got.end, asio::error::eof);
}

TEST(missions_faulty_delivery, a_lost_answer_is_a_reset_without_a_byte) {
  auto lost = of_body("hello");
  lost.is_lost = true;
  const auto got = arrival_of(lost);
  EXPECT_EQ(got.head + got.body, "");
  EXPECT_EQ(got.end, asio::error::connection_reset);
}

TEST(missions_faulty_delivery, a_body_that_is_cut_still_promises_all_of_it) {
  auto cut = of_body("0123456789");
  cut.cut_after = 4;
  const auto got = arrival_of(cut);
  EXPECT_NE(got.head.find("\r\nContent-Length: 10\r\n"), std::string::npos);
  EXPECT_EQ(std::string("0123").substr(0, got.body.size()), got.body); // a reset may overtake them
  EXPECT_EQ(got.end, asio::error::connection_reset);
}

TEST(missions_faulty_delivery, padding_is_spaces_after_the_body) {
  auto padded = of_body("{}");
  padded.padding = 200'000;
  const auto got = arrival_of(padded);
  EXPECT_EQ(got.body, "{}" + std::string(200'000, ' '));
  EXPECT_EQ(got.end, asio::error::eof);
}

TEST(missions_faulty_delivery, a_slow_answer_comes_late_and_whole) {
  auto slow = of_body("abc");
  slow.bytes_per_s = 30; // a piece of three bytes, and a pause of 100 ms after it
  slow.delay = std::chrono::milliseconds(20);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(arrival_of(slow).body, "abc");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(120));
}

} // namespace faulty_delivery_test

} // namespace godwit::sim::missions
