#include "programs/godwit-trace/enum_fields.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "io/mavlink/messages.hpp"

namespace godwit::trace_tool {
namespace enum_fields_test {

std::string name_in(std::uint32_t message_id, std::string_view field, std::uint64_t value) {
  const auto rows = enum_fields_of(message_id);
  const auto found = std::ranges::find(rows, field, &enum_field::field);
  std::string out;
  if (found != rows.end())
    found->append_name(out, value);
  return out;
}

TEST(enum_fields, every_row_names_an_unsigned_field_of_its_message) {
  std::size_t found = 0;
  io::mavlink::known_messages::for_each([&]<io::mavlink::message M>() {
    io::for_each_field<M>([&](const auto& entry) {
      using value = std::remove_cvref_t<decltype(M{}.*entry.member)>;
      for (const auto& row : enum_fields_of(M::message_id))
        found += row.field == entry.name && std::is_unsigned_v<value> ? 1 : 0;
    });
  });
  EXPECT_EQ(found, enum_fields().size());
}

TEST(enum_fields, numbers_have_the_names_of_mavlink) {
  EXPECT_EQ(name_in(77, "result", 0), "ACCEPTED");
  EXPECT_EQ(name_in(77, "command", 400), "COMPONENT_ARM_DISARM");
  EXPECT_EQ(name_in(47, "type", 13), "INVALID_SEQUENCE");
  EXPECT_EQ(name_in(253, "severity", 4), "WARNING");
  EXPECT_EQ(name_in(0, "autopilot", 12), "PX4");
  EXPECT_EQ(name_in(44, "mission_type", 255), "ALL");
}

TEST(enum_fields, bits_have_all_their_names) {
  EXPECT_EQ(name_in(0, "base_mode", 129), "CUSTOM_MODE_ENABLED|SAFETY_ARMED");
  EXPECT_EQ(name_in(0, "base_mode", 0), "");
}

TEST(enum_fields, what_has_no_name_gets_none) {
  EXPECT_EQ(name_in(77, "command", 65'000), "");
  EXPECT_EQ(name_in(77, "result", 256), "") << "not the name of 0";
  EXPECT_EQ(name_in(77, "progress", 0), "");
  EXPECT_TRUE(enum_fields_of(30).empty());
}

} // namespace enum_fields_test
} // namespace godwit::trace_tool
