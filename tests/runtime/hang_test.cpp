// Actors whose handler does not return, on real threads: what can not be tried in a simulation of one thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <future>
#include <mutex>
#include <thread>

#include <sys/wait.h>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/repair.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/process.hpp"
#include "runtime/system.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"
#include "tests/support/strict_mcap_reader.hpp"

namespace hang_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace std::chrono_literals;

struct hang {
  static constexpr auto fields = io::table("test.hang");
};
struct note {
  int number = 0;
  static constexpr auto fields = io::table("test.note", io::field("number", &note::number));
};
struct get_later {
  static constexpr auto fields = io::table("test.get_later");
};
struct hand_out {
  static constexpr auto fields = io::table("test.hand_out");
};
struct given {
  int number = 0;
  static constexpr auto fields = io::table("test.given", io::field("number", &given::number));
};

using sleeper_handle = mailbox<tells<hang>, tells<note>, asks<get_later, given>, tells<hand_out>>;
using listener_handle = mailbox<tells<note>>;

// What all threads write into.
struct diary {
  void add(int number) {
    const std::lock_guard guard(mutex);
    heard.push_back(number);
  }
  [[nodiscard]] std::vector<int> list() {
    const std::lock_guard guard(mutex);
    return heard;
  }
  std::mutex mutex;
  std::vector<int> heard;
  std::promise<void> open_latch;
  std::shared_future<void> latch = open_latch.get_future().share();
  std::atomic<int> inside{0}; // handlers that wait for the latch
};

class listener final : public actor_base<listener_handle> {
public:
  listener(spawn_context context, diary* book) : actor_base(std::move(context)), book_(book) {}

protected:
  behavior_type handlers() override {
    return {on<note>([this](const note& n) { book_->add(n.number); })};
  }

private:
  diary* book_;
};

// Hangs on command; passes notes on, with its incarnation in the hundreds.
class sleeper final : public actor_base<sleeper_handle> {
public:
  sleeper(spawn_context context, listener_handle next, diary* book)
      : actor_base(std::move(context)), next_(std::move(next)), book_(book) {}

protected:
  behavior_type handlers() override {
    return {
        on<hang>([this](const hang&) {
          tell(next_, note{666});
          ++book_->inside;
          book_->latch.wait();
          --book_->inside;
          tell(next_, note{667});
        }),
        on<note>([this](const note& n) { tell(next_, note{n.number + 100 * static_cast<int>(incarnation_number())}); }),
        on_deferred<get_later, given>([this](const get_later&, std::uint64_t request) { asked_.push_back(request); }),
        on<hand_out>([this](const hand_out&) {
          for (const auto each : asked_)
            answer_later(each, given{42});
          asked_.clear();
        })};
  }

private:
  listener_handle next_;
  diary* book_;
  std::vector<std::uint64_t> asked_;
};

using asker_handle = mailbox<tells<get_later>>;

// Asks the sleeper and tells the listener what came: the number, or -1 for an error.
class asker final : public actor_base<asker_handle> {
public:
  asker(spawn_context context, sleeper_handle whom, diary* book)
      : actor_base(std::move(context)), whom_(std::move(whom)), book_(book) {}

protected:
  behavior_type handlers() override {
    return {on<get_later>([this](const get_later& q) {
      ask(
          whom_, 20s, q, [this](const given& g) { book_->add(g.number); },
          [this](const ask_error&) { book_->add(-1); });
    })};
  }

private:
  sleeper_handle whom_;
  diary* book_;
};

// A trace for many threads: the outcomes of test.hang.
class outcomes final : public trace_sink {
public:
  [[nodiscard]] std::int64_t ticks() const noexcept override { return 0; }
  void record(const trace_entry& entry, const message_type& type, const void*) noexcept override {
    if (type.name == hang::fields.type_name) {
      const std::lock_guard guard(mutex_);
      list_.push_back(entry.how);
    }
  }
  [[nodiscard]] std::vector<outcome> list() {
    const std::lock_guard guard(mutex_);
    return list_;
  }

private:
  std::mutex mutex_;
  std::vector<outcome> list_;
};

// Until the condition holds or the time is over; generous, because machines that test are busy.
bool wait_for(const std::function<bool()>& condition, milliseconds at_most = 20s) {
  const auto end = std::chrono::steady_clock::now() + at_most;
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(1ms);
  return condition();
}

struct real_world {
  // On a busy machine all are late together, so the fatal limit is far above what a free worker needs.
  explicit real_world(bool essential, std::size_t workers = 3) : actors(outside(), options(workers)) {
    child_policy patient;
    patient.restart = {.intensity = 100, .backoff_max = 10ms};
    auto watched = patient;
    watched.essential = essential;
    ear = actors.add<listener>({.name = "listener"}, patient, &book);
    bed = actors.add<sleeper>({.name = "sleeper"}, watched, ear, &book);
    front = actors.add<asker>({.name = "asker"}, patient, bed, &book);
    gate.emplace(actors.make_gateway("test"));
    actors.start();
  }
  services outside() {
    services result;
    result.time = &time;
    result.names = &names;
    result.health = &health;
    result.trace = &traced;
    return result;
  }
  static system_options options(std::size_t workers) {
    system_options result;
    result.workers = workers;
    result.ping = {.period = 20ms, .warn = 200ms, .fatal = 1s};
    result.stop_timeout = 200ms;
    return result;
  }
  [[nodiscard]] health_entry sleeper_health() const {
    for (const auto& each : health.entries())
      if (each.component == "sleeper")
        return each;
    return {};
  }
  [[nodiscard]] address_counters sleeper_counters() const { return actors.counters(1); }
  [[nodiscard]] bool heard(int number) {
    const auto all = book.list();
    return std::find(all.begin(), all.end(), number) != all.end();
  }
  void fall_asleep() {
    gate->tell(bed, hang{});
    ASSERT_TRUE(wait_for([&] { return book.inside == 1; }));
  }
  void wait_for_successor() {
    ASSERT_TRUE(wait_for([&] { return actors.restarts() >= 1; }));
  }

  system_time time;
  directory names;
  health_board health;
  outcomes traced;
  diary book;
  runtime::system actors;
  std::optional<gateway> gate;
  listener_handle ear;
  sleeper_handle bed;
  asker_handle front;
};

TEST(hang, an_actor_that_hangs_is_replaced_and_its_successor_handles_the_later_mail) {
  real_world w(false);
  w.fall_asleep();
  for (int i = 1; i <= 5; ++i)
    w.gate->tell(w.bed, note{i}); // stranded after the hanging handler
  EXPECT_TRUE(wait_for([&] { return w.sleeper_health().colour == health_colour::red || w.actors.restarts() > 0; }));
  w.wait_for_successor();
  EXPECT_TRUE(wait_for([&] { return w.sleeper_health().colour == health_colour::green; }));
  w.gate->tell(w.bed, note{6});
  // The first incarnation is number 1, giving it up takes number 2.
  EXPECT_TRUE(wait_for([&] { return w.heard(306); }));
  EXPECT_FALSE(w.heard(301)) << "stranded mail is not handled while the handler hangs";
  EXPECT_EQ(w.sleeper_counters().crashes, 1U);
  EXPECT_FALSE(w.actors.exit_requested()) << "it is not essential";

  w.book.open_latch.set_value();
  for (int i = 1; i <= 5; ++i)
    EXPECT_TRUE(wait_for([&] { return w.heard(300 + i); })) << "stranded mail goes to the successor: " << i;
  EXPECT_TRUE(wait_for([&] { return w.traced.list() == std::vector{outcome::fenced}; }));
  EXPECT_TRUE(w.actors.stop()) << "nobody hangs any more";
  EXPECT_FALSE(w.heard(666)) << "told before it was replaced, held back until the handler returns";
  EXPECT_FALSE(w.heard(667)) << "told by an incarnation that had been replaced";
  const auto counters = w.sleeper_counters();
  EXPECT_EQ(counters.accepted, 7U);
  EXPECT_EQ(counters.handled, 6U);
  EXPECT_EQ(counters.lost, 1U) << "the message that hung is counted";
}

TEST(hang, an_incarnation_that_wakes_up_does_not_take_the_requests_of_its_successor_away) {
  real_world w(false);
  w.fall_asleep();
  w.wait_for_successor();
  w.gate->tell(w.front, get_later{});
  EXPECT_TRUE(wait_for([&] { return w.sleeper_counters().handled == 1; })) << "the successor has the request";
  w.book.open_latch.set_value();
  EXPECT_TRUE(wait_for([&] { return w.traced.list() == std::vector{outcome::fenced}; }));
  w.gate->tell(w.bed, note{1}); // after the end of the old one in time, not in order
  EXPECT_TRUE(wait_for([&] { return w.heard(301); }));
  EXPECT_FALSE(wait_for([&] { return w.heard(-1); }, 200ms)) << "outcome unknown, though the successor lives";
  w.gate->tell(w.bed, hand_out{});
  EXPECT_TRUE(wait_for([&] { return w.heard(42); }));
  EXPECT_TRUE(w.actors.stop());
}

TEST(hang, an_essential_actor_that_hangs_asks_for_the_exit) {
  real_world w(true);
  w.fall_asleep();
  const auto why = w.actors.wait_for_exit_request();
  EXPECT_EQ(why.cause, exit_cause::essential_silent);
  EXPECT_EQ(why.reason, "sleeper is essential and did not answer a ping for 1000 ms");
  w.book.open_latch.set_value(); // else this process could only leave by _Exit
  EXPECT_TRUE(wait_for([&] { return w.book.inside == 0; }));
  EXPECT_TRUE(wait_for([&] { return w.traced.list().size() == 1; }));
  EXPECT_TRUE(w.actors.stop());
}

TEST(hang, handlers_that_hang_on_all_workers_ask_for_the_exit) {
  real_world w(false, 1);
  w.fall_asleep();
  const auto why = w.actors.wait_for_exit_request();
  EXPECT_EQ(why.cause, exit_cause::no_free_worker);
  EXPECT_EQ(why.reason, "all 1 workers hang in handlers that do not return");
  w.book.open_latch.set_value();
  EXPECT_TRUE(wait_for([&] { return w.book.inside == 0; }));
  EXPECT_TRUE(w.actors.stop());
}

// -- a whole process
// ---------------------------------------------------------------------------------------------------

struct ended {
  int status = -1; // exit status
  std::string output;
};

ended run_victim(const std::string& mode, const std::filesystem::path& folder) {
  const auto command = std::string(GODWIT_HANG_VICTIM) + ' ' + mode + " '" + folder.string() + "' 2>&1";
  ended result;
  FILE* output = ::popen(command.c_str(), "r");
  if (output == nullptr)
    return result;
  std::array<char, 4096> buffer;
  while (const auto size = std::fread(buffer.data(), 1, buffer.size(), output))
    result.output.append(buffer.data(), size);
  const int status = ::pclose(output);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

void expect_durable_event(const std::filesystem::path& folder) {
  auto reader = journal_reader::open((folder / "journal.db").string());
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_TRUE(reader->check());
  const auto events = reader->events("ledger");
  ASSERT_TRUE(events);
  ASSERT_EQ(events->size(), 1U);
  EXPECT_EQ(events->front().body, R"({"key":1,"amount":10})");
}

// Every segment is complete; the number of messages in all of them.
std::size_t messages_in_complete_segments(const std::filesystem::path& folder) {
  std::size_t messages = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    io::mcap::file_source source;
    EXPECT_TRUE(source.open(file.path()));
    EXPECT_TRUE(io::mcap::has_end(source).value_or(false)) << file.path();
    io::mcap::strict_mcap_reader reader(source);
    for (;;) {
      const auto item = reader.next();
      if (!item || std::holds_alternative<io::mcap::truncated>(*item)) {
        ADD_FAILURE() << file.path() << " ends too early";
        return messages;
      }
      if (std::holds_alternative<io::mcap::end_of_file>(*item))
        break;
      messages += std::holds_alternative<io::mcap::message_record>(*item) ? 1 : 0;
    }
  }
  return messages;
}

struct victim_case {
  const char* mode;
  exit_code status;
  const char* reason;
};

class a_process : public testing::TestWithParam<victim_case> {};

TEST_P(a_process, leaves_in_order_with_its_reason_and_its_memory_whole) {
  const auto& expected = GetParam();
  const tests::scratch_folder scratch;
  const auto result = run_victim(expected.mode, scratch.path(""));
  EXPECT_EQ(result.status, static_cast<int>(expected.status)) << result.output;
  EXPECT_NE(result.output.find("acknowledged"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find(expected.reason), std::string::npos) << result.output;
  expect_durable_event(scratch.path(""));
  EXPECT_GT(messages_in_complete_segments(scratch.path("trace")), 3U);
}

INSTANTIATE_TEST_SUITE_P(
    hang, a_process,
    testing::Values(victim_case{"essential_hangs", exit_code::unresponsive,
                                "essential_silent: sleeper is essential and did not answer"},
                    victim_case{"all_hang", exit_code::unresponsive, "no_free_worker: all 2 workers hang"},
                    victim_case{"essential_given_up", exit_code::essential_given_up,
                                "essential_given_up: sleeper is essential and was given up: told to fail"},
                    victim_case{"stood_still", exit_code::ok, "requested: the test wants it"},
                    victim_case{"requested", exit_code::ok, "requested: the test wants it"}),
    [](const auto& each) { return std::string(each.param.mode); });

} // namespace hang_test
