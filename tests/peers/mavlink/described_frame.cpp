#include "tests/peers/mavlink/described_frame.hpp"

#include <nlohmann/json.hpp>

namespace godwit::io::mavlink::peers {

namespace {

void compare(const std::string& prefix, const texts& expected, const texts& found, std::vector<std::string>& out) {
  const auto say = [&](const std::string& name, const std::string& what) {
    out.push_back(prefix);
    out.back().append(name).append(": ").append(what);
  };
  for (const auto& [name, text] : expected) {
    const auto other = found.find(name);
    if (other == found.end())
      say(name, "missing, expected " + text);
    else if (other->second != text)
      say(name, other->second + ", expected " + text);
  }
  for (const auto& [name, text] : found)
    if (!expected.contains(name))
      say(name, text + ", expected nothing of this name");
}

} // namespace

std::string to_line(const described_frame& description) {
  const nlohmann::json line = {
      {"message", description.message}, {"frame", description.frame}, {"fields", description.fields}};
  return line.dump() + '\n';
}

described_frame from_line(const std::string& line) {
  const auto json = nlohmann::json::parse(line);
  return {json.at("message").get<std::string>(), json.at("frame").get<texts>(), json.at("fields").get<texts>()};
}

std::vector<std::string> differences(const described_frame& expected, const described_frame& found) {
  std::vector<std::string> result;
  compare("", {{"message", expected.message}}, {{"message", found.message}}, result);
  compare(expected.message + ' ', expected.frame, found.frame, result);
  compare(expected.message + '.', expected.fields, found.fields, result);
  return result;
}

} // namespace godwit::io::mavlink::peers
