#include "io/json_schema/sentence_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "io/fields/json_text.hpp"

namespace godwit::io::schemas {

namespace {

constexpr std::size_t longest_word = 64; // the work grows with the square of the length

// Optimal string alignment: insertions, deletions, changes and swaps of neighbours
// (https://doi.org/10.1145/363958.363994).
std::size_t distance(std::string_view left, std::string_view right) {
  std::vector<std::size_t> before_previous;
  std::vector<std::size_t> previous(right.size() + 1);
  std::vector<std::size_t> current(right.size() + 1);
  std::iota(previous.begin(), previous.end(), 0);
  for (std::size_t row = 1; row <= left.size(); ++row) {
    current[0] = row;
    for (std::size_t column = 1; column <= right.size(); ++column) {
      const std::size_t change = left[row - 1] == right[column - 1] ? 0 : 1;
      current[column] = std::min({previous[column] + 1, current[column - 1] + 1, previous[column - 1] + change});
      const bool swapped =
          row > 1 && column > 1 && left[row - 1] == right[column - 2] && left[row - 2] == right[column - 1];
      if (swapped)
        current[column] = std::min(current[column], before_previous[column - 2] + 1);
    }
    before_previous = previous;
    previous = current;
  }
  return previous[right.size()];
}

} // namespace

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > longest_word)
    return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : known) {
    if (candidate.size() > longest_word)
      continue;
    if (const auto steps = distance(word, candidate);
        steps < least && steps < std::max(word.size(), candidate.size())) {
      least = steps;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string in_quotes(std::string_view text) {
  std::string result;
  append_json_string(result, text.substr(0, longest_quote));
  if (text.size() > longest_quote)
    result.insert(result.size() - 1, "...");
  return result;
}

} // namespace godwit::io::schemas
