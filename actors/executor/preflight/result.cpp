#include "actors/executor/preflight/result.hpp"

#include <utility>

#include "io/fields/utf8.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::preflight {

namespace {

result result_of(verdict how, std::string sentence) { return {how, cut_text(std::move(sentence), max_sentence)}; }

} // namespace

result pass(std::string sentence) { return result_of(verdict::pass, std::move(sentence)); }
result degraded(std::string sentence) { return result_of(verdict::degraded, std::move(sentence)); }
result fail(std::string sentence) { return result_of(verdict::fail, std::move(sentence)); }
result skipped(std::string sentence) { return result_of(verdict::skipped, std::move(sentence)); }

std::string cut_text(std::string text, std::size_t size) {
  text.resize(io::whole_characters(text, size));
  return text;
}

std::string summary_of(const std::vector<std::string>& sentences) {
  GODWIT_ASSERT(!sentences.empty(), "a summary is of something");
  const auto others = sentences.size() - 1;
  return sentences.front() + (others == 0 ? "" : " (and " + std::to_string(others) + " more)");
}

} // namespace godwit::executor::preflight
