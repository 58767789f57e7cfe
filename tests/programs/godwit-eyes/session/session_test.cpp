#include "programs/godwit-eyes/session/session.hpp"

#include <ctime>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace session_test {

using namespace godwit;
using namespace godwit::eyes;
using namespace std::chrono_literals;

std::int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

// The daemon's side of a session that runs in a thread.
class daemon_side {
public:
  daemon_side()
      : slot_(io::eyes::picture_slot::make().value()), ends_(io::eyes::make_channel_pair().value()),
        ours_(std::move(ends_.first)), thread_([this] {
          auto theirs = std::move(ends_.second);
          auto slot =
              io::eyes::picture_slot::attach(io::link::descriptor(::fcntl(slot_.number(), F_DUPFD_CLOEXEC, 0))).value();
          end = run_session(theirs, slot);
          ::alarm(0); // of a program that has nothing else to do
        }) {}
  ~daemon_side() {
    ours_.reset();
    thread_.join();
  }

  void begin(const std::string& uri, const std::string& record_folder = {}) {
    io::eyes::begin how;
    how.uri = uri;
    how.record_folder = record_folder;
    how.record_max_mb = 100;
    EXPECT_EQ(ours_->send(how), io::eyes::send_result::sent);
  }
  // The first status for which CONDITION holds; the last one, when none came in time.
  template <class Condition>
  io::eyes::status wait_for(Condition condition) {
    io::eyes::status last;
    for (const auto until = monotonic_ns() + 20'000'000'000; monotonic_ns() < until;) {
      const auto read = ours_->receive();
      if (read && read->said)
        if (const auto* status = std::get_if<io::eyes::status>(&*read->said)) {
          last = *status;
          if (condition(last))
            return last;
          if (wants_pictures)
            (void)ours_->send(io::eyes::want_picture{monotonic_ns() + 3'000'000'000, 50});
          continue;
        }
      pollfd socket{ours_->number(), POLLIN, 0};
      (void)::poll(&socket, 1, 100);
    }
    ADD_FAILURE() << "it did not come to it: " << last.reason << last.unusable;
    return last;
  }
  io::eyes::channel& channel() { return *ours_; }
  [[nodiscard]] const io::eyes::picture_slot& slot() const { return slot_; }
  // As the daemon's end would.
  session_end leave() {
    ours_.reset();
    thread_.join();
    thread_ = std::thread([] {});
    return end;
  }
  bool wants_pictures = false;

private:
  io::eyes::picture_slot slot_;
  std::pair<io::eyes::channel, io::eyes::channel> ends_;
  std::optional<io::eyes::channel> ours_;
  session_end end = session_end::stuck;
  std::thread thread_;
};

TEST(eyes_session, it_says_how_it_is_and_looks_at_what_comes) {
  daemon_side s;
  s.begin("test://snow?fps=30");
  const auto now = s.wait_for([](const auto& status) { return status.looked > 10; });
  EXPECT_EQ(now.source, io::eyes::source_state::playing);
  EXPECT_EQ(now.width_px, 640);
  EXPECT_GT(now.frames_per_s, 5);
  EXPECT_EQ(now.fault, io::eyes::picture_fault::none);
  EXPECT_EQ(s.leave(), session_end::closed);
}

TEST(eyes_session, a_picture_is_made_while_somebody_wants_it) {
  daemon_side s;
  s.begin("test://snow?fps=30");
  (void)s.wait_for([](const auto& status) { return status.looked > 10; });
  EXPECT_FALSE(s.slot().read()) << "nobody has asked";
  s.wants_pictures = true;
  (void)s.wait_for([](const auto& status) { return status.pictures > 3; });
  const auto seen = s.slot().read();
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->width_px, 640);
  EXPECT_EQ(seen->jpeg[0], std::byte{0xFF});
  EXPECT_LT(monotonic_ns() - seen->captured_ns, 5'000'000'000);
}

TEST(eyes_session, a_camera_that_is_not_there_is_said_again_and_again) {
  daemon_side s;
  s.begin("v4l2:///dev/video-none");
  const auto now = s.wait_for([](const auto& status) { return status.opened > 1; });
  EXPECT_NE(now.reason.find("/dev/video-none"), std::string::npos);
}

TEST(eyes_session, an_address_that_is_none_is_said) {
  daemon_side s;
  s.begin("nowhere");
  const auto now = s.wait_for([](const auto& status) { return status.source == io::eyes::source_state::failed; });
  EXPECT_NE(now.reason.find("camera.uri"), std::string::npos);
}

TEST(eyes_session, black_pictures_are_named) {
  daemon_side s;
  s.begin("test://black?fps=30");
  (void)s.wait_for([](const auto& status) { return status.fault == io::eyes::picture_fault::black; });
}

TEST(eyes_session, garbage_of_the_daemon_ends_it) {
  daemon_side s;
  s.begin("test://snow?fps=30");
  ASSERT_GT(::send(s.channel().number(), "nonsense and more", 17, 0), 0);
  (void)s.channel();
  EXPECT_EQ(s.leave(), session_end::garbage);
}

} // namespace session_test
