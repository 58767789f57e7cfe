// The files of tests/data/missions.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

namespace godwit::mission {

inline std::string sample_file(const std::string& name) {
  std::ifstream in(std::string(GODWIT_TEST_DATA) + "/missions/" + name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace godwit::mission
