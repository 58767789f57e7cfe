#include "tests/actors/domain/mission/sample_files.hpp"

#include <fstream>
#include <sstream>

namespace godwit::mission {

std::string sample_file(const std::string& name) {
  const std::ifstream in(std::string(GODWIT_TEST_DATA) + "/missions/" + name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace godwit::mission
