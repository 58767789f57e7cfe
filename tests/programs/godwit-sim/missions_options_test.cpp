#include "programs/godwit-sim/missions_options.hpp"

#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "actors/domain/mission/write.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"
#include "tests/support/tls_identity.hpp"

namespace godwit::sim {
namespace missions_options_test {

struct missions_options : ::testing::Test {
  missions_options() {
    const auto identity = test::make_tls_identity({});
    given.token_file = write("token", "secret\n");
    given.missions = {write("m.json", mission::to_text(missions::small_mission()))};
    given.database = folder.file("missions.db");
    given.tls = write("cert.pem", identity.certificate) + "," + write("key.pem", identity.key);
  }

  [[nodiscard]] std::string write(const std::string& name, const std::string& text, mode_t mode = 0600) const {
    auto file = folder.file(name);
    std::ofstream(file) << text;
    ::chmod(file.c_str(), mode);
    return file;
  }

  missions::scratch folder;
  missions_arguments given;
};

TEST_F(missions_options, what_is_given_reaches_the_service) {
  given.listen = "0.0.0.0:8443";
  given.foreign_token_file = write("foreign", "other");
  given.faults = {"lose times 1"};
  given.control = "127.0.0.1:14700";
  given.seed = 7;
  given.map_objects = 10;
  given.around = "47.4, 8.5";
  const auto wanted = read(given);
  ASSERT_TRUE(wanted) << wanted.error();
  const auto& settings = wanted->settings;
  EXPECT_EQ(settings.host, "0.0.0.0");
  EXPECT_EQ(settings.port, 8443);
  EXPECT_EQ(settings.token, "secret");
  EXPECT_EQ(settings.foreign_token, "other");
  EXPECT_TRUE(settings.tls && !settings.wrong_host_tls);
  EXPECT_EQ(settings.missions, std::vector{missions::small_mission()});
  EXPECT_EQ(settings.faults, given.faults);
  EXPECT_EQ(settings.control->port, 14700);
  EXPECT_EQ(settings.seed, 7U);
  EXPECT_EQ(settings.map.count, 10U);
  EXPECT_EQ(settings.map.latitude, 47.4);
  EXPECT_EQ(settings.map.longitude, 8.5);
}

TEST_F(missions_options, the_map_lies_around_the_first_return_point_unless_it_is_said) {
  given.map_objects = 10;
  const auto wanted = read(given);
  ASSERT_TRUE(wanted) << wanted.error();
  EXPECT_EQ(wanted->settings.map.latitude, missions::small_mission().return_point->latitude);
}

TEST_F(missions_options, a_plan_is_taken_when_nothing_of_it_is_lost_or_when_that_is_allowed) {
  const std::string plan = R"({"fileType":"Plan","version":1,"groundStation":"QGroundControl",
    "geoFence":{"circles":[],"polygons":[],"version":2},"rallyPoints":{"points":[],"version":2},
    "mission":{"version":2,"firmwareType":12,"vehicleType":2,"cruiseSpeed":15,"hoverSpeed":5,
    "globalPlanAltitudeMode":1,"plannedHomePosition":[47.3977,8.5456,488],"items":[
    {"type":"SimpleItem","autoContinue":true,"command":16,"doJumpId":1,"frame":3,"AMSLAltAboveTerrain":null,
     "Altitude":40,"AltitudeMode":1,"params":[0,0,0,null,47.3985,8.5465,40]},
    {"type":"SimpleItem","autoContinue":true,"command":208,"doJumpId":2,"frame":2,
     "params":[2,0,0,0,0,0,0]}]}})";
  given.missions = {write("lossy.plan", plan)};
  const auto refused = read(given);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find("--allow-partial"), std::string::npos) << refused.error();
  given.allow_partial = true;
  const auto taken = read(given);
  ASSERT_TRUE(taken) << taken.error();
  EXPECT_EQ(taken->notes.size(), 2U); // what was lost, and what is served
}

TEST_F(missions_options, a_mistake_names_the_option_and_what_to_do) {
  const auto open_token = write("open", "secret", 0644);
  const auto open_key = write("open.pem", "key", 0644);
  const auto broken = write("broken.json", "{}");
  const std::string certificate = given.tls.substr(0, given.tls.find(','));
  const std::pair<std::function<void(missions_arguments&)>, const char*> mistakes[] = {
      {[](auto& to) { to.listen = "8443"; }, "--listen: \"8443\" is no place"},
      {[](auto& to) { to.listen = ":8443"; }, "--listen: \":8443\" is no place"},
      {[](auto& to) { to.tls = "cert.pem"; }, "--tls: \"cert.pem\" is no pair of files"},
      {[](auto& to) { to.tls = "/no/cert.pem,/no/key.pem"; }, "--tls: /no/cert.pem can not be read"},
      {[&](auto& to) { to.tls = certificate + "," + open_key; }, "chmod 600"},
      {[&](auto& to) { to.token_file = open_token; }, "chmod 600"},
      {[](auto& to) { to.token_file = "/no/token"; }, "--token-file: /no/token: there is no such file"},
      {[](auto& to) { to.missions.clear(); }, "--mission: name at least one"},
      {[](auto& to) { to.missions = {"m.txt.gz"}; }, "--mission: m.txt.gz is no file of a mission"},
      {[](auto& to) { to.missions = {"/no/m.json"}; }, "--mission: /no/m.json can not be read"},
      {[&](auto& to) { to.missions = {broken}; }, "/items is missing"},
      {[](auto& to) { to.faults = {"explode"}; }, "--fault: \"explode\" is no fault"},
      {[](auto& to) { to.control = "0.0.0.0:1"; }, "--control: \"0.0.0.0:1\" is no place"},
      {[](auto& to) { to.around = "here"; }, "--around: \"here\" is no place"},
      {[](auto& to) { to.map_objects = 1'000'000; }, "--map-objects: at most"},
  };
  for (const auto& [change, part] : mistakes) {
    auto mistaken = given;
    change(mistaken);
    const auto wanted = read(mistaken);
    ASSERT_FALSE(wanted) << part;
    EXPECT_NE(wanted.error().find(part), std::string::npos) << wanted.error();
  }
}

} // namespace missions_options_test
} // namespace godwit::sim
