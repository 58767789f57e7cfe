#include "programs/godwitd/checks/output_check.hpp"

#include <gtest/gtest.h>

#include "programs/godwitd/configuration.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace godwit::daemon {
namespace output_check_test {

using test::scratch;

// What is found when these options stand beside good ones.
std::vector<std::string> problems_with(const scratch& folder, const given_texts& more) {
  given_texts words{{"service", "https://missions.example.org"},
                    {"mission-id", "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42"},
                    {"vehicle", "udpin://127.0.0.1:14550"},
                    {"journal", folder.file("g.db")},
                    {"map", folder.file("m.db")},
                    {"trace", folder.file("trace")},
                    {"control", folder.file("control")}};
  for (const auto& [name, text] : more)
    words[name] = text;
  const auto configuration = effective_configuration(words, {});
  if (!configuration)
    return {configuration.error()};
  const auto settings = settings_from(*configuration);
  if (!settings)
    return {settings.error()};
  problem_list found;
  check_outputs(*settings, found);
  return found.take();
}

void expect_one(const std::vector<std::string>& problems, const std::string& option, const std::string& words) {
  ASSERT_EQ(problems.size(), 1U) << words;
  EXPECT_TRUE(problems[0].starts_with("--" + option + " (")) << problems[0];
  EXPECT_NE(problems[0].find(words), std::string::npos) << problems[0];
}

TEST(output_check, what_can_be_used_is_no_problem_and_nothing_is_made) {
  const scratch folder;
  EXPECT_TRUE(problems_with(folder, {}).empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(output_check, a_control_socket_without_its_folder_and_on_a_file_is_blamed) {
  const scratch folder;
  expect_one(problems_with(folder, {{"control", folder.file("no/control")}}), "control", "there is no folder");
  expect_one(problems_with(folder, {{"control", folder.write("notes", "text")}}), "control", "is no socket");
}

TEST(output_check, a_file_where_a_folder_is_wanted_and_a_folder_where_a_file_is_are_blamed) {
  const scratch folder;
  expect_one(problems_with(folder, {{"trace", folder.write("notes", "text")}}), "trace", "is no folder");
  expect_one(problems_with(folder, {{"trace", folder.file("notes/trace")}}), "trace", "is no folder");
  std::filesystem::create_directory(folder.file("folder"));
  for (const auto* option : {"journal", "map", "log-file"})
    expect_one(problems_with(folder, {{option, folder.file("folder")}}), option, "is a folder");
}

TEST(output_check, each_file_is_one_thing_by_whatever_name) {
  const scratch folder;
  expect_one(problems_with(folder, {{"map", folder.file("g.db")}}), "map", "is that of --journal already");
  expect_one(problems_with(folder, {{"map", folder.file("x/../g.db")}}), "map", "is that of --journal already");
  expect_one(problems_with(folder, {{"log-file", folder.file("g.starts")}}), "log-file", "is that of --journal");
  std::filesystem::create_symlink(folder.file("g.db"), folder.file("link.db"));
  expect_one(problems_with(folder, {{"map", folder.file("link.db")}}), "map", "is that of --journal already");
}

TEST(output_check, one_port_and_one_serial_line_are_for_one_thing) {
  const scratch folder;
  expect_one(problems_with(folder, {{"ground", "udpin://:14550"}}), "ground", "is taken");
  expect_one(problems_with(folder, {{"ground", "udpin://127.0.0.1:14550"}}), "ground", "is taken");
  expect_one(problems_with(folder, {{"vehicle", "serial:///dev/ttyS7"}, {"ground", "serial:///dev/ttyS7:115200"}}),
             "ground", "is taken");
  EXPECT_TRUE(problems_with(folder, {{"ground", "udpin://:14551"}}).empty());
  EXPECT_TRUE(problems_with(folder, {{"ground", "tcpin://:14550"}}).empty());
  EXPECT_TRUE(problems_with(folder, {{"ground", "udpout://10.0.0.7:14550"}}).empty());
}

TEST(output_check, a_name_with_a_zero_or_a_line_end_is_refused) {
  const scratch folder;
  for (const auto& name : {std::string("g\0.db", 5), std::string("g\n.db")}) {
    const auto problems = problems_with(folder, {{"journal", folder.file(name)}});
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_NE(problems[0].find("journal.path holds a control character"), std::string::npos) << problems[0];
  }
}

} // namespace output_check_test
} // namespace godwit::daemon
