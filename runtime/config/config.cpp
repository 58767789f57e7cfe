#include "runtime/config/config.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

#include "runtime/assert.hpp"
#include "runtime/config/parse.hpp"
#include "runtime/config/schema.hpp"

namespace godwit::runtime {

namespace {

config_error unreadable(const std::filesystem::path& file, int error_number) {
  return {config_errc::unreadable,
          file.string(),
          0,
          0,
          {{{}, std::string("can not be read: ") + std::strerror(error_number), {}}},
          0};
}

} // namespace

tl::expected<nlohmann::json, config_error> load_config(std::string_view text, std::string_view source,
                                                       std::string_view schema_text) {
  auto document = parse_config(text, source);
  if (!document)
    return document;
  const io::schemas::compiled_schema schema(nlohmann::json::parse(schema_text));
  auto problems = violations(*document, schema);
  if (!problems.empty()) {
    const auto omitted = problems.size() - std::min(problems.size(), max_config_problems);
    problems.resize(problems.size() - omitted);
    return tl::unexpected(config_error{config_errc::invalid, std::string(source), 0, 0, std::move(problems), omitted});
  }
  fill_defaults(*document, schema.source());
  GODWIT_ASSERT(violations(*document, schema).empty(), "the defaults of a schema are valid by it");
  if (document->is_object())
    document->erase("$schema");
  return document;
}

tl::expected<nlohmann::json, config_error> load_config_file(const std::filesystem::path& file,
                                                            std::string_view schema_text) {
  // Opening a pipe would wait for somebody who writes.
  std::error_code ignored;
  if (const auto there = std::filesystem::status(file, ignored);
      std::filesystem::is_fifo(there) || std::filesystem::is_socket(there) || std::filesystem::is_directory(there))
    return tl::unexpected(config_error{
        config_errc::unreadable, file.string(), 0, 0, {{{}, "can not be read: it is not a regular file", {}}}, 0});
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    return tl::unexpected(unreadable(file, errno));
  std::string text(max_config_bytes + 1,
                   '\0'); // one more than allowed, so that parse_config sees a file that is too large
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad())
    return tl::unexpected(unreadable(file, errno));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return load_config(text, file.string(), schema_text);
}

} // namespace godwit::runtime
