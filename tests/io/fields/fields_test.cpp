#include <gtest/gtest.h>

#include <cmath>

#include "io/fields/binary.hpp"
#include "io/fields/field_table.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace fields_test {

using namespace godwit::io;

enum class colour { red = 1, green = 2 };
constexpr auto enum_names(colour) { return names<colour>({{colour::red, "red"}, {colour::green, "green"}}); }

struct inner {
  float x = 0;
  std::optional<std::string> note;
  static constexpr auto fields = table("inner", field("x", &inner::x), field("note", &inner::note));
};

struct outer {
  bool flag = false;
  std::int8_t small = 0;
  std::uint64_t big = 0;
  double ratio = 0;
  std::string name;
  colour paint = colour::red;
  std::vector<inner> list;
  std::array<std::uint16_t, 3> triple{};
  std::chrono::nanoseconds wait{0};
  std::string token;
  static constexpr auto fields =
      table("outer", field("flag", &outer::flag), field("small", &outer::small), field("big", &outer::big),
            field("ratio", &outer::ratio), field("name", &outer::name), field("paint", &outer::paint),
            field("list", &outer::list), field("triple", &outer::triple), field("wait", &outer::wait),
            secret("token", &outer::token));
};

outer sample() {
  return {.flag = true,
          .small = -5,
          .big = 18446744073709551615ULL,
          .ratio = 0.1,
          .name = "a \"b\" \\ \n \x01 \xC3\xA9",
          .paint = colour::green,
          .list = {{1.5F, "hi"}, {2.5F, std::nullopt}},
          .triple = {1, 2, 3},
          .wait = std::chrono::nanoseconds(42),
          .token = "hunter2"};
}

std::string decoded(const outer& value) {
  std::array<std::byte, 4096> memory{};
  byte_sink sink(memory);
  encode_value(sink, value);
  EXPECT_FALSE(sink.overflow());
  byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
  std::string text;
  append_decoded_json<outer>(text, source);
  EXPECT_FALSE(source.exhausted());
  return text;
}

TEST(fields, json_round_trip_keeps_every_open_field) {
  const auto text = to_json(sample());
  outer back;
  ASSERT_TRUE(read_json(nlohmann::json::parse(text), back));
  back.token = sample().token;
  EXPECT_TRUE(equal(back, sample())) << text;
}

TEST(fields, secrets_appear_in_no_rendering) {
  EXPECT_EQ(to_json(sample()).find("hunter2"), std::string::npos);
  EXPECT_EQ(decoded(sample()).find("hunter2"), std::string::npos);
  EXPECT_EQ(json_schema<outer>().dump().find("token"), std::string::npos);
}

TEST(fields, binary_form_renders_the_same_json_as_the_value) { EXPECT_EQ(decoded(sample()), to_json(sample())); }

TEST(fields, equality_sees_each_field) {
  auto other = sample();
  other.list[1].x = 3;
  EXPECT_FALSE(equal(other, sample()));
  other = sample();
  other.token = "else";
  EXPECT_FALSE(equal(other, sample()));
}

TEST(fields, numbers_that_json_does_not_know_become_null_and_come_back_as_nan) {
  auto value = sample();
  value.ratio = std::numeric_limits<double>::infinity();
  outer back;
  ASSERT_TRUE(read_json(nlohmann::json::parse(to_json(value)), back));
  EXPECT_TRUE(std::isnan(back.ratio));
}

TEST(fields, bytes_that_are_not_utf8_still_give_a_document_that_parses) {
  for (const std::string bad :
       {"\xFF", "\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xE2\x82", "ok\x80", "\xF0\x80\x80\x80"}) {
    auto value = sample();
    value.name = bad;
    EXPECT_TRUE(nlohmann::json::accept(to_json(value)));
  }
}

TEST(fields, reading_names_the_path_of_what_is_wrong) {
  outer back;
  auto document = nlohmann::json::parse(to_json(sample()));
  document["list"][1]["x"] = "wide";
  auto read = read_json(document, back);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message(), "list[1].x: expected a number, found \"wide\"");

  document = nlohmann::json::parse(R"({"small": 300})");
  EXPECT_EQ(read_json(document, back).error().message(), "small: expected a number from -128 to 127, found 300");
  document = nlohmann::json::parse(R"({"paint": "blue"})");
  EXPECT_EQ(read_json(document, back).error().message(), R"(paint: expected one of "red", "green", found "blue")");
  document = nlohmann::json::parse(R"({"colour": 1})");
  EXPECT_EQ(read_json(document, back).error().message(), "colour: unknown property");
  document = nlohmann::json::parse(R"({"triple": [1, 2]})");
  EXPECT_EQ(read_json(document, back).error().message(), "triple: expected a list of 3, found [1,2]");
}

struct label {
  std::array<char, 4> text{};
  static constexpr auto fields = table("label", field("text", &label::text));
};

TEST(fields, an_array_of_char_is_the_text_up_to_its_first_nul_or_all_of_it) {
  EXPECT_EQ(to_json(label{}), R"({"text":""})");
  EXPECT_EQ(to_json(label{{'a', '"', '\0', 'x'}}), R"({"text":"a\""})");
  EXPECT_EQ(to_json(label{{'f', 'u', 'l', 'l'}}), R"({"text":"full"})");
  EXPECT_EQ(json_schema<label>()["properties"]["text"]["type"], "string");
}

TEST(fields, an_array_of_char_renders_the_same_from_its_binary_form) {
  const label value{{'o', 'k'}};
  std::array<std::byte, 16> memory{};
  byte_sink sink(memory);
  encode_value(sink, value);
  byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
  std::string text;
  append_decoded_json<label>(text, source);
  EXPECT_EQ(text, to_json(value));
}

TEST(fields, a_text_is_read_into_an_array_of_char_if_it_has_room) {
  label back{{'o', 'l', 'd', '!'}};
  ASSERT_TRUE(read_json(nlohmann::json::parse(R"({"text": "new"})"), back));
  EXPECT_EQ(back.text, (std::array<char, 4>{'n', 'e', 'w'}));
  EXPECT_EQ(read_json(nlohmann::json::parse(R"({"text": "longer"})"), back).error().message(),
            R"(text: expected a text of at most 4 bytes, found "longer")");
}

TEST(fields, encoding_into_too_little_memory_is_noticed_and_writes_nothing_outside) {
  std::array<std::byte, 64> memory{};
  const auto value = sample();
  for (std::size_t size = 0; size < 40; ++size) {
    byte_sink sink(std::span<std::byte>(memory.data(), size));
    encode_value(sink, value);
    EXPECT_TRUE(sink.overflow());
    EXPECT_LE(sink.used(), size);
  }
}

TEST(fields, decoding_cut_bytes_ends_and_says_so) {
  std::array<std::byte, 4096> memory{};
  byte_sink sink(memory);
  encode_value(sink, sample());
  for (std::size_t size = 0; size < sink.used(); ++size) {
    byte_source source(std::span<const std::byte>(memory.data(), size));
    std::string text;
    append_decoded_json<outer>(text, source);
    EXPECT_TRUE(source.exhausted());
  }
}

} // namespace fields_test
