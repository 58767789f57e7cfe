// The control socket and its client, over a real socket.
#include "programs/godwitd/control/server.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <mutex>
#include <semaphore>
#include <thread>

#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "programs/common/control_client.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace server_test {

using namespace godwit;
using namespace godwit::control;
using namespace std::chrono_literals;
using io::link::descriptor;
using test::scratch;

// A socket whose request_handler is the test: it answers at once, or keeps the tickets.
struct request_handler {
  explicit request_handler(const std::string& path, bool answers_at_once = true, server_limits limits = {})
      : answers(std::make_shared<response_queue>(descriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)))) {
    auto opened = server::open(
        path, answers,
        [this, answers_at_once](const control_request& asked) {
          if (answers_at_once)
            answers->put({asked.ticket, R"({"ok":true,"key":")" + asked.key + "\"}"});
          const std::lock_guard guard(mutex);
          asked_for.push_back(asked);
          came.release();
        },
        limits);
    if (opened)
      running = *std::move(opened);
    else
      error = opened.error();
  }
  std::shared_ptr<response_queue> answers;
  std::mutex mutex;
  std::vector<control_request> asked_for;
  std::counting_semaphore<> came{0};
  std::string error;
  std::unique_ptr<server> running;
};

// A client without manners.
struct raw_client {
  explicit raw_client(const std::string& path) : socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const auto address = unix_address(path).value();
    EXPECT_EQ(::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  void say(const std::string& text) const {
    EXPECT_EQ(::send(socket.number(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  // Until the end of a line or of the connection.
  [[nodiscard]] std::string hear() const {
    std::string result;
    for (char each = 0; ::read(socket.number(), &each, 1) == 1 && each != '\n';)
      result += each;
    return result;
  }
  descriptor socket;
};

nlohmann::json retry(const std::string& key) { return {{"do", "outbox_retry"}, {"key", key}}; }

TEST(control_server, a_question_is_answered) {
  const scratch folder;
  const request_handler here(folder.file("control"));
  const auto answer = ask_daemon(folder.file("control"), retry("abc"));
  ASSERT_TRUE(answer) << answer.error();
  EXPECT_EQ(answer->at("key"), "abc");
}

TEST(control_server, only_its_own_user_reaches_it_and_afterwards_the_file_is_gone) {
  const scratch folder;
  struct stat there {};
  {
    const request_handler here(folder.file("control"));
    ASSERT_EQ(::stat(folder.file("control").c_str(), &there), 0);
    EXPECT_EQ(there.st_mode & 0777U, 0600U);
  }
  EXPECT_NE(::stat(folder.file("control").c_str(), &there), 0);
}

TEST(control_server, what_a_killed_daemon_left_is_replaced) {
  const scratch folder;
  const auto path = folder.file("control");
  {
    const descriptor left(::socket(AF_UNIX, SOCK_STREAM, 0));
    const auto address = unix_address(path).value();
    ASSERT_EQ(::bind(left.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  const request_handler here(path);
  EXPECT_EQ(here.error, "");
  EXPECT_TRUE(ask_daemon(path, retry("abc")));
}

// As one that was stopped, or has more to do than it gets done.
TEST(control_server, a_daemon_that_lets_wait_keeps_its_socket) {
  const scratch folder;
  const auto path = folder.file("control");
  const auto address = unix_address(path).value();
  const descriptor busy(::socket(AF_UNIX, SOCK_STREAM, 0));
  ASSERT_EQ(::bind(busy.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(busy.number(), 0), 0);
  std::vector<descriptor> waiting;
  for (int error = 0; error == 0;) {
    waiting.emplace_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
    error = ::connect(waiting.back().number(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  const request_handler second(path);
  EXPECT_NE(second.error.find("another godwitd"), std::string::npos) << second.error;
  EXPECT_TRUE(std::filesystem::is_socket(path));
}

TEST(control_server, what_came_into_its_place_is_not_removed) {
  const scratch folder;
  {
    const request_handler here(folder.file("control"));
    std::filesystem::remove(folder.file("control"));
    (void)folder.write("control", "another's");
  }
  EXPECT_EQ(scratch::read(folder.file("control")), "another's");
}

TEST(control_server, without_descriptors_it_waits_and_does_not_spin) {
  const scratch folder;
  const request_handler here(folder.file("control"));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  std::vector<raw_client> clients;
  for (int i = 0; i < 3; ++i)
    clients.emplace_back(folder.file("control"));
  std::vector<descriptor> hogs;
  const rlimit few{64, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  descriptor late(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  for (;;) {
    descriptor each(::eventfd(0, EFD_CLOEXEC));
    if (!each.is_open())
      break;
    hogs.push_back(std::move(each));
  }
  const auto address = unix_address(folder.file("control")).value();
  ASSERT_EQ(::connect(late.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const auto cpu = std::clock();
  std::this_thread::sleep_for(500ms);
  EXPECT_LT(std::clock() - cpu, CLOCKS_PER_SEC / 10) << "of half a second";
  hogs.clear();
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  const std::string line = R"({"do": "status"})"
                           "\n";
  ASSERT_EQ(::send(late.number(), line.data(), line.size(), MSG_NOSIGNAL), static_cast<ssize_t>(line.size()));
  char first = 0;
  EXPECT_EQ(::read(late.number(), &first, 1), 1) << "it is let in later";
}

TEST(control_server, a_socket_on_which_somebody_listens_and_a_file_that_is_none_are_left_alone) {
  const scratch folder;
  const request_handler first(folder.file("control"));
  const request_handler second(folder.file("control"));
  EXPECT_NE(second.error.find("another godwitd"), std::string::npos) << second.error;
  EXPECT_TRUE(ask_daemon(folder.file("control"), retry("abc")));
  const request_handler third(folder.write("notes", "text"));
  EXPECT_NE(third.error.find("is no socket"), std::string::npos) << third.error;
  EXPECT_EQ(scratch::read(folder.file("notes")), "text");
}

TEST(control_server, a_path_that_is_too_long_is_an_error_on_both_sides) {
  const scratch folder;
  const auto path = folder.file(std::string(150, 'x'));
  EXPECT_NE(request_handler(path).error.find("shorter"), std::string::npos);
  EXPECT_FALSE(ask_daemon(path, retry("abc")));
}

TEST(control_server, a_client_that_hangs_holds_up_nobody) {
  const scratch folder;
  const request_handler here(folder.file("control"));
  const raw_client half(folder.file("control"));
  half.say("{\"do\": ");
  const raw_client silent(folder.file("control"));
  EXPECT_TRUE(ask_daemon(folder.file("control"), retry("abc")));
}

TEST(control_server, a_request_without_an_answer_is_answered_by_the_socket) {
  const scratch folder;
  const request_handler here(folder.file("control"), false, {.answer_timeout = 30ms});
  const auto answer = ask_daemon(folder.file("control"), retry("abc"));
  ASSERT_TRUE(answer) << answer.error();
  EXPECT_EQ(answer->at("ok"), false);
}

TEST(control_server, requests_in_one_piece_are_answered_one_after_the_other) {
  const scratch folder;
  const request_handler here(folder.file("control"));
  const raw_client hasty(folder.file("control"));
  hasty.say(retry("1").dump() + "\n" + retry("2").dump() + "\nnonsense\n" + retry("3").dump() + "\n");
  EXPECT_EQ(hasty.hear(), R"({"ok":true,"key":"1"})");
  EXPECT_EQ(hasty.hear(), R"({"ok":true,"key":"2"})");
  EXPECT_NE(hasty.hear().find("JSON object"), std::string::npos);
  EXPECT_EQ(hasty.hear(), R"({"ok":true,"key":"3"})");
}

TEST(control_server, a_line_that_is_too_long_ends_the_connection_with_a_sentence) {
  const scratch folder;
  const request_handler here(folder.file("control"));
  const raw_client loud(folder.file("control"));
  loud.say(std::string(5'000, 'x'));
  EXPECT_NE(loud.hear().find("4096 bytes"), std::string::npos);
  EXPECT_EQ(loud.hear(), "");
}

TEST(control_server, who_comes_when_all_places_are_taken_is_told_so) {
  const scratch folder;
  const request_handler here(folder.file("control"), true, {.max_clients = 1});
  const raw_client first(folder.file("control"));
  first.say(retry("1").dump() + "\n");
  EXPECT_NE(first.hear(), "");
  const raw_client second(folder.file("control"));
  EXPECT_NE(second.hear().find("too many"), std::string::npos);
}

TEST(control_server, a_silent_client_is_closed_after_a_while) {
  const scratch folder;
  const request_handler here(folder.file("control"), true, {.idle_timeout = 30ms});
  const raw_client silent(folder.file("control"));
  EXPECT_EQ(silent.hear(), "");
}

TEST(control_server, an_answer_for_somebody_who_has_left_goes_nowhere) {
  const scratch folder;
  request_handler here(folder.file("control"), false);
  {
    const raw_client leaves(folder.file("control"));
    leaves.say(retry("1").dump() + "\n");
    here.came.acquire();
  }
  here.answers->put({here.asked_for.front().ticket, "{}"});
  const raw_client next(folder.file("control"));
  next.say("nonsense\n");
  EXPECT_NE(next.hear().find("JSON object"), std::string::npos);
}

TEST(control_client, where_nobody_listens_it_says_so) {
  const scratch folder;
  const auto answer = ask_daemon(folder.file("control"), retry("abc"));
  ASSERT_FALSE(answer);
  EXPECT_NE(answer.error().find("does it run"), std::string::npos);
}

} // namespace server_test
