#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <chrono>
#include <filesystem>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/repair.hpp"
#include "runtime/define_message.hpp"
#include "runtime/trace/ring_trace.hpp"
#include "runtime/trace/trace_renderer.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"
#include "tests/support/strict_mcap_reader.hpp"

namespace ring_trace_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace std::chrono_literals;
using nlohmann::json;
using tests::scratch_folder;

struct login {
  std::string user;
  std::string token;
  int attempt = 0;
  static constexpr auto fields = io::table("test.login", io::field("user", &login::user),
                                           io::secret("token", &login::token), io::field("attempt", &login::attempt));
};
struct blob {
  std::string bytes;
  static constexpr auto fields = io::table("test.blob", io::field("bytes", &blob::bytes));
};

// Everything that the segments of a folder hold.
struct trace_contents {
  struct message {
    std::string topic;
    std::uint64_t log_time_ns = 0;
    json body;
  };
  std::vector<message> messages;
  std::map<std::string, json> schemas; // by name
  std::map<std::string, std::string> schema_of_topic;
  std::map<std::string, std::string> run_info;
  std::size_t segments = 0;
  std::uintmax_t bytes = 0;
  std::uintmax_t longest = 0;

  [[nodiscard]] std::vector<json> of(const std::string& topic) const {
    std::vector<json> result;
    for (const auto& each : messages)
      if (each.topic == topic)
        result.push_back(each.body);
    return result;
  }
};

std::string text_of(io::mcap::byte_view bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

void read_segment(const std::filesystem::path& path, trace_contents& into) {
  io::mcap::file_source source;
  ASSERT_TRUE(source.open(path));
  EXPECT_TRUE(io::mcap::has_end(source).value_or(false)) << path << " has no summary";
  io::mcap::strict_mcap_reader reader(source);
  std::map<io::mcap::schema_id, std::string> names;
  std::map<io::mcap::channel_id, std::string> topics;
  for (;;) {
    const auto item = reader.next();
    ASSERT_TRUE(item) << item.error().message();
    if (const auto* schema = std::get_if<io::mcap::schema_record>(&*item)) {
      EXPECT_EQ(schema->encoding, "jsonschema");
      names[schema->id] = schema->name;
      into.schemas[std::string(schema->name)] = json::parse(text_of(schema->data));
    } else if (const auto* channel = std::get_if<io::mcap::channel_record>(&*item)) {
      EXPECT_EQ(channel->message_encoding, "json");
      topics[channel->id] = channel->topic;
      into.schema_of_topic[std::string(channel->topic)] = names[channel->schema];
    } else if (const auto* message = std::get_if<io::mcap::message_record>(&*item)) {
      into.messages.push_back({topics[message->channel], message->log_time_ns, json::parse(text_of(message->data))});
    } else if (const auto* metadata = std::get_if<io::mcap::metadata_record>(&*item)) {
      into.run_info.insert(metadata->values.begin(), metadata->values.end());
    } else {
      ASSERT_FALSE(std::holds_alternative<io::mcap::truncated>(*item)) << path;
      if (std::holds_alternative<io::mcap::end_of_file>(*item))
        return;
    }
  }
}

// Of a segment that is being written.
bool has_message(const std::filesystem::path& path) {
  io::mcap::file_source source;
  if (!source.open(path))
    return false;
  io::mcap::strict_mcap_reader reader(source);
  for (;;) {
    const auto item = reader.next();
    if (!item || std::holds_alternative<io::mcap::truncated>(*item))
      return false;
    if (std::holds_alternative<io::mcap::message_record>(*item))
      return true;
  }
}

std::set<std::filesystem::path> segments_in(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> result;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    result.insert(file.path());
  return result;
}

trace_contents read_folder(const std::filesystem::path& folder) {
  trace_contents result;
  for (const auto& path : segments_in(folder)) {
    read_segment(path, result);
    ++result.segments;
    const auto size = std::filesystem::file_size(path);
    result.bytes += size;
    result.longest = std::max(result.longest, size);
  }
  return result;
}

struct recorder {
  static constexpr std::uint64_t slow_id = 1'000'000; // this delivery takes 2 ms

  explicit recorder(std::filesystem::path folder, std::uint64_t segment_bytes = std::uint64_t{8} << 20U,
                    std::uint64_t total_bytes = std::uint64_t{256} << 20U, milliseconds flush = 10ms) {
    alice = names.add("alice");
    bob = names.add("bob");
    trace_options options;
    options.folder = std::move(folder);
    options.segment_bytes = segment_bytes;
    options.total_bytes = total_bytes;
    options.flush = flush;
    options.run = 7;
    options.program = "ring_trace_test";
    options.about["settings"] = "{}";
    auto opened = ring_trace::open(std::move(options), names, time, health);
    if (opened)
      trace = std::move(*opened);
    else
      refusal = opened.error();
  }
  template <class T>
  void record(const T& body, std::uint32_t actor, std::uint64_t id = 1, outcome how = outcome::handled) {
    trace_entry entry;
    entry.began = trace->ticks();
    if (id == slow_id)
      std::this_thread::sleep_for(2ms);
    entry.ended = trace->ticks();
    entry.id = id;
    entry.cause = 17;
    entry.actor = actor;
    entry.sender = bob;
    entry.incarnation = 3;
    entry.how = how;
    trace->record(entry, type_of<T>(), &body);
  }
  [[nodiscard]] health_entry trace_health() const {
    for (const auto& each : health.entries())
      if (each.component == "trace")
        return each;
    return {};
  }

  directory names;
  system_time time;
  health_board health;
  std::uint32_t alice = 0;
  std::uint32_t bob = 0;
  std::string refusal;
  std::unique_ptr<ring_trace> trace;
};

bool wait_for(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(1ms);
  return condition();
}

TEST(ring_trace, a_record_comes_out_with_all_that_was_known_of_the_delivery) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  const auto before_ns = static_cast<std::uint64_t>(r.time.wall_ns());
  r.record(login{"ann \"quoted\"", "secret", 2}, r.alice, recorder::slow_id, outcome::crashed);
  r.trace->close();
  const auto found = read_folder(scratch.path("trace"));
  ASSERT_EQ(found.messages.size(), 1U);
  auto message = found.messages.front();
  EXPECT_EQ(message.topic, "/alice/test.login");
  EXPECT_NEAR(static_cast<double>(message.log_time_ns), static_cast<double>(before_ns), 60e9) << "wall time";
  const auto duration_ns = message.body.at("duration_ns").get<std::int64_t>();
  EXPECT_GE(duration_ns, 1'900'000); // the clocks may differ a little
  EXPECT_LT(duration_ns, 20'000'000'000);
  message.body.erase("duration_ns");
  EXPECT_EQ(message.body, (json{{"id", recorder::slow_id},
                                {"cause", 17},
                                {"actor", "alice"},
                                {"incarnation", 3},
                                {"sender", "bob"},
                                {"outcome", "crashed"},
                                {"message", {{"user", "ann \"quoted\""}, {"attempt", 2}}}}));
  auto run_info = found.run_info;
  EXPECT_EQ(run_info.erase("monotonic_to_utc_ns"), 1U);
  EXPECT_EQ(run_info,
            (std::map<std::string, std::string>{{"program", "ring_trace_test"}, {"run", "7"}, {"settings", "{}"}}));
  EXPECT_EQ(r.trace->counts().recorded, 1U);
  EXPECT_EQ(r.trace->counts().written, 1U);
}

TEST(ring_trace, each_actor_and_message_type_has_a_channel_each_type_a_schema) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  for (int i = 0; i < 3; ++i) {
    r.record(login{}, r.alice);
    r.record(login{}, r.bob);
    r.record(blob{}, r.bob);
  }
  r.trace->close();
  const auto found = read_folder(scratch.path("trace"));
  EXPECT_EQ(found.schema_of_topic, (std::map<std::string, std::string>{{"/alice/test.login", "test.login"},
                                                                       {"/bob/test.login", "test.login"},
                                                                       {"/bob/test.blob", "test.blob"}}));
  EXPECT_EQ(found.of("/bob/test.login").size(), 3U);
  const auto& schema = found.schemas.at("test.login");
  EXPECT_EQ(schema.at("title"), "test.login");
  for (const auto& key : schema.at("required"))
    EXPECT_TRUE(found.messages.front().body.contains(key)) << key;
  EXPECT_TRUE(schema.at("properties").at("message").at("properties").contains("user"));
}

TEST(ring_trace, a_secret_is_in_no_part_of_the_files) {
  const scratch_folder scratch;
  const std::string secret = "correct-horse-battery-staple";
  recorder r(scratch.path("trace"));
  for (int i = 0; i < 100; ++i)
    r.record(login{"ann", secret, i}, r.alice);
  r.trace->close();
  const auto found = read_folder(scratch.path("trace")); // the files are compressed
  ASSERT_EQ(found.messages.size(), 100U);
  std::string all = found.schemas.at("test.login").dump();
  for (const auto& each : found.messages)
    all += each.body.dump();
  EXPECT_NE(all.find("ann"), std::string::npos);
  EXPECT_EQ(all.find(secret), std::string::npos);
  EXPECT_EQ(all.find("token"), std::string::npos) << "not even its name";
}

TEST(ring_trace, what_a_full_ring_can_not_take_is_counted_and_written_down) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  const blob large{std::string(ring_trace::max_payload / 2, 'x')};
  std::uint64_t sent = 0;
  // The writer has to render what one copy stored, so it falls behind within some rings.
  for (; r.trace->counts().dropped == 0 && sent < 1'000'000; ++sent)
    r.record(large, r.alice, sent);
  ASSERT_GT(r.trace->counts().dropped, 0U);
  EXPECT_TRUE(wait_for([&] { return r.trace->counts().written >= r.trace->counts().recorded; }));
  r.trace->close();
  const auto counts = r.trace->counts();
  EXPECT_EQ(counts.recorded + counts.dropped, sent);
  const auto losses = read_folder(scratch.path("trace")).of("/outside/runtime.trace_loss");
  ASSERT_FALSE(losses.empty());
  EXPECT_EQ(losses.back().at("message"), (json{{"dropped", counts.dropped}, {"unwritten", 0}}));
}

TEST(ring_trace, a_message_that_is_too_long_is_recorded_without_its_content) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  r.record(blob{std::string(ring_trace::max_payload - sizeof(std::uint32_t), 'x')}, r.alice, 1);
  r.record(blob{std::string(ring_trace::max_payload - sizeof(std::uint32_t) + 1, 'x')}, r.alice, 2);
  r.trace->close();
  const auto found = read_folder(scratch.path("trace")).of("/alice/test.blob");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].contains("message"));
  EXPECT_FALSE(found[0].contains("oversize"));
  EXPECT_FALSE(found[1].contains("message"));
  EXPECT_EQ(found[1].at("oversize"), true);
  EXPECT_EQ(found[1].at("id"), 2);
  EXPECT_EQ(r.trace->counts().oversize, 1U);
  EXPECT_EQ(r.trace->counts().dropped, 0U);
}

TEST(ring_trace, threads_beyond_the_bound_are_counted) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  constexpr std::size_t threads = ring_trace::max_threads + 3;
  std::barrier all_alive(static_cast<std::ptrdiff_t>(threads)); // the id of a thread that ended may come again
  std::vector<std::thread> running;
  for (std::size_t i = 0; i < threads; ++i)
    running.emplace_back([&] {
      r.record(login{}, r.alice);
      all_alive.arrive_and_wait();
    });
  for (auto& each : running)
    each.join();
  r.trace->close();
  EXPECT_EQ(r.trace->counts().recorded, ring_trace::max_threads);
  EXPECT_EQ(r.trace->counts().dropped, 3U);
  EXPECT_EQ(read_folder(scratch.path("trace")).of("/alice/test.login").size(), ring_trace::max_threads);
}

TEST(ring_trace, records_of_many_threads_all_arrive_each_thread_in_its_order) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  constexpr std::uint64_t each_sends = 2'000; // fits into a ring: nothing is dropped
  std::vector<std::thread> running;
  for (std::uint64_t t = 0; t < 4; ++t)
    running.emplace_back([&r, t] {
      for (std::uint64_t i = 0; i < each_sends; ++i)
        r.record(login{std::to_string(t), {}, static_cast<int>(i)}, r.alice, t * each_sends + i);
    });
  for (auto& each : running)
    each.join();
  r.trace->close();
  std::map<std::string, int> next;
  for (const auto& each : read_folder(scratch.path("trace")).of("/alice/test.login")) {
    const auto& message = each.at("message");
    EXPECT_EQ(message.at("attempt"), next[message.at("user").get<std::string>()]++);
  }
  EXPECT_EQ(r.trace->counts().dropped, 0U);
  EXPECT_EQ(next, (std::map<std::string, int>{{"0", 2'000}, {"1", 2'000}, {"2", 2'000}, {"3", 2'000}}));
}

TEST(ring_trace, the_oldest_segments_go_so_that_the_total_size_is_held) {
  const scratch_folder scratch;
  constexpr std::uint64_t segment_bytes = 64 << 10U;
  constexpr std::uint64_t total_bytes = 256 << 10U;
  recorder r(scratch.path("trace"), segment_bytes, total_bytes);
  for (std::uint64_t i = 0; i < 4'000; ++i) {
    r.record(blob{std::string(500, 'x')}, r.alice, i);
    if (i % 500 == 499) { // so that no ring is full
      ASSERT_TRUE(wait_for([&] { return r.trace->counts().written == i + 1; }));
    }
  }
  r.trace->close();
  const auto found = read_folder(scratch.path("trace"));
  EXPECT_LE(found.bytes, total_bytes);
  EXPECT_GT(found.bytes, total_bytes / 2);
  EXPECT_LE(found.longest, segment_bytes);
  EXPECT_GE(found.segments, 3U);
  EXPECT_EQ(found.messages.back().body.at("id"), 3'999) << "the newest are kept";
  EXPECT_EQ(segments_in(scratch.path("trace")).begin()->filename().string().find("godwit-0000000007-"), 0U);
}

TEST(ring_trace, what_was_recorded_is_in_the_file_after_the_flush_interval) {
  const scratch_folder scratch;
  recorder r(scratch.path("trace"));
  r.record(login{"ann", {}, 1}, r.alice);
  EXPECT_TRUE(wait_for([&] {
    const auto segments = segments_in(scratch.path("trace"));
    return std::ranges::any_of(segments, [](const auto& path) { return has_message(path); });
  })) << "without close()";
}

TEST(ring_trace, a_segment_of_a_killed_run_is_completed_at_the_next_start) {
  const scratch_folder scratch;
  const std::filesystem::path folder = scratch.path("trace");
  {
    recorder r(folder);
    for (std::uint64_t i = 0; i < 10; ++i) {
      r.record(login{"ann", {}, 1}, r.alice, i);
      ASSERT_TRUE(wait_for([&] { return r.trace->counts().written == i + 1; })); // a chunk each, more or less
      std::this_thread::sleep_for(15ms);
    }
    r.trace->close();
  }
  const auto segment = *segments_in(folder).begin();
  std::filesystem::resize_file(segment, std::filesystem::file_size(segment) * 2 / 3);
  io::mcap::file_source source;
  ASSERT_TRUE(source.open(segment));
  ASSERT_FALSE(io::mcap::has_end(source).value_or(true));
  {
    recorder next(folder);
    EXPECT_EQ(next.refusal, "");
    EXPECT_EQ(next.trace_health().colour, health_colour::green);
    next.record(login{"bea", {}, 1}, next.alice);
    next.trace->close();
  }
  const auto found = read_folder(folder); // checks that each has its summary
  EXPECT_EQ(found.segments, 2U);
  EXPECT_EQ(found.messages.back().body.at("message").at("user"), "bea");
}

TEST(ring_trace, a_damaged_segment_of_an_earlier_run_is_left_as_it_is_and_told) {
  const scratch_folder scratch;
  const std::filesystem::path folder = scratch.path("trace");
  std::filesystem::create_directories(folder);
  const auto damaged = folder / "godwit-0000000001-000001.mcap";
  std::ofstream(damaged) << "this is no MCAP file at all, not even its beginning";
  recorder r(folder);
  EXPECT_EQ(r.refusal, "");
  EXPECT_EQ(r.trace_health().colour, health_colour::yellow);
  EXPECT_NE(r.trace_health().reason.find(damaged.string()), std::string::npos) << r.trace_health().reason;
  EXPECT_EQ(std::filesystem::file_size(damaged), 51U);
}

TEST(ring_trace, a_folder_that_can_not_be_made_is_refused_with_a_sentence_that_names_it) {
  const scratch_folder scratch;
  std::ofstream(scratch.path("file")) << "not a folder";
  const auto folder = scratch.path("file/trace");
  const recorder r(folder);
  EXPECT_FALSE(r.trace);
  EXPECT_EQ(r.refusal.find("the trace can not be written: "), 0U) << r.refusal;
  EXPECT_NE(r.refusal.find(folder), std::string::npos) << r.refusal;
}

TEST(ring_trace, a_folder_that_goes_away_costs_records_and_health_until_it_is_back) {
  const scratch_folder scratch;
  const std::filesystem::path folder = scratch.path("trace");
  recorder r(folder);
  std::filesystem::remove_all(folder);
  std::ofstream(folder) << "in the way of a new folder";
  for (std::uint64_t i = 0; i < 10; ++i)
    r.record(login{}, r.alice, i);
  EXPECT_TRUE(wait_for([&] { return r.trace->counts().unwritten >= 10; }));
  EXPECT_TRUE(wait_for([&] { return r.trace_health().colour == health_colour::yellow; }));
  EXPECT_NE(r.trace_health().reason.find(folder.string()), std::string::npos) << r.trace_health().reason;
  std::filesystem::remove(folder);
  std::filesystem::create_directories(folder);
  EXPECT_TRUE(wait_for([&] { // tried again once a second
    r.record(login{"back", {}, 0}, r.alice);
    return r.trace->counts().written > 0;
  }));
  EXPECT_TRUE(wait_for([&] { return r.trace_health().colour == health_colour::green; }));
  r.trace->close();
  const auto found = read_folder(folder);
  EXPECT_FALSE(found.of("/alice/test.login").empty());
  const auto losses = found.of("/outside/runtime.trace_loss");
  ASSERT_FALSE(losses.empty()) << "what was lost is written down when it can be";
  EXPECT_GE(losses.back().at("message").at("unwritten"), 10);
}

TEST(ring_trace, a_folder_that_is_removed_while_it_is_written_is_shown_and_made_again) {
  const scratch_folder scratch;
  const std::filesystem::path folder = scratch.path("trace");
  recorder r(folder);
  r.record(login{"before", {}, 0}, r.alice);
  ASSERT_TRUE(wait_for([&] { return r.trace->counts().written > 0; }));
  const auto since = std::chrono::steady_clock::now();
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(wait_for([&] { return r.trace_health().colour == health_colour::yellow; }));
  EXPECT_LT(std::chrono::steady_clock::now() - since, 5s);
  EXPECT_TRUE(wait_for([&] {
    r.record(login{"after", {}, 0}, r.alice);
    return std::filesystem::exists(folder) && !std::filesystem::is_empty(folder);
  }));
  EXPECT_TRUE(wait_for([&] { return r.trace_health().reason.find("was removed") != std::string::npos; }));
  EXPECT_EQ(r.trace_health().colour, health_colour::yellow) << "a person has to see it";
  r.trace->close();
  const auto found = read_folder(folder).of("/alice/test.login");
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.back().at("message").at("user"), "after");
}

// In a user namespace of its own a process may mount; it stays the same user there.
bool become_able_to_mount() {
  const auto user = std::to_string(::getuid());
  const auto group = std::to_string(::getgid());
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0)
    return false;
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << user + ' ' + user + " 1";
  std::ofstream("/proc/self/gid_map") << group + ' ' + group + " 1";
  return true;
}

// Runs in a child with a file system of its own, of 256 KiB. Returns what is wrong; 0 = nothing, 77 = it is not
// allowed.
int fill_a_tiny_disk(const std::filesystem::path& mount_point) {
  if (!become_able_to_mount() || ::mount("none", mount_point.c_str(), "tmpfs", 0, "size=256k") != 0)
    return 77;
  recorder r(mount_point / "trace");
  if (!r.trace)
    return 1;
  std::minstd_rand letters; // what repeats itself would be compressed to nothing
  for (std::uint64_t i = 0; i < 60; ++i) {
    blob large{std::string(10'000, ' ')};
    std::ranges::generate(large.bytes, [&] { return static_cast<char>('!' + letters() % 90); });
    r.record(large, r.alice, i);
  }
  if (!wait_for([&] { return r.trace->counts().unwritten > 0; }))
    return 2;
  if (!wait_for([&] { return r.trace_health().colour == health_colour::yellow; }))
    return 3;
  if (r.trace_health().reason.find("disk full") == std::string::npos)
    return 4;
  r.trace->close();
  const auto counts = r.trace->counts();
  return counts.written + counts.unwritten >= 60 && counts.dropped == 0 ? 0 : 5;
}

TEST(ring_trace, a_full_disk_turns_health_yellow_and_what_is_not_written_is_counted) {
  const scratch_folder scratch;
  std::filesystem::create_directories(scratch.path("disk"));
  const auto child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    ::_exit(fill_a_tiny_disk(scratch.path("disk")));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77)
    GTEST_SKIP() << "this machine does not let a test mount a file system of its own";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

} // namespace ring_trace_test
