#include "programs/godwitd/operator_port/camera_api.hpp"

#include <gtest/gtest.h>

#include "programs/godwitd/operator_port/operator_port.hpp"
#include "tests/io/http/server/server_fixture.hpp"

namespace camera_api_test {

using namespace godwit;
using namespace godwit::operator_port;
using io::http::test::raw_client;

class camera_port : public testing::Test {
protected:
  camera_port() {
    const auto api = std::make_shared<camera_api>(camera_parts{
        [this](std::uint64_t after) { return newest && newest->number > after ? newest : std::nullopt; },
        [this](std::int64_t until_ns) { wanted_until_ns = until_ns; },
        [this](std::uint64_t point) {
          return point == 3 ? std::optional(daemon::point_picture{time.wall_ns() - 60'000'000'000, {std::byte{0xFF}}})
                            : std::nullopt;
        },
        &time});
    const auto opened = port.open({.host = "127.0.0.1", .port = 0, .hosts = {}}, api->routes());
    EXPECT_TRUE(opened) << opened.error();
    const auto place = port.place();
    number = static_cast<std::uint16_t>(std::stoi(place.substr(place.find(':') + 1)));
  }
  ~camera_port() override {
    port.close([] {});
  }
  raw_client::answer get(const std::string& query = {}) { return get_at("camera/picture" + query); }
  raw_client::answer get_at(const std::string& path) {
    raw_client client(number);
    client.write("GET /api/v1/" + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return client.read();
  }
  void take(std::uint64_t picture, std::int64_t age_ns) {
    newest = io::eyes::picture{picture, time.monotonic_ns() - age_ns, 64, 48, {std::byte{0xFF}, std::byte{0xD8}}};
  }

  runtime::system_time time;
  std::optional<io::eyes::picture> newest;
  std::int64_t wanted_until_ns = 0;
  class port port;
  std::uint16_t number = 0;
};

TEST_F(camera_port, the_newest_picture_comes_with_its_number_and_its_time) {
  take(17, 40'000'000);
  const auto answer = get();
  EXPECT_EQ(answer.result_int(), 200U);
  EXPECT_EQ(answer["Content-Type"], "image/jpeg");
  EXPECT_EQ(answer["Godwit-Picture"], "17");
  EXPECT_EQ(answer["Cache-Control"], "no-store");
  EXPECT_NEAR(std::stod(std::string(answer["Godwit-Captured-Ms"])), static_cast<double>(time.wall_ns() / 1'000'000),
              10'000);
  EXPECT_GE(std::stoi(std::string(answer["Godwit-Age-Ms"])), 40);
  EXPECT_EQ(answer.body(), "\xFF\xD8");
}

TEST_F(camera_port, who_has_the_newest_is_told_so) {
  take(17, 0);
  EXPECT_EQ(get("?after=17").result_int(), 204U);
  EXPECT_EQ(get("?after=16").result_int(), 200U);
}

TEST_F(camera_port, a_picture_that_is_old_or_of_the_future_is_none) {
  EXPECT_EQ(get().result_int(), 503U);
  take(17, camera_api::counts_for_ns + 1);
  EXPECT_EQ(get().result_int(), 503U);
  take(18, -60'000'000'000);
  EXPECT_EQ(get().result_int(), 503U);
}

TEST_F(camera_port, pictures_are_made_while_somebody_asks) {
  const auto before = time.monotonic_ns();
  (void)get();
  EXPECT_GE(wanted_until_ns, before + camera_api::wanted_for_ns);
}

TEST_F(camera_port, another_query_is_refused) {
  for (const auto* each : {"?after=", "?after=x", "?after=-1", "?before=1", "?after=1&b=2"})
    EXPECT_EQ(get(each).result_int(), 400U) << each;
}

TEST_F(camera_port, the_picture_of_a_point_comes_with_its_time_however_old_it_is) {
  const auto answer = get_at("points/3/picture");
  EXPECT_EQ(answer.result_int(), 200U);
  EXPECT_EQ(answer["Content-Type"], "image/jpeg");
  EXPECT_GE(std::stoi(std::string(answer["Godwit-Age-Ms"])), 60'000);
  EXPECT_EQ(answer.body(), "\xFF");
}

TEST_F(camera_port, a_point_without_a_picture_and_what_is_no_number_are_not_found) {
  for (const auto* each : {"4", "-3", "3x", "x", "99999999999999999999999"})
    EXPECT_EQ(get_at("points/" + std::string(each) + "/picture").result_int(), 404U) << each;
}

} // namespace camera_api_test
