#include "programs/godwitd/link_log/link_log.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwitd/link_log/link_files.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace link_log_test {

using namespace godwit;
using namespace godwit::daemon;
using runtime::health_colour;
using test::heartbeat;
namespace fs = std::filesystem;

struct opened_log {
  opened_log() {
    link_log_options options;
    options.folder = folder.file("trace");
    auto opened = link_log::open(options, 3, time, health);
    EXPECT_TRUE(opened);
    log = *std::move(opened);
    vehicle = log->tap(recorded_link::vehicle);
    ground = log->tap(recorded_link::ground);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder.file("trace/" + name); }
  [[nodiscard]] std::string reason() const { return health.entries().empty() ? "" : health.entries()[0].reason; }

  test::scratch folder;
  test::set_time time;
  runtime::health_board health;
  std::unique_ptr<link_log> log;
  std::shared_ptr<io::link::tap> vehicle;
  std::shared_ptr<io::link::tap> ground;
};

TEST(link_log, each_link_has_its_own_files_with_the_times_at_which_frames_came_and_went) {
  opened_log of;
  of.vehicle->received(1, heartbeat(1).span(), true);
  of.time.now_ns = 5'000'000;
  of.vehicle->sent(heartbeat(2).span());
  of.ground->received(4, heartbeat(3).span(), false);
  of.log->drain();
  EXPECT_EQ(test::records_of(of.file("vehicle-0000000003-000001.tlog")),
            (std::vector<test::logged>{{1'781'000'000'000'000, 0, 1, false}, {1'781'000'000'005'000, 0, 2, false}}));
  EXPECT_EQ(test::records_of(of.file("ground-0000000003-000001.tlog")),
            (std::vector<test::logged>{{1'781'000'000'005'000, 0, 3, false}}));
  EXPECT_EQ(of.health.worst(), health_colour::green);
}

TEST(link_log, what_comes_faster_than_it_is_written_is_dropped_and_said_and_holds_nobody_up) {
  opened_log of;
  const auto frame = heartbeat();
  const auto pieces = chunk_buffer::max_waiting_chunks + 5;
  for (std::size_t n = 0; n < pieces; ++n)
    of.vehicle->received(1, frame.span(), true);
  of.log->drain();
  EXPECT_EQ(test::records_of(of.file("vehicle-0000000003-000001.tlog")).size(), chunk_buffer::max_waiting_chunks);
  EXPECT_EQ(of.health.worst(), health_colour::yellow);
  EXPECT_NE(of.reason().find("5 pieces"), std::string::npos) << of.reason();
  of.time.now_ns += link_log::quiet_ns;
  of.log->drain();
  EXPECT_EQ(of.health.worst(), health_colour::green) << "nothing was lost for a while";
}

TEST(link_log, memory_that_waits_is_bounded_in_bytes_too) {
  chunk_buffer buffer;
  const std::vector<std::byte> large(64 * 1024);
  std::size_t taken = 0;
  while (buffer.put({}, large))
    ++taken;
  EXPECT_EQ(taken * large.size(), chunk_buffer::max_waiting_bytes);
  link_batch batch;
  buffer.take(batch);
  EXPECT_EQ(batch.chunks.size(), taken);
  EXPECT_TRUE(buffer.put({}, large));
  EXPECT_EQ(buffer.dropped(), 1U);
}

TEST(link_log, a_disk_that_refuses_is_said_and_heals) {
  opened_log of;
  fs::remove_all(of.folder.file("trace"));
  of.ground->received(1, heartbeat().span(), true);
  of.log->drain();
  EXPECT_EQ(of.health.worst(), health_colour::yellow);
  EXPECT_NE(of.reason().find("the ground link has lost 1 frames"), std::string::npos) << of.reason();
  fs::create_directory(of.folder.file("trace"));
  of.time.now_ns += 2 * link_log::quiet_ns;
  of.ground->received(1, heartbeat(8).span(), true);
  of.log->drain();
  EXPECT_EQ(of.health.worst(), health_colour::green);
}

TEST(link_log, its_thread_writes_all_that_waited_before_it_ends) {
  opened_log of;
  of.log->start();
  of.vehicle->received(1, heartbeat(1).span(), true);
  of.log->close();
  of.vehicle->received(1, heartbeat(2).span(), true);
  EXPECT_EQ(test::records_of(of.file("vehicle-0000000003-000001.tlog")).size(), 1U);
}

} // namespace link_log_test
