// The session is run as the program runs it, against a link of ours on loopback that plays the vehicle.
#include "programs/godwit-trace/link_session.hpp"

#include <atomic>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/eventfd.h>
#include <unistd.h>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace link_session_test {

using namespace io::mavlink;
using namespace std::chrono_literals;

constexpr auto patience = 30s; // wide, because the machine may be busy: a test that passes never waits for it

// A descriptor pair whose reading end is gathered by a thread, so that a test can wait for text.
class watched_pipe {
public:
  watched_pipe() {
    EXPECT_EQ(::pipe(ends_.data()), 0);
    reader_ = std::thread([this] {
      std::array<char, 4096> piece{};
      for (ssize_t got = 0; (got = ::read(ends_[0], piece.data(), piece.size())) > 0;) {
        const std::lock_guard guard(mutex_);
        text_.append(piece.data(), static_cast<std::size_t>(got));
        changed_.notify_all();
      }
    });
  }
  watched_pipe(const watched_pipe&) = delete;
  watched_pipe& operator=(const watched_pipe&) = delete;
  ~watched_pipe() {
    ::close(ends_[1]);
    reader_.join();
    ::close(ends_[0]);
  }

  [[nodiscard]] int writing_end() const { return ends_[1]; }
  // The text as soon as PART is in it; what there is when the patience is over.
  [[nodiscard]] std::string wait_for(const std::string& part) {
    std::unique_lock guard(mutex_);
    changed_.wait_for(guard, patience, [&] { return text_.find(part) != std::string::npos; });
    return text_;
  }

private:
  std::array<int, 2> ends_{};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string text_;
  std::thread reader_;
};

// A session in a thread of its own.
class running_session {
public:
  explicit running_session(link_session_options options, bool is_terminal = false)
      : to_{out_, words_, is_terminal}, stop_(::eventfd(0, EFD_CLOEXEC)) {
    thread_ =
        std::thread([this, given = std::move(options)]() mutable { code_ = run_link(std::move(given), to_, stop_); });
  }
  running_session(const running_session&) = delete;
  running_session& operator=(const running_session&) = delete;
  ~running_session() {
    stop();
    ::close(stop_);
  }

  [[nodiscard]] std::string wait_for_out(const std::string& part) { return out_pipe_.wait_for(part); }
  [[nodiscard]] std::string wait_for_words(const std::string& part) { return words_pipe_.wait_for(part); }
  // Of a session that listens on a free port.
  [[nodiscard]] std::string port() {
    const std::string mark = "up: listening on udpin://127.0.0.1:";
    const auto text = wait_for_words(mark);
    const auto begin = text.find(mark) + mark.size();
    return text.substr(begin, text.find_first_not_of("0123456789", begin) - begin);
  }
  exit_code stop() {
    const std::uint64_t one = 1;
    EXPECT_EQ(::write(stop_, &one, sizeof one), static_cast<ssize_t>(sizeof one));
    return wait();
  }
  exit_code wait() {
    if (thread_.joinable())
      thread_.join();
    return code_;
  }

private:
  watched_pipe out_pipe_;
  watched_pipe words_pipe_;
  output out_{out_pipe_.writing_end()};
  output words_{words_pipe_.writing_end()};
  console to_;
  int stop_;
  exit_code code_ = exit_code::usage;
  std::thread thread_;
};

link_session_options listening() {
  link_session_options options;
  options.where = *io::link::parse_uri("udpin://127.0.0.1:0");
  return options;
}

// The vehicle: sends frames to a port, and counts the heartbeats that it hears.
class vehicle {
public:
  explicit vehicle(const std::string& uri) {
    io::link::link_callbacks callbacks;
    callbacks.received = [this](io::link::peer_id, std::span<const std::byte> bytes, bool) {
      const auto frame = view_of(bytes);
      const std::lock_guard guard(mutex_);
      if (frame && frame->id() == heartbeat::message_id)
        heard_.emplace_back(bytes.begin(), bytes.end());
      changed_.notify_all();
    };
    callbacks.changed = [this](const io::link::link_status& status) {
      const std::lock_guard guard(mutex_);
      is_up_ = status.phase == io::link::link_phase::up;
      changed_.notify_all();
    };
    link_ = *io::link::open_link(*io::link::parse_uri(uri), std::move(callbacks));
    std::unique_lock guard(mutex_);
    EXPECT_TRUE(changed_.wait_for(guard, patience, [this] { return is_up_; }));
  }

  void send(std::span<const std::byte> bytes) { EXPECT_TRUE(link_->send(bytes)); }
  template <message M>
  void say(const M& message) {
    send(frame_of(message, sequence_++).span());
  }
  [[nodiscard]] std::vector<std::byte> wait_for_heartbeat() {
    std::unique_lock guard(mutex_);
    EXPECT_TRUE(changed_.wait_for(guard, patience, [this] { return !heard_.empty(); }));
    return heard_.empty() ? std::vector<std::byte>() : heard_.front();
  }
  [[nodiscard]] std::string description() const { return link_->description(); }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_up_ = false;
  std::vector<std::vector<std::byte>> heard_;
  std::uint8_t sequence_ = 0;
  std::unique_ptr<io::link::link> link_;
};

TEST(link_session, what_arrives_is_printed_and_counted_at_the_end) {
  running_session session(listening());
  vehicle peer("udpout://127.0.0.1:" + session.port());
  peer.say(heartbeat{.type = 2, .autopilot = 12});
  peer.say(mission_item_reached{.seq = 3});
  const auto text = session.wait_for_out("MISSION_ITEM_REACHED seq=3\n");
  EXPECT_NE(text.find("1/1     HEARTBEAT            type=2(QUADROTOR)"), std::string::npos) << text;
  EXPECT_EQ(session.stop(), exit_code::ok);
  const auto words = session.wait_for_words("passed over: nothing");
  EXPECT_NE(words.find("2 frames, "), std::string::npos) << words;
}

TEST(link_session, it_ends_after_so_many_messages_that_pass_the_filter) {
  auto options = listening();
  options.count = 2;
  options.print.form = print_form::json;
  options.print.filter = message_filter(*name_filter::parse(std::vector<std::string>{"mission_*"}), {}, {});
  running_session session(std::move(options));
  vehicle peer("udpout://127.0.0.1:" + session.port());
  for (std::uint16_t i = 0; i < 3; ++i) {
    peer.say(heartbeat{});
    peer.say(mission_item_reached{.seq = i});
  }
  EXPECT_EQ(session.wait(), exit_code::ok);
  const auto lines = lines_of(session.wait_for_out("\"seq\":1"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(nlohmann::json::parse(lines[1]).at("fields").at("seq"), 1);
}

TEST(link_session, time_that_passes_in_silence_is_a_failure) {
  auto options = listening();
  options.seconds = 20ms;
  running_session session(std::move(options));
  EXPECT_EQ(session.wait(), exit_code::failed);
  EXPECT_NE(session.wait_for_words("not one MAVLink 2 frame was heard\n"), "");
}

TEST(link_session, statistics_are_printed_once_where_there_is_no_terminal) {
  auto options = listening();
  options.print.stats = true;
  options.print.form = print_form::json;
  options.count = 3;
  running_session session(std::move(options));
  vehicle peer("udpout://127.0.0.1:" + session.port());
  peer.say(heartbeat{});
  peer.say(attitude{});
  const auto whole = frame_of(heartbeat{}, 2);
  std::vector<std::byte> damaged(whole.span().begin(), whole.span().end());
  damaged.back() ^= std::byte{1};
  peer.send(damaged);
  peer.send(std::vector<std::byte>(4, std::byte{'x'}));
  peer.send(frame_of(heartbeat{}, 3).span());
  EXPECT_EQ(session.wait(), exit_code::ok);
  const auto lines = lines_of(session.wait_for_out("\n"));
  ASSERT_EQ(lines.size(), 1U);
  const auto stats = nlohmann::json::parse(lines[0]);
  EXPECT_EQ(stats.at("frames"), 3);
  EXPECT_EQ(stats.at("senders").at(0).at("lost"), 1);
  EXPECT_EQ(stats.at("passed_over").at("bad_checksums"), 1);
  EXPECT_GE(stats.at("passed_over").at("garbage_bytes"), 4);
}

TEST(link_session, on_a_terminal_the_table_is_drawn_anew) {
  auto options = listening();
  options.print.stats = true;
  running_session session(std::move(options), true);
  vehicle peer("udpout://127.0.0.1:" + session.port());
  peer.say(heartbeat{});
  const auto text = session.wait_for_out("HEARTBEAT");
  EXPECT_TRUE(text.starts_with("\x1b[H\x1b[2J")) << text;
  EXPECT_EQ(session.stop(), exit_code::ok);
}

TEST(link_session, what_arrives_is_recorded_whatever_is_shown) {
  const temporary_folder folder;
  auto options = listening();
  options.tlog = folder / "heard.tlog";
  options.print.filter = message_filter(*name_filter::parse(std::vector<std::string>{"mission_*"}), {}, {});
  options.count = 1;
  running_session session(std::move(options));
  vehicle peer("udpout://127.0.0.1:" + session.port());
  peer.say(heartbeat{});
  peer.say(mission_item_reached{.seq = 3});
  EXPECT_EQ(session.wait(), exit_code::ok);
  EXPECT_NE(session.wait_for_words("2 frames recorded"), "");
  io::mcap::file_source source;
  ASSERT_TRUE(source.open(folder / "heard.tlog"));
  tlog_reader reader(source);
  ASSERT_TRUE(*reader.next());
  const auto second = reader.next();
  ASSERT_TRUE(second && *second);
  EXPECT_EQ((*second)->frame.id(), mission_item_reached::message_id);
}

TEST(link_session, a_recording_that_can_not_be_opened_ends_it_at_once) {
  auto options = listening();
  options.tlog = "/no/such/folder/a.tlog";
  running_session session(std::move(options));
  EXPECT_EQ(session.wait(), exit_code::failed);
  EXPECT_NE(session.wait_for_words("there is no folder /no/such/folder"), "");
}

TEST(link_session, with_a_key_unsigned_frames_are_refused_in_words) {
  auto options = listening();
  options.keys = link_keys{counting_key(), counting_key()};
  options.count = 1;
  running_session session(std::move(options));
  vehicle peer("udpout://127.0.0.1:" + session.port());
  peer.say(attitude{});
  const auto words = session.wait_for_words("refused ATTITUDE of 1/1: it is not signed");
  EXPECT_NE(words.find("it is not signed"), std::string::npos);
  signer key(counting_key(), link_id{1}, signing_time{0});
  auto frame = encode(mission_item_reached{.seq = 4}, {1, 1}, 1, signing::on);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  ASSERT_TRUE(key.sign(frame, std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()));
  peer.send(frame.span());
  EXPECT_EQ(session.wait(), exit_code::ok);
  const auto out = session.wait_for_out("(signed)\n");
  EXPECT_EQ(lines_of(out).size(), 1U) << out;
}

TEST(link_session, a_heartbeat_goes_out_if_it_is_asked_for) {
  vehicle peer("udpin://127.0.0.1:0");
  const auto uri = peer.description();
  link_session_options options;
  options.where = *io::link::parse_uri("udpout" + uri.substr(uri.find(':')));
  options.heartbeat_as = sender{7, 191};
  running_session session(std::move(options));
  const auto bytes = peer.wait_for_heartbeat();
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(view_of(bytes)->from(), (sender{7, 191}));
  EXPECT_EQ(session.stop(), exit_code::ok);
}

TEST(link_session, mavlink_1_alone_is_named_with_the_remedy) {
  running_session session(listening());
  vehicle peer("udpout://127.0.0.1:" + session.port());
  // A heartbeat of MAVLink 1: FE, length, sequence, system, component, id, payload, checksum.
  frame_buffer modern = frame_of(heartbeat{.mavlink_version = 3});
  std::vector<std::byte> old{std::byte{0xFE}, std::byte{9}, std::byte{0}, std::byte{1}, std::byte{1}, std::byte{0}};
  const auto payload = modern.view().payload();
  old.insert(old.end(), payload.begin(), payload.end());
  const auto crc = frame_crc(std::span(old).subspan(1), heartbeat::crc_extra);
  old.push_back(static_cast<std::byte>(crc & 0xFFU));
  old.push_back(static_cast<std::byte>(crc >> 8U));
  peer.send(old);
  peer.send(old);
  EXPECT_NE(session.wait_for_words("SERIALn_PROTOCOL = 2").find("only MAVLink 1"), std::string::npos);
  EXPECT_EQ(session.stop(), exit_code::ok);
}

TEST(link_session, a_link_that_can_not_come_up_says_why_and_goes_on_trying) {
  link_session_options options;
  options.where = *io::link::parse_uri("serial:///dev/godwit-no-such-port:57600");
  running_session session(std::move(options));
  EXPECT_NE(session.wait_for_words("down: /dev/godwit-no-such-port: no such device").find("down: "), std::string::npos);
  EXPECT_EQ(session.stop(), exit_code::ok);
}

} // namespace link_session_test
} // namespace godwit::trace_tool::test
