#include "actors/mission_client/picture_body.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <openssl/evp.h>

namespace godwit::mission_client {

bool put_picture(service_call& call, const std::filesystem::path& folder) {
  std::ifstream file(folder / std::filesystem::path(call.picture).filename(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty())
    return false;
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');                        // and the zero that ends it
  const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data()); // characters as bytes
  auto* const to = reinterpret_cast<unsigned char*>(text.data());
  text.resize(static_cast<std::size_t>(EVP_EncodeBlock(to, from, static_cast<int>(bytes.size()))));
  constexpr std::string_view end = R"("})";
  call.body.insert(call.body.size() - end.size(), text);
  return true;
}

} // namespace godwit::mission_client
