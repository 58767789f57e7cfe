#include "programs/godwitd/log/line_forms.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/details/log_msg.h>

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
