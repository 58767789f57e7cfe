// godwitd as a process, against the missions service of godwit-sim, in real time.
#include <gtest/gtest.h>

#include <array>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/write.hpp"
#include "programs/common/control_client.hpp"
#include "tests/programs/godwitd/daemon_world.hpp"
#include "tests/programs/godwitd/process.hpp"

namespace daemon_test {

using namespace godwit;
using namespace godwit::test;
using sim::missions::row_kind;

const std::string godwitd = GODWITD;

struct daemon_run : testing::Test {
  daemon_world world;
};

TEST_F(daemon_run, a_mission_is_fetched_its_map_pulled_and_what_was_seen_is_delivered) {
  const auto seen = world.folder.write("seen", sighting_lines(1'200));
  program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen, "--once"});
  EXPECT_EQ(daemon.ends(), 0) << daemon.said();
  for (const auto* each :
       {"loaded: revision 1, 3 items", "map pulled: 0 objects", "1200 sightings recorded", "delivered"})
    EXPECT_NE(daemon.said().find(each), std::string::npos) << each << "\n" << daemon.said();
  EXPECT_EQ(world.service->rows(mission_id(0), row_kind::observation).size(), 1'200U);
  program listing(godwitd, {"--outbox", "--journal", world.folder.file("here/godwit.db")});
  EXPECT_EQ(listing.ends(), 0);
  EXPECT_NE(listing.said().find("nothing is pending"), std::string::npos) << listing.said();
}

TEST_F(daemon_run, started_again_with_the_same_words_it_delivers_nothing_twice) {
  const auto seen = world.folder.write("seen", sighting_lines(50));
  for (int time = 0; time < 2; ++time) {
    program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen, "--once"});
    EXPECT_EQ(daemon.ends(), 0) << daemon.said();
  }
  EXPECT_EQ(world.service->figures().rows[row_kind::observation].stored, 50U);
  EXPECT_EQ(world.service->figures().rows[row_kind::observation].repeated, 0U);
}

TEST_F(daemon_run, it_stays_until_it_is_told_to_end_and_can_be_asked_meanwhile) {
  const auto seen = world.folder.write("seen", sighting_lines(5));
  program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen});
  ASSERT_TRUE(daemon.waits_for("all reports of the mission are delivered")) << daemon.said();
  const auto socket = world.folder.file("here/godwit.control");
  const auto status = control::ask_daemon(socket, {{"do", "status"}});
  ASSERT_TRUE(status) << status.error();
  EXPECT_EQ(status->at("run").at("phase"), "over");
  EXPECT_EQ(status->at("service").at("revision"), 1);
  EXPECT_EQ(status->at("map").at("sync"), "synced");
  EXPECT_EQ(status->at("vehicle").at("phase"), "silent");
  program people(godwitd, {"ctl", "status", "--journal", world.folder.file("here/godwit.db")});
  EXPECT_EQ(people.ends(), 0);
  EXPECT_NE(people.said().find("5 recorded"), std::string::npos) << people.said();
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.ends(), 0) << daemon.said();
  EXPECT_FALSE(std::filesystem::exists(socket));
}

TEST_F(daemon_run, what_was_seen_for_a_deleted_mission_is_kept_and_never_called_delivered) {
  const auto pipe = world.folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", pipe});
  std::ofstream lines(pipe); // waits for its reader
  ASSERT_TRUE(daemon.waits_for("map pulled")) << daemon.said();
  ASSERT_TRUE(world.service->delete_mission(mission_id(0)));
  lines << sighting_lines(3);
  lines.close();
  ASSERT_TRUE(daemon.waits_for("3 rows left on the map")) << daemon.said();
  EXPECT_EQ(daemon.said().find("is delivered"), std::string::npos) << daemon.said();
  const auto journal = world.folder.file("here/godwit.db");
  program wrong(godwitd, {"ctl", "outbox-retry", sighting_id(99), "--journal", journal});
  EXPECT_EQ(wrong.ends(), 1);
}

TEST_F(daemon_run, a_refused_mission_is_a_sentence_with_what_to_do) {
  program daemon(godwitd, world.words("here", 99) + std::vector<std::string>{"--once"});
  EXPECT_EQ(daemon.ends(), 1);
  EXPECT_NE(daemon.said().find("Are the mission's id and the service's address right?"), std::string::npos)
      << daemon.said();
}

TEST_F(daemon_run, a_token_that_others_can_read_is_refused_at_the_start) {
  std::filesystem::permissions(world.token, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  program daemon(godwitd, world.words("here"));
  EXPECT_EQ(daemon.ends(), 1);
  EXPECT_NE(daemon.said().find("0600"), std::string::npos) << daemon.said();
  EXPECT_EQ(daemon.said().find("secret"), std::string::npos);
}

TEST_F(daemon_run, a_journal_has_one_writer_and_a_foreign_map_is_left_alone) {
  program first(godwitd, world.words("here"));
  ASSERT_TRUE(first.waits_for("map pulled")) << first.said();
  program second(godwitd, world.words("here"));
  EXPECT_EQ(second.ends(), 1);
  EXPECT_NE(second.said().find("godwit.db"), std::string::npos) << second.said();
  auto words = world.words("there");
  const auto notes = world.folder.write("there/notes", "these are my notes");
  program third(godwitd, words + std::vector<std::string>{"--map", notes});
  EXPECT_EQ(third.ends(), 72);
  EXPECT_NE(third.said().find("notes"), std::string::npos) << third.said();
  EXPECT_EQ(scratch::read(notes), "these are my notes");
}

TEST_F(daemon_run, a_vehicle_that_can_not_be_reached_is_said_and_the_rest_goes_on) {
  auto words = world.words("here");
  std::ranges::replace(words, std::string("udpin://127.0.0.1:0"), std::string("udpin://192.0.2.1:14550"));
  const auto seen = world.folder.write("seen", sighting_lines(5));
  program daemon(godwitd, words + std::vector<std::string>{"--sightings", seen});
  EXPECT_TRUE(daemon.waits_for("192.0.2.1")) << daemon.said();
  EXPECT_TRUE(daemon.waits_for("all reports of the mission are delivered")) << daemon.said();
}

TEST_F(daemon_run, what_flew_for_an_earlier_mission_is_delivered_before_the_next_one_is_fetched) {
  const auto seen = world.folder.write("seen", sighting_lines(20));
  ASSERT_TRUE(world.service->set_fault("status 503 on post-mapobjects"));
  {
    program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen});
    ASSERT_TRUE(daemon.waits_for("20 sightings recorded")) << daemon.said();
    daemon.signal(SIGKILL);
    EXPECT_EQ(daemon.ends(), -1);
  }
  world.service->clear_faults();
  ASSERT_TRUE(world.service->add_mission(small_mission(1)));
  program next(godwitd, world.words("here", 1) + std::vector<std::string>{"--once"});
  EXPECT_EQ(next.ends(), 0) << next.said();
  EXPECT_EQ(world.service->rows(mission_id(0), row_kind::observation).size(), 20U);
}

TEST_F(daemon_run, a_push_that_fails_says_why_and_goes_on_when_it_can) {
  const auto seen = world.folder.write("seen", sighting_lines(5));
  ASSERT_TRUE(world.service->set_fault("status 503 on post-mapobjects"));
  program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen, "--once"});
  ASSERT_TRUE(daemon.waits_for("the delivery fails, and is tried again")) << daemon.said();
  EXPECT_NE(daemon.said().find("503"), std::string::npos) << daemon.said();
  world.service->clear_faults();
  EXPECT_EQ(daemon.ends(), 0) << daemon.said();
}

TEST_F(daemon_run, a_push_that_is_not_allowed_ends_a_run_that_is_to_end_with_the_reason) {
  const auto seen = world.folder.write("seen", sighting_lines(5));
  ASSERT_TRUE(world.service->set_fault("status 401 on post-mapobjects"));
  program daemon(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen, "--once"});
  EXPECT_EQ(daemon.ends(), 1) << daemon.said();
  EXPECT_NE(daemon.said().find("the service does not allow the delivery"), std::string::npos) << daemon.said();
  EXPECT_NE(daemon.said().find("401"), std::string::npos) << daemon.said();
  world.service->clear_faults();
  program next(godwitd, world.words("here") + std::vector<std::string>{"--sightings", seen, "--once"});
  EXPECT_EQ(next.ends(), 0) << next.said();
  EXPECT_EQ(world.service->rows(mission_id(0), row_kind::observation).size(), 5U);
}

// The programs as people start them: both real, over TCP.
TEST(daemon_and_sim, the_real_programs_work_together) {
  const scratch folder;
  const auto token = folder.write("token", "secret\n");
  const auto mission = folder.write("mission.json", mission::to_text(small_mission(0)));
  const auto seen = folder.write("seen", sighting_lines(30));
  program service(GODWIT_SIM, {"missions", "--listen", "127.0.0.1:0", "--token-file", token, "--mission", mission,
                               "--db", folder.file("service.db")});
  const std::string scheme = "http://127.0.0.1:";
  ASSERT_TRUE(service.waits_for(scheme)) << service.said();
  const auto where = service.said().find(scheme);
  const auto address =
      service.said().substr(where, service.said().find_first_not_of("0123456789", where + scheme.size()) - where);
  program daemon(godwitd, {"--service", address, "--mission-id", mission_id(0), "--token-file", token, "--vehicle",
                           "udpin://127.0.0.1:0", "--journal", folder.file("godwit.db"), "--trace",
                           folder.file("trace"), "--sightings", seen, "--once"});
  EXPECT_EQ(daemon.ends(), 0) << daemon.said();
  service.signal(SIGTERM);
  EXPECT_EQ(service.ends(), 0) << service.said();
}

} // namespace daemon_test
