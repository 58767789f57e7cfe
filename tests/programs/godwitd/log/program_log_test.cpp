#include <array>
#include <filesystem>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/details/log_msg.h>
#include <sys/stat.h>
#include <unistd.h>

#include "programs/godwitd/log/program_log.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace program_log_test {

using namespace godwit;
using namespace godwit::daemon;
using godwit::test::scratch;

struct daemon_log : testing::Test {
  scratch folder;
  std::string file = folder.file("godwitd.log");

  std::unique_ptr<program_log> open(log_format format, log_level level = log_level::info) {
    return program_log::open({file, format, level}, STDOUT_FILENO).value();
  }
};

TEST_F(daemon_log, a_file_gets_stamped_lines_that_are_appended) {
  for (int run = 0; run < 2; ++run)
    open(log_format::text)->say(log_level::info, "ground_run", "map pulled");
  const auto text = scratch::read(file);
  const std::regex two_lines(R"((\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z info ground_run: map pulled\n){2})");
  EXPECT_TRUE(std::regex_match(text, two_lines)) << text;
  struct stat info {};
  ASSERT_EQ(::stat(file.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0137U, 0U) << "others read or write it";
}

TEST_F(daemon_log, a_symbolic_link_is_not_followed) {
  const auto victim = folder.file("victim");
  std::filesystem::create_symlink(victim, file);
  const auto opened = program_log::open({file, log_format::text, log_level::info}, STDOUT_FILENO);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().find("is a symbolic link"), std::string::npos) << opened.error();
  EXPECT_FALSE(std::filesystem::exists(victim));
}

TEST_F(daemon_log, what_is_better_than_the_level_is_left_out) {
  auto log = open(log_format::text, log_level::warning);
  log->say(log_level::info, "a", "chatter");
  log->say(log_level::warning, "a", "trouble");
  log->say(log_level::error, "a", "disaster");
  log.reset();
  const auto text = scratch::read(file);
  EXPECT_EQ(text.find("chatter"), std::string::npos);
  EXPECT_LT(text.find("trouble"), text.find("disaster"));
}

TEST_F(daemon_log, a_file_that_was_moved_away_is_followed_by_a_new_one_and_nothing_is_lost) {
  auto log = open(log_format::json);
  const int lines = 1'000; // less than the printer's queue
  for (int n = 0; n < lines; ++n) {
    log->say(log_level::info, "a", std::string(n == 500 ? 100'000 : 10, 'x'));
    if (n == 501) {
      ASSERT_EQ(std::rename(file.c_str(), (file + ".1").c_str()), 0);
      ASSERT_TRUE(log->reopen());
    }
  }
  log.reset();
  int seen = 0;
  for (const auto& each : {file + ".1", file}) {
    std::istringstream text(scratch::read(each));
    for (std::string line; std::getline(text, line); ++seen)
      EXPECT_TRUE(nlohmann::json::accept(line)) << each;
  }
  EXPECT_EQ(seen, lines);
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(daemon_log, a_file_that_can_not_be_opened_anew_leaves_the_old_one) {
  const auto inner = folder.file("inner");
  std::filesystem::create_directory(inner);
  file = inner + "/godwitd.log";
  auto log = open(log_format::text);
  std::filesystem::rename(inner, folder.file("moved"));
  const auto refused = log->reopen();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find(file), std::string::npos) << refused.error();
  log->say(log_level::info, "a", "still here");
  log.reset();
  EXPECT_NE(scratch::read(folder.file("moved/godwitd.log")).find("still here"), std::string::npos);
}

TEST_F(daemon_log, a_folder_that_is_not_there_is_a_sentence) {
  const auto refused = program_log::open({folder.file("no/log"), log_format::text, log_level::info}, STDOUT_FILENO);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find("No such file"), std::string::npos) << refused.error();
}

TEST_F(daemon_log, nobody_waits_for_a_slow_reader_and_the_losses_are_json_too) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const io::link::descriptor reader(ends[0]);
  io::link::descriptor writer(ends[1]);
  auto log = program_log::open({"", log_format::json, log_level::info}, writer.number()).value();
  for (std::size_t n = 0; n < 2 * programs::line_printer::max_waiting; ++n)
    log->say(log_level::info, "a", "a line of some length, so that the pipe is full soon");
  ASSERT_GT(log->dropped(), 0U);
  std::string text;
  std::array<char, 65'536> buffer{};
  for (std::uint64_t told = 0; told == 0;) {
    const auto size = ::read(reader.number(), buffer.data(), buffer.size());
    ASSERT_GT(size, 0);
    text.append(buffer.data(), static_cast<std::size_t>(size));
    log->say(log_level::info, "a", "more");
    while (text.find('\n') != std::string::npos) {
      const auto line = nlohmann::json::parse(text.substr(0, text.find('\n')));
      text.erase(0, text.find('\n') + 1);
      if (line.at("part") == "log")
        told += std::stoull(line.at("message").get<std::string>());
    }
  }
}

} // namespace program_log_test

namespace line_forms_test {

using namespace godwit::daemon;

// 2026-05-04T10:15:44.123Z
const spdlog::log_clock::time_point a_time{std::chrono::milliseconds(1'777'889'744'123)};

std::string line(line_form form, spdlog::level::level_enum level, const std::string& sentence) {
  spdlog::memory_buf_t text;
  make_formatter(form)->clone()->format({a_time, {}, "vehicle_link", level, sentence}, text);
  return {text.data(), text.size()};
}

TEST(line_forms, plain_lines_say_only_what_needs_a_person) {
  EXPECT_EQ(line(line_form::plain, spdlog::level::info, "map pulled"), "map pulled");
  EXPECT_EQ(line(line_form::plain, spdlog::level::warn, "a\nb"), "warning: a\n    b");
  EXPECT_EQ(line(line_form::plain, spdlog::level::err, "c"), "error: c");
}

TEST(line_forms, stamped_lines_have_time_level_and_part_and_indent_what_follows) {
  EXPECT_EQ(line(line_form::stamped, spdlog::level::warn, "lost\nmend it"),
            "2026-05-04T10:15:44.123Z warning vehicle_link: lost\n    mend it");
}

TEST(line_forms, words_from_outside_can_not_look_like_a_line_of_ours_or_move_the_cursor) {
  EXPECT_EQ(line(line_form::plain, spdlog::level::info, "told: \x1b[2J\nerror: godwitd: fake"),
            "told: \\x1b[2J\n    error: godwitd: fake");
  EXPECT_EQ(line(line_form::stamped, spdlog::level::info, "\r\a").substr(25), "info vehicle_link: \\x0d\\x07");
}

TEST(line_forms, json_is_one_object_a_line_whatever_is_said) {
  const auto text = line(line_form::json, spdlog::level::err, "a \"word\"\nand \xff");
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto read = nlohmann::json::parse(text);
  EXPECT_EQ(read.size(), 4U);
  EXPECT_EQ(read.at("time"), "2026-05-04T10:15:44.123Z");
  EXPECT_EQ(read.at("level"), "error");
  EXPECT_EQ(read.at("part"), "vehicle_link");
  EXPECT_EQ(read.at("message"), "a \"word\"\nand \xef\xbf\xbd");
}

} // namespace line_forms_test
