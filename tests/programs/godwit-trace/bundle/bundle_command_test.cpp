#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/mavlink/tlog/tlog_writer.hpp"
#include "programs/common/printable.hpp"
#include "programs/godwit-trace/bundle/bundle_plan.hpp"
#include "programs/godwit-trace/bundle/secret_guard.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "runtime/journal/journal_file.hpp"
#include "tests/programs/godwit-trace/actors/command_fixture.hpp"
#include "tests/programs/godwit-trace/actors/small_flight.hpp"

namespace godwit::trace_tool::test {
namespace bundle_command_test {

namespace fs = std::filesystem;

const std::string token = "tok-3f9c1d77a0";
const std::string key = "00112233445566778899aabbccddeeff00112233445566778899AABBCCDDEEFF";

std::string text_of(const fs::path& file) {
  std::ifstream from(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(from), {}};
}

// A folder as godwitd leaves it: configuration, secrets, journal, trace of two runs, the links, a log.
class bundle : public testing::Test {
protected:
  bundle() {
    tests::write_small_flight(at("trace"));
    write("token", token + "\n");
    write("link.key", key + "\n");
    write("godwitd.log", "all is well\n");
    write("godwit.json", R"({"journal": {"path": ")" + at("godwit.db") + R"("}, "trace": {"directory": ")" +
                             at("trace") + R"("}, "vehicle": {"key_file": ")" + at("link.key") +
                             R"("}, "service": {"url": "https://ann:pw-8831@example.org", "token_file": ")" +
                             at("token") + R"("}} // )" + token);
    runtime::file_options journal;
    journal.path = at("godwit.db");
    EXPECT_TRUE(runtime::open_for_writing(journal));
    io::mavlink::tlog_writer links;
    EXPECT_TRUE(links.open({at("trace/vehicle-0000000002-000001.tlog")}));
    EXPECT_TRUE(links.write(some_day_us, frame_of(io::mavlink::heartbeat{}).view()));
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(at(name)) << text; }

  [[nodiscard]] command_result run(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"--config", at("godwit.json"), "-o", at("out.tar"), "--log", at("godwitd.log")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_command(add_bundle_command, arguments);
  }
  // As tar(1) reads it; the folder into which it was unpacked.
  [[nodiscard]] fs::path unpacked() const {
    const auto command = "cd " + folder_.path().string() + " && tar xf out.tar";
    EXPECT_EQ(std::system(command.c_str()), 0); // NOLINT(cert-env33-c,concurrency-mt-unsafe)
    return folder_.path() / "godwit-bundle";
  }

  tests::trace_folder folder_;
};

TEST_F(bundle, everything_of_the_flight_is_in_one_archive_with_a_list) {
  const auto done = run();
  ASSERT_EQ(done.code, exit_code::ok) << done.words;
  const auto there = unpacked();
  const auto list = text_of(there / "CONTENTS.txt");
  for (const auto* each :
       {"configuration.json", "logs/1-godwitd.log", "journal.db", "trace/godwit-0000000001-000001.mcap",
        "trace/godwit-0000000002-000001.mcap", "trace/vehicle-0000000002-000001.tlog"}) {
    EXPECT_TRUE(fs::exists(there / each)) << each;
    EXPECT_NE(list.find(each), std::string::npos) << each << " in\n" << list;
  }
  EXPECT_NE(list.find("status.json: no godwitd answers"), std::string::npos) << list;
  EXPECT_EQ(text_of(there / "trace/godwit-0000000002-000001.mcap"), text_of(at("trace/godwit-0000000002-000001.mcap")));
  EXPECT_TRUE(runtime::open_for_reading((there / "journal.db").string(), {}));
  EXPECT_FALSE(fs::exists(at("out.tar.journal")));
  EXPECT_EQ(fs::status(at("out.tar")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(bundle, no_planted_token_key_or_password_is_in_it) {
  write("godwitd.log", "all is well\nAuthorization: Bearer " + token + "\n");
  write("other.log", std::string((1U << 20U) - 10U, 'x') + key.substr(0, 32) + "00112233445566778899aabbccddeeff");
  ASSERT_EQ(run({"--log", at("other.log")}).code, exit_code::ok);
  const auto all = text_of(at("out.tar"));
  EXPECT_EQ(all.find(token), std::string::npos);
  EXPECT_EQ(all.find("pw-8831"), std::string::npos);
  EXPECT_EQ(all.find(key.substr(0, 32)), std::string::npos);
  const auto list = text_of(unpacked() / "CONTENTS.txt");
  EXPECT_NE(list.find("logs/1-godwitd.log: the secret of " + at("token")), std::string::npos) << list;
  EXPECT_NE(list.find("logs/2-other.log: the secret of " + at("link.key")), std::string::npos) << list;
}

TEST_F(bundle, what_is_missing_is_said_and_an_archive_that_is_there_is_not_written_over) {
  fs::remove_all(at("trace"));
  fs::remove(at("godwit.db"));
  const auto done = run();
  EXPECT_EQ(done.code, exit_code::ok);
  EXPECT_NE(done.words.find("not in it: trace"), std::string::npos) << done.words;
  EXPECT_NE(done.words.find("not in it: journal.db"), std::string::npos) << done.words;
  EXPECT_EQ(run().code, exit_code::failed);
}

TEST_F(bundle, a_time_at_which_nothing_was_recorded_is_said) {
  EXPECT_NE(run({"--at", "2020-01-01T00:00:00Z"}).words.find("no run of godwitd"), std::string::npos);
  EXPECT_EQ(run({"--at", "yesterday"}).code, exit_code::usage);
}

TEST(flight_choice, runs_with_short_breaks_are_one_flight) {
  constexpr std::int64_t s = 1'000'000'000;
  const std::vector<run_times> runs{{1, 0, 100 * s}, {2, 1'000 * s, 1'100 * s}, {3, 1'101 * s, 1'200 * s}};
  EXPECT_EQ(runs_of_flight(runs, std::nullopt), (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(runs_of_flight(runs, 50 * s), (std::vector<std::uint64_t>{1}));
  EXPECT_EQ(runs_of_flight(runs, 1'150 * s), (std::vector<std::uint64_t>{2, 3}));
  EXPECT_TRUE(runs_of_flight(runs, 500 * s).empty());
}

TEST(redaction, users_passwords_and_questions_of_addresses_and_values_of_secret_names_go) {
  using programs::address_without_secrets;
  EXPECT_EQ(address_without_secrets("https://ann:p@w@host:1/x@y?token=1"), "https://(left out)@host:1/x@y?(left out)");
  EXPECT_EQ(address_without_secrets("udpin://0.0.0.0:14550"), "udpin://0.0.0.0:14550");
  const std::string given =
      R"({"a":[{"api_token":"t","key_file":"/k","signing_key":[1],"url":"http://u@h"}],"key":1,"ask_author":true})";
  const auto seen = programs::without_secrets(nlohmann::json::parse(given));
  const auto& inside = seen.at("a").at(0);
  EXPECT_EQ(inside.at("api_token"), "(left out)");
  EXPECT_EQ(inside.at("signing_key"), "(left out)");
  EXPECT_EQ(inside.at("key_file"), "/k");
  EXPECT_EQ(inside.at("url"), "http://(left out)@h");
  EXPECT_EQ(seen.at("key"), "(left out)");
  EXPECT_EQ(seen.at("ask_author"), true);
}

TEST(secret_guard, a_key_is_known_as_bytes_and_as_digits_of_either_case) {
  const tests::trace_folder folder;
  const auto file = folder.path() / "key";
  std::ofstream(file) << key;
  secret_guard guard;
  ASSERT_TRUE(guard.add_file(file));
  EXPECT_FALSE(guard.add_file(folder.path() / "none"));
  const std::string bytes("\x00\x11\x22\x33\x44\x55\x66\x77\x88\x99\xaa\xbb\xcc\xdd\xee\xff", 16);
  EXPECT_EQ(guard.found_in("x" + bytes + bytes), file.string());
  EXPECT_EQ(guard.found_in("00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff"), file.string());
  EXPECT_EQ(guard.found_in("nothing of it"), "");
}

} // namespace bundle_command_test
} // namespace godwit::trace_tool::test
