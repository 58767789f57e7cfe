#include "runtime/config/config.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "runtime/config/parse.hpp"

namespace godwit::runtime {

namespace config_test {

using nlohmann::json;

std::string message_of(std::string_view text) {
  const auto loaded = load_config(text, "godwit.json", godwit_schema());
  EXPECT_FALSE(loaded);
  return loaded ? std::string() : loaded.error().message();
}

class config_file : public testing::Test {
protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) {
    std::ofstream(folder_ / "test.json") << text;
    return folder_ / "test.json";
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("godwit_config_" + std::to_string(::getpid()) + "_" +
                                                testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(config_file, a_pipe_or_a_folder_is_refused_and_not_waited_for) {
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& each : {pipe, folder_}) {
    const auto loaded = load_config_file(each, godwit_schema());
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message().find("not a regular file"), std::string::npos) << loaded.error().message();
  }
}

TEST(config, an_empty_document_is_the_default_configuration_of_the_runtime) {
  const auto loaded = load_config("{}", "godwit.json", godwit_schema());
  ASSERT_TRUE(loaded) << loaded.error().message();
  const auto expected = json::parse(R"({
    "journal": {"path": "godwit.db"},
    "trace": {"directory": "trace", "segment_mib": 8, "total_mib": 256, "flush_ms": 100, "links": true},
    "scheduler": {"workers": 0, "max_throughput": 20},
    "supervision": {"ping_period_ms": 1000, "ping_warn_ms": 3000, "ping_fatal_ms": 10000, "stop_timeout_ms": 2000}
  })");
  for (const auto& [section, defaults] : expected.items())
    EXPECT_EQ(loaded->at(section), defaults) << section;
}

TEST(config, the_shipped_configuration_equals_the_defaults_and_has_every_key) {
  const auto file = std::filesystem::path(GODWIT_CONFIG_DIR) / "godwit.json";
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  auto shipped = parse_config(text, "godwit.json");
  ASSERT_TRUE(shipped) << shipped.error().message();
  shipped->erase("$schema");
  EXPECT_EQ(*shipped, load_config("{}", "", godwit_schema()).value());
  EXPECT_TRUE(load_config_file(file, godwit_schema()));
}

TEST(config, the_embedded_schema_is_the_one_in_the_tree) {
  std::ifstream stream(std::filesystem::path(GODWIT_CONFIG_DIR) / "godwit.schema.json");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(godwit_schema(), text);
}

TEST(config, given_values_stay_beside_the_defaults) {
  const auto loaded = load_config(R"({"trace": {"total_mib": 16}})", "godwit.json", godwit_schema());
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_EQ(loaded->at("trace").at("total_mib"), 16);
  EXPECT_EQ(loaded->at("trace").at("flush_ms"), 100);
}

TEST(config, all_errors_are_reported_at_once_with_path_and_allowed_values) {
  EXPECT_EQ(
      message_of(R"({"trace": {"total_mib": 5, "segmnt_mib": 4}, "scheduler": {"workers": "two"}})"),
      "godwit.json: scheduler.workers is \"two\"; allowed: a whole number from 0 to 256\n"
      "godwit.json: trace.total_mib is 5; allowed: a whole number from 16 to 65536\n"
      "godwit.json: trace.segmnt_mib is not known; did you mean segment_mib?; allowed: directory, flush_ms, links, "
      "segment_mib, total_mib");
}

TEST(config, the_number_of_reported_problems_has_a_bound_and_the_rest_is_counted) {
  json many = json::object();
  for (std::size_t index = 0; index < max_config_problems + 10; ++index)
    many["unknown_" + std::to_string(index)] = 1;
  const auto loaded = load_config(many.dump(), "godwit.json", godwit_schema());
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().problems.size(), max_config_problems);
  EXPECT_EQ(loaded.error().omitted, 10U);
  EXPECT_NE(loaded.error().message().find("and 10 further problems"), std::string::npos);
}

TEST(config, every_seed_of_the_fuzz_target_gives_a_document_or_a_sentence) {
  std::size_t seeds = 0;
  for (const auto& seed : std::filesystem::directory_iterator(GODWIT_FUZZ_SEEDS)) {
    const auto loaded = load_config_file(seed.path(), godwit_schema());
    EXPECT_TRUE(loaded || !loaded.error().message().empty()) << seed.path();
    ++seeds;
  }
  EXPECT_GE(seeds, 6U);
}

TEST_F(config_file, is_read_and_its_name_is_in_the_messages) {
  const auto good = load_config_file(write(R"({"scheduler": {"workers": 3}})"), godwit_schema());
  ASSERT_TRUE(good) << good.error().message();
  EXPECT_EQ(good->at("scheduler").at("workers"), 3);
  const auto bad = load_config_file(write("{\n]"), godwit_schema());
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message().find((folder_ / "test.json").string() + ":2:1: is not JSON: "), 0U)
      << bad.error().message();
}

TEST_F(config_file, that_is_missing_or_a_folder_is_unreadable_with_the_reason) {
  const auto missing = load_config_file(folder_ / "none.json", godwit_schema());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, config_errc::unreadable);
  EXPECT_EQ(missing.error().message(),
            (folder_ / "none.json").string() + ": can not be read: No such file or directory");
  const auto folder = load_config_file(folder_, godwit_schema());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, config_errc::unreadable) << folder.error().message();
}

TEST_F(config_file, that_never_ends_is_too_large) {
  const auto endless = load_config_file("/dev/zero", godwit_schema());
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().code, config_errc::too_large);
}

} // namespace config_test

} // namespace godwit::runtime
